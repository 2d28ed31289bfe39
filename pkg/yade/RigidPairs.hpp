// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "FreeBodies.hpp"
#include "HandedOver.hpp"
#include "SoftPhys.hpp"

#include "solver/contact_problem.hpp"

#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

/// Two rigid bodies near each other, as Law2_ScGeom_FrictPhys_ContactDynamics hands them to the integrator.
struct RigidPair {
    Body::id_t id1, id2;
    shared_ptr<ScGeom> geom;
    shared_ptr<FrictPhys> phys;
    SoftPhys* effects;                             ///< the same, where it may have restitution and adhesion; else null
    softgrain::RigidBody<2>::Twist twist1, twist2; ///< before NewtonIntegrator took its step, of clumps as a whole
};

/// The contacts of rigid bodies among each other in a step, behind those of soft grains in the contact problem.
class RigidPairs {
public:
    /// Takes the pairs, in any order.
    void collect(std::vector<RigidPair>&& pairs);
    void clear() { pairs_.clear(); }
    /// Adds the contacts to a problem, and what adhesion pulls at them to `pulls`. Other arguments as of SoftPairs::pose.
    void pose(const Scene& scene, FreeBodies& free, softgrain::ContactProblem<2>& problem,
              softgrain::ContactProblem<2>& pulls, double kick, Real recovery, Real moved);
    /// Forces of the solved problem to the interactions, which the next step starts from, and to O.forces.
    void deliver(Scene& scene, const softgrain::ContactProblem<2>& problem, double kick);
    Real deepest() const { return deepest_; } ///< penetration [radius of the smaller body]
    /// As SoftPairs::withForce; appended.
    void addWithForce(boost::python::list& touching) const;
    /// As SoftPairs::pointForces; appended.
    void addPointForces(std::vector<Real>& rows) const;

private:
    softgrain::Contact<2> contactOf(const RigidPair& pair, const Scene& scene, FreeBodies& free,
                                    softgrain::ContactProblem<2>& problem, Real moved) const;

    std::vector<RigidPair> pairs_;
    std::vector<int> contact_; ///< of each pair; -1: neither body moves
    Real deepest_ = 0;
};

} // namespace yade
