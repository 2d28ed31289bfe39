// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatcher.hpp>

#include <mutex>

namespace yade {

// Placement and motion of a body (SI units, world frame; inertia in the body's principal frame).
class State : public Serializable, public Indexable {
public:
    Vector3r& pos;    // se3.position
    Quaternionr& ori; // se3.orientation
    std::mutex updateMutex;
    Se3r se3;
    Vector3r vel;
    Real mass;
    Vector3r angVel;
    Vector3r angMom;
    Vector3r inertia;
    Vector3r refPos;
    Quaternionr refOri;
    unsigned blockedDOFs; // bits DOF_...
    bool isDamped;
    Real densityScaling;

    enum { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32 };
    static constexpr unsigned DOF_XYZ = DOF_X | DOF_Y | DOF_Z;
    static constexpr unsigned DOF_RXRYRZ = DOF_RX | DOF_RY | DOF_RZ;
    static constexpr unsigned DOF_ALL = DOF_XYZ | DOF_RXRYRZ;
    static unsigned axisDOF(int axis, bool rotational = false) { return 1u << (axis + (rotational ? 3 : 0)); }

    State();
    YADE_ABI_STOCK(State)
    YADE_ABI_STOCK_INDEX_HEAD(State)
    const Vector3r displ() const { return pos - refPos; }
    const Vector3r rot() const;
    string blockedDOFs_vec_get() const;
    void blockedDOFs_vec_set(const string& letters); // of "xyzXYZ"
};
YADE_ABI_STOCK_END(State, 320)

} // namespace yade
