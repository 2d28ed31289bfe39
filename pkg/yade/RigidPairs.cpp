// SPDX-License-Identifier: GPL-2.0-or-later
#include "RigidPairs.hpp"

#include "law/newton_impact.hpp"
#include "solver/adhesion.hpp"

#include <pkg/common/Sphere.hpp>

namespace yade {

void RigidPairs::collect(std::vector<RigidPair>&& pairs)
{
    pairs_ = std::move(pairs);
    // the same order for every number of threads
    std::sort(pairs_.begin(), pairs_.end(),
              [](const auto& a, const auto& b) { return std::make_pair(a.id1, a.id2) < std::make_pair(b.id1, b.id2); });
}

/// Who meets whom where. The point is on body 2, if that moves.
softgrain::Contact<2> RigidPairs::contactOf(const RigidPair& pair, const Scene& scene, FreeBodies& free,
                                            softgrain::ContactProblem<2>& problem, Real moved) const
{
    static const softgrain::SignoriniCoulomb<2> law;
    const auto &one = (*scene.bodies)[pair.id1], &two = (*scene.bodies)[pair.id2];
    const auto mover1 = FreeBodies::mover(scene, one), mover2 = FreeBodies::mover(scene, two);
    const softgrain::Vec<2> place = pair.geom->contactPoint.head<2>();
    const auto side = [&](const shared_ptr<Body>& mover, const auto& twist, Body::id_t other) {
        auto& surface = free.take(mover, twist, other, (*scene.bodies)[other]->state->pos[2], moved);
        return std::make_pair(free.placeIn(problem, mover->id), surface.add(place));
    };
    softgrain::Contact<2> contact {};
    contact.body = contact.other = -1;
    if (!mover1 && !mover2) return contact;
    if (std::abs(pair.geom->normal[2]) > 1e-6)
        throw std::runtime_error(
            "bodies #" + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2)
            + " touch at different z, and Law2_ScGeom_FrictPhys_ContactDynamics knows the xy-plane alone; "
              "put their centres at the same z.");
    std::tie(contact.body, contact.point)
        = mover2 ? side(mover2, pair.twist2, pair.id1) : side(mover1, pair.twist1, pair.id2);
    contact.drive = softgrain::Vec<2>::Zero();
    contact.weight[0] = 1;
    if (mover1 && mover2)
        std::tie(contact.other, contact.vertex[0]) = side(mover1, pair.twist1, pair.id2);
    else {
        const State& fixed = *(mover1 ? two : one)->state;
        contact.drive = (fixed.vel + fixed.angVel.cross(pair.geom->contactPoint - fixed.pos)).head<2>();
    }
    contact.normal = ((mover2 ? 1 : -1) * pair.geom->normal).head<2>();
    contact.friction = pair.phys->tangensOfFrictionAngle;
    contact.law = &law;
    return contact;
}

namespace {

    /// Where a body is round [1/m]: boxes, facets and walls count as flat.
    Real curvature(const Scene& scene, Body::id_t id)
    {
        const auto* sphere = dynamic_cast<const Sphere*>((*scene.bodies)[id]->shape.get());
        return sphere ? 1 / sphere->radius : 0;
    }

    /// Force of adhesion [N/m]; renews what irreversible adhesion remembers.
    Real pullOf(const RigidPair& pair, const Scene& scene, Real gap)
    {
        SoftPhys& phys = *pair.effects;
        const bool near = gap < phys.adhesionRange, parted = !phys.parted.empty();
        if (!phys.adhesionReversible && !parted) {
            softgrain::Bonds bonds { phys.held, phys.parted };
            bonds.hold(near ? std::vector<int> { 0 } : std::vector<int> {});
            phys.held = bonds.held;
            phys.parted = bonds.parted;
        }
        if (!near || parted) return 0;
        const Real radius = 1 / (curvature(scene, pair.id1) + curvature(scene, pair.id2));
        return phys.adhesion * softgrain::width_within(phys.adhesionRange, gap, radius);
    }

