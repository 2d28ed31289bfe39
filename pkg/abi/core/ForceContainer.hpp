// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>

#include <mutex>

namespace yade {

// O.forces: each thread adds to its own sums, sync() unites them; getForce and getTorque need a sync() after the last addition.
class ForceContainer {
    using Vectors = std::vector<Vector3r>;
    std::vector<Vectors> _forceData, _torqueData;
    std::vector<Body::id_t> _maxId;
    std::vector<size_t> sizeOfThreads;
    Vectors _force, _torque, _permForce, _permTorque;
    size_t _size;
    bool syncedSizes;
    int nThreads;
    bool permForceUsed, permForceSynced;
    std::mutex globalMutex;
    const Vector3r _zero;

    ForceContainer() = delete;

public:
    bool synced;
    unsigned long syncCount;
    long lastReset;

    ~ForceContainer();
    void addForce(Body::id_t, const Vector3r&);
    void addTorque(Body::id_t, const Vector3r&);
    void addMaxId(Body::id_t);
    void sync();
    const Vector3r& getForce(Body::id_t);
    const Vector3r& getTorque(Body::id_t);
    const Vector3r& getPermForce(Body::id_t);
    const Vector3r& getPermTorque(Body::id_t);
    const Vector3r getForceSingle(Body::id_t); // without sync()
    const Vector3r getTorqueSingle(Body::id_t);
    int getNumAllocatedThreads() const;
    bool getPermForceUsed() const;
};
static_assert(sizeof(ForceContainer) == 304, "YADE 2023.02a: size of ForceContainer");

} // namespace yade
