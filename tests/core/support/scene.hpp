// SPDX-License-Identifier: GPL-2.0-or-later
// Soft grains and rigid planes that move at given speeds, all pairs tested for contact: what a scene holds whatever the
// scheme that moves it.
#pragma once

#include "contact/narrow_phase.hpp"
#include "step/assembly.hpp"
#include "support/grains.hpp"

#include <optional>

namespace softgrain::testing_support {

struct Plane {
    int axis, side;         ///< grains stand on the `side` (+1, -1) of x[axis] = position
    double position, speed; ///< [m], [m/s] along the axis
};

class Scene {
public:
    std::deque<Grain<2>> grains; ///< addresses hold
    std::vector<Plane> planes;
    double friction = 0;
    Vec<2> gravity = Vec<2>::Zero();

    std::vector<Vec<2>> plane_force; ///< on the planes in the last step [N/m]
    // since the start
    EnergyBalance balance;
    double time = 0; ///< [s]

    Grain<2>& add(const Grain<2>& grain)
    {
        grains.push_back(grain);
        grains.back().id = int(grains.size()) - 1;
        return grains.back();
    }
    /// Dissipated at contacts since the start [J/m].
    double lost() const { return balance.contact_dissipation + balance.friction; }

protected:
    std::optional<Assembly<2>> assembly_;

    /// Makes the assembly of these, all grains in some order, and room for the contacts.
    void assemble(std::vector<Grain<2>*> members, bool may_fly = true)
    {
        assembly_.emplace(std::move(members), may_fly);
        pairs_.resize(grains.size() * (grains.size() + 1) / 2);
        plane_pairs_.resize(planes.size() * grains.size());
    }
    /// Calls visit(contacts, i, j) for every two grains i < j, and i = j for grains that may meet themselves.
    template <class Visit> void each_pair(Visit visit)
    {
        size_t pair = 0;
        for (size_t i = 0; i < grains.size(); ++i)
            for (size_t j = i; j < grains.size(); ++j, ++pair)
                if (i != j || (grains[i].mesh->is_concave() && !grains[i].updated)) visit(pairs_[pair], i, j);
    }
    /// Calls visit(contacts, w, i) for every plane w and grain i.
    template <class Visit> void each_plane_pair(Visit visit)
    {
        for (size_t w = 0; w < planes.size(); ++w)
            for (size_t i = 0; i < grains.size(); ++i)
                visit(plane_pairs_[w * grains.size() + i], w, i);
    }
    /// Moves the planes; dt in s.
    void pass(double dt)
    {
        for (Plane& plane : planes)
            plane.position += dt * plane.speed;
        time += dt;
    }

private:
    std::vector<PairContacts<2>> pairs_;        ///< of i <= j
    std::vector<PlaneContacts<2>> plane_pairs_; ///< [plane][grain]
};

} // namespace softgrain::testing_support