    /// Of the last step, without adhesion, on the contact's point: where the solver starts.
    softgrain::Vec<2> forceBefore(const RigidPair& pair, const softgrain::Vec<2>& normal)
    {
        constexpr Real roundOff = 1e-12;
        const Real sign = normal.dot(pair.geom->normal.head<2>()), pull = pair.effects ? pair.effects->pull : 0;
        const softgrain::Vec<2> force = sign * (pair.phys->normalForce + pair.phys->shearForce).head<2>() + pull * normal;
        return force.norm() > roundOff * pull ? force : softgrain::Vec<2>(0, 0);
    }

    /// Newton's law of impact; the contact's impulse is the one of the last step.
    void rebound(const softgrain::ContactProblem<2>& problem, const SoftPhys& phys, softgrain::Contact<2>& contact)
    {
        using Surface = softgrain::Surface<2>;
        softgrain::ContactPoint<2> point {};
        point.normal = contact.normal;
        point.force = contact.impulse;
        contact.offset = softgrain::NewtonImpact<2> { phys.en, phys.et }.offset(
            point, contact.offset, problem.relative(contact, &Surface::velocity_before),
            problem.relative(contact, &Surface::velocity));
    }

} // namespace

void RigidPairs::pose(const Scene& scene, FreeBodies& free, softgrain::ContactProblem<2>& problem,
                      softgrain::ContactProblem<2>& pulls, double kick, Real recovery, Real moved)
{
    deepest_ = 0;
    contact_.clear();
    for (const RigidPair& pair : pairs_) {
        softgrain::Contact<2> contact = contactOf(pair, scene, free, problem, moved);
        contact_.push_back(contact.body < 0 ? -1 : int(problem.contacts.size()));
        if (contact_.back() < 0) continue;
        const Real gap = -pair.geom->penetrationDepth;
        deepest_ = std::max(deepest_, -gap / std::min(pair.geom->refR1, pair.geom->refR2));
        contact.offset = softgrain::gap_speed(gap, recovery, scene.dt) * contact.normal;
        contact.impulse = kick * forceBefore(pair, contact.normal);
        if (pair.effects && pair.effects->rebounds()) rebound(problem, *pair.effects, contact);
        problem.contacts.push_back(contact);
        if (!pair.effects || !pair.effects->adheres()) continue;
        pair.effects->pull = pullOf(pair, scene, gap);
        if (pair.effects->pull == 0) continue;
        contact.impulse = -kick * pair.effects->pull * contact.normal;
        contact.friction = 0;
        pulls.contacts.push_back(contact);
    }
}

void RigidPairs::deliver(Scene& scene, const softgrain::ContactProblem<2>& problem, double kick)
{
    for (size_t i = 0; i < pairs_.size(); ++i) {
        const RigidPair& pair = pairs_[i];
        Vector3r force = Vector3r::Zero();
        if (contact_[i] >= 0) {
            const auto& contact = problem.contacts[size_t(contact_[i])];
            const Real sign = contact.normal.dot(pair.geom->normal.head<2>());
            force.head<2>() = sign / kick * contact.impulse;
            if (pair.effects) force -= pair.effects->pull * pair.geom->normal;
        }
        pair.phys->normalForce = force.dot(pair.geom->normal) * pair.geom->normal;
        pair.phys->shearForce = force - pair.phys->normalForce;
        for (const auto& [id, part] : { std::make_pair(pair.id1, Vector3r(-force)), std::make_pair(pair.id2, force) }) {
            scene.forces.addForce(id, part);
            scene.forces.addTorque(id, (pair.geom->contactPoint - (*scene.bodies)[id]->state->pos).cross(part));
        }
    }
}

void RigidPairs::addWithForce(boost::python::list& touching) const
{
    for (const RigidPair& pair : pairs_)
        if (pair.phys->normalForce.squaredNorm() > 0)
            touching.append(boost::python::make_tuple(pair.id1, pair.id2, pair.geom->contactPoint, pair.geom->normal,
                                                      Vector3r(pair.phys->normalForce + pair.phys->shearForce)));
}

void RigidPairs::addPointForces(std::vector<Real>& rows) const
{
    for (const RigidPair& pair : pairs_) {
        const Vector3r &place = pair.geom->contactPoint, &normal = pair.geom->normal,
                       force = pair.phys->normalForce + pair.phys->shearForce;
        if (force != Vector3r::Zero())
            rows.insert(rows.end(),
                        { Real(pair.id1), Real(pair.id2), place[0], place[1], normal[0], normal[1], force[0], force[1] });
    }
}

} // namespace yade
