// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/openmp-accu.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

// O.energy: named sums [J].
class EnergyTracker : public Serializable {
public:
    using mapStringInt = std::map<string, int>;
    OpenMPArrayAccumulator<Real> energies;
    mapStringInt names; // place in energies
    vector<bool> resetStep;

    EnergyTracker();
    YADE_ABI_STOCK(EnergyTracker)
    // id: -1 at the first call, then kept by the caller; reset: set to zero at every step.
    void findId(const string& name, int& id, bool reset = false, bool newIfNotFound = true);
    void add(const Real& value, const string& name, int& id,
             bool reset = false); // safe in parallel regions once id is known
    void set(const Real& value, const string& name, int& id)
    {
        if (id < 0) findId(name, id, false);
        energies.set(id, value);
    }
    Real total() const;
    void clear();
};
YADE_ABI_STOCK_END(EnergyTracker, 176)

} // namespace yade
