// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftPairs.hpp"

#include "contact/polyline.hpp"
#include "law/newton_impact.hpp"
#include "solver/adhesion.hpp"

#include <map>

namespace yade {

namespace {
    Vector3r inSpace(const softgrain::Vec<2>& v) { return Vector3r(v[0], v[1], 0); }
} // namespace

void SoftPairs::collect(const Scene& scene, std::vector<TouchingPair>&& touching, bool goOn)
{
    // The same order for every number of threads: by the first soft grain, and by the other body.
    std::vector<std::array<int, 3>> order; // the ids, and the place in `touching`
    for (const TouchingPair& pair : touching) {
        const bool swapped = soft_.of(pair.id1) < 0 || (soft_.of(pair.id2) >= 0 && pair.id2 < pair.id1);
        order.push_back({ swapped ? pair.id2 : pair.id1, swapped ? pair.id1 : pair.id2, int(order.size()) });
    }
    std::sort(order.begin(), order.end());

    std::map<std::pair<int, int>, Pair::Sum> sums;
    if (goOn)
        for (const Pair& pair : pairs_)
            sums[{ pair.id1, pair.id2 }] = pair.sum;
    pairs_.clear();
    problem.bodies.clear();
    problem.contacts.clear();
    for (SoftState* state : soft_.states)
        problem.bodies.push_back(&state->grain.surface);
    for (const auto& place : order)
        take(scene, std::move(touching[place[2]]));
    if (goOn)
        for (Pair& pair : pairs_)
            pair.sum = sums[{ pair.id1, pair.id2 }];
}

void SoftPairs::wantSurfaces()
{
    for (SoftState* state : soft_.states)
        state->grain.surface.wanted = state->grain.surface.near = false;
    for (const Pair& pair : pairs_) {
        const bool near = !pair.geom->points().empty();
        for (SoftState* state : { pair.first, pair.second })
            if (state) {
                state->grain.renew_positions();
                state->grain.surface.wanted = true;
                state->grain.surface.near |= near;
            }
    }
}

void SoftPairs::pose(const Scene& scene, double kick, Real recovery, Real moved)
{
    deepest = 0;
    free_.clear();
    pulls.contacts.clear();
    for (Pair& pair : pairs_) {
        if (pair.rigid && pair.body1 >= 0) {
            auto& surface = pair.geom->rigid;
            surface.rigid = pair.mover ? free_.take(pair.mover, *pair.second, surface, moved) : nullptr;
        }
        const size_t first = problem.contacts.size();
        const auto pulled = pair.phys->adheres() ? pullsOf(pair, kick) : std::vector<double>(); // contacts change surfaces
        for (const auto& point : pair.geom->points()) {
            deepest = std::max(deepest, -point.gap / pair.size());
            softgrain::Contact<2> contact;
            pair.describe(point, contact);
            contact.vertex = point.vertex;
            contact.weight = point.weight;
            contact.offset = softgrain::gap_speed(point.gap, recovery, scene.dt) * point.normal;
            contact.drive = softgrain::Vec<2>::Zero();
            if (pair.body1 < 0) contact.drive = pair.rigid->vel.head<2>();
            contact.law = pair.phys->law;
            contact.impulse = kick * point.force;
            problem.add(contact);
        }
        if (pair.phys->rebounds()) rebound(pair, first);
        for (size_t i = 0; i < pulled.size(); ++i)
            if (pulled[i] > 0) pull(pair, problem.contacts[first + i], pulled[i], kick);
    }
    rigid.pose(scene, free_, problem, pulls, kick, recovery, moved);
    if (!pulls.contacts.empty()) pulls.bodies = problem.bodies;
    deepest = std::max(deepest, rigid.deepest());
}

/// Gives the contacts of a pair, from the first on, the offsets of Newton's law.
void SoftPairs::rebound(const Pair& pair, size_t first)
{
    using Surface = softgrain::Surface<2>;
    const softgrain::NewtonImpact<2> law { pair.phys->en, pair.phys->et };
    auto contact = problem.contacts.begin() + std::ptrdiff_t(first);
    for (const auto& point : pair.geom->points()) {
        contact->offset = law.offset(point, contact->offset, problem.relative(*contact, &Surface::velocity_before),
                                     problem.relative(*contact, &Surface::velocity));
        ++contact;
    }
}

std::vector<double> SoftPairs::pullsOf(const Pair& pair, double kick) const
{
    SoftPhys& phys = *pair.phys;
    const auto& second = pair.second->grain.surface;
    const auto& first = pair.first ? pair.first->grain.surface : pair.geom->rigid;
    const bool onSecond = !pair.geom->withPlane && softgrain::points_are_of_second(first, second);
    const softgrain::Adhesion<2> adhesion { phys.adhesion, phys.adhesionRange, phys.adhesionReversible };
    softgrain::Bonds bonds { std::move(phys.held), std::move(phys.parted) };
    const auto all
        = adhesion.pulls(pair.geom->points(), pair.geom->withPlane || onSecond ? second : first, onSecond, kick, bonds);
    phys.held = std::move(bonds.held);
    phys.parted = std::move(bonds.parted);
    return all;
}

/// Adhesion pulls at a contact of the problem.
void SoftPairs::pull(Pair& pair, softgrain::Contact<2> contact, double impulse, double kick)
{
    const auto& body = *problem.bodies[contact.body];
    const bool ofSphere = body.rigid && body.kind == softgrain::Surface<2>::Kind::round && pair.mover->id == pair.id1;
    if (ofSphere) // across a gap the radius of its point misses the foot, and would turn it
        contact.normal = (body.rigid->centre - body.x(contact.point)).normalized();
    contact.impulse = -impulse * contact.normal;
    contact.friction = 0;
    pulls.contacts.push_back(contact);
    pair.count(contact.impulse / kick, contact, body.x(contact.point), pair.sum.pull);
}

void SoftPairs::take(const Scene& scene, TouchingPair&& touching)
{
    const int one = soft_.of(touching.id1), two = soft_.of(touching.id2);
    if (two < 0) return; // erased since
    Pair pair { std::move(touching), nullptr, soft_.states[two], nullptr, nullptr, one, two, {} };
    if (one >= 0)
        pair.first = soft_.states[one];
    else {
        const auto& other = (*scene.bodies)[pair.id1];
        if (!other) return;
        pair.rigid = other->state.get();
        pair.mover = FreeBodies::mover(scene, other);
        if (!pair.geom->withPlane || pair.mover) {
            pair.body1 = int(problem.bodies.size());
            problem.bodies.push_back(&pair.geom->rigid);
        }
    }
    pairs_.push_back(std::move(pair));
}

void SoftPairs::refuseOverlaps() const
{
    for (const Pair& pair : pairs_) {
        if (pair.ofItself()) continue;
        if (!pair.second->justPlaced && !(pair.first && pair.first->justPlaced)) continue;
        const auto& second = pair.second->surface();
        Real depth = 0;
        for (const auto& point : pair.geom->points())
            depth = std::max(depth, -point.gap);
        if (pair.first) { // the smaller may be inside the larger, where its points touch nothing
            const auto& first = pair.first->surface();
            const auto &larger = first.size > second.size ? first : second,
                       &smaller = first.size > second.size ? second : first;
            const auto middle = (first.size > second.size ? pair.second : pair.first)->grain.motion.position;
            const Real inside = -softgrain::project(larger, middle, softgrain::nearest_segment(larger, middle)).gap;
            if (inside > 0) depth = std::max(depth, inside + smaller.size);
        }
        if (depth > 1e-3 * second.size)
            throw std::runtime_error("bodies #" + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2)
                                     + " overlap by " + softgrain::shown(depth, 2) // of sampled outlines
                                     + " m where they were put; move them apart or make them smaller.");
    }
}

void SoftPairs::refuseLeaksAtPoints(Real most) const
{
    if (deepest <= most) return;
    for (const Pair& pair : pairs_)
        for (const auto& point : pair.geom->points())
            refuseLeak(pair, -point.gap, most);
}

void SoftPairs::refuseLeaks(Real most) const
{
    for (const Pair& pair : pairs_)
        if (pair.first && !pair.ofItself())
            refuseLeak(pair, softgrain::overlap(pair.first->grain.surface, pair.second->grain.surface), most);
    for (const SoftState* state : soft_.states)
        if (state->grain.mesh->is_concave() && state->folded())
            throw softgrain::SimulationError(
                "soft grain #" + std::to_string(state->grain.id)
                + ": its boundary has passed through itself; likely causes: a grain pressed beyond what its resolution can "
                  "follow, or an impact near the wave speed.");
}

/// The answer is worth nothing from here on.
void SoftPairs::refuseLeak(const Pair& pair, Real depth, Real most) const
{
    if (depth <= most * pair.size()) return;
    throw softgrain::SimulationError("soft grain #" + std::to_string(pair.id2) + " and body #" + std::to_string(pair.id1)
                                     + " have sunk into each other by " + softgrain::shown(depth / pair.size())
                                     + " radii; likely causes: grains pressed beyond what their resolution can follow, an "
                                       "impact near the wave speed, or a body moved by hand.");
}

void SoftPairs::load()
{
    for (const auto* part : { &problem, &pulls })
        for (const auto& contact : part->contacts) {
            if (contact.impulse == softgrain::Vec<2>::Zero()) continue;
            problem.bodies[contact.body]->strike(contact.point, contact.impulse);
            if (contact.other >= 0)
                for (int k = 0; k < softgrain::face_vertices<2>; ++k)
                    problem.bodies[contact.other]->strike(contact.vertex[k], -contact.weight[k] * contact.impulse);
        }
}

void SoftPairs::add(double dt, double share)
{
    size_t index = 0;
    for (Pair& pair : pairs_)
        for (auto& point : pair.geom->points()) {
            const auto& contact = problem.contacts[index++];
            point.force = contact.impulse / dt;
            if (contact.impulse == softgrain::Vec<2>::Zero()) continue;
            pair.count(share * point.force, contact, problem.bodies[contact.body]->x(contact.point), pair.sum.normal);
        }
}

void SoftPairs::Pair::count(const softgrain::Vec<2>& onPoint, const softgrain::Contact<2>& contact,
                            const softgrain::Vec<2>& where, softgrain::Vec<2>& normal)
{
    const softgrain::Vec<2> force = contact.body == body2 ? onPoint : softgrain::Vec<2>(-onPoint);
    const softgrain::Vec<2> along = force.dot(contact.normal) * contact.normal;
    const Real size = along.norm();
    normal += along;
    sum.shear += force - along;
    sum.place += size * where;
    sum.weight += size;
    if (!rigid) return;
    const softgrain::Vec<2> arm = where - rigid->pos.head<2>();
    sum.moment -= arm[0] * force[1] - arm[1] * force[0];
}

Vector3r SoftPairs::Pair::normal() const { return inSpace((sum.normal - sum.pull).normalized()); }

void SoftPairs::deliver(Scene& scene)
{
    for (const Pair& pair : pairs_) {
        pair.phys->normalForce = inSpace(pair.sum.normal + pair.sum.pull);
        pair.phys->shearForce = inSpace(pair.sum.shear);
        pair.phys->contactPoint = pair.sum.weight > 0 ? inSpace(pair.sum.place / pair.sum.weight) : Vector3r::Zero();
        pair.geom->contactPoint = pair.phys->contactPoint;
        pair.geom->normal = pair.normal();
        pair.geom->refR1 = (pair.first ? pair.first : pair.second)->grain.radius;
        pair.geom->refR2 = pair.second->grain.radius;
        if (pair.rigid && pair.sum.weight > 0) {
            scene.forces.addForce(pair.id1, -inSpace(pair.sum.normal + pair.sum.pull + pair.sum.shear));
            scene.forces.addTorque(pair.id1, Vector3r(0, 0, pair.sum.moment));
        }
    }
    scene.forces.sync(); // or they would add to those of the next step
}

std::vector<Real> SoftPairs::pointForces() const
{
    std::vector<Real> rows;
    const auto append = [&rows](const Pair& pair, const softgrain::Vec<2>& place, const softgrain::Vec<2>& normal,
                                const softgrain::Vec<2>& force) {
        if (!pair.ofItself() && force != softgrain::Vec<2>::Zero())
            rows.insert(rows.end(),
                        { Real(pair.id1), Real(pair.id2), place[0], place[1], normal[0], normal[1], force[0], force[1] });
    };
    size_t index = 0;
    for (const Pair& pair : pairs_) {
        for (const auto& point : pair.geom->points()) {
            const auto& contact = problem.contacts[index++];
            const Real sign = contact.body == pair.body2 ? 1 : -1;
            append(pair, problem.bodies[size_t(contact.body)]->x(contact.point), sign * contact.normal, sign * point.force);
        }
        append(pair, pair.phys->contactPoint.head<2>(), -pair.sum.pull.normalized(), pair.sum.pull);
    }
    rigid.addPointForces(rows);
    return rows;
}

boost::python::list SoftPairs::withForce() const
{
    boost::python::list touching;
    for (const Pair& pair : pairs_) {
        const Vector3r force = pair.phys->normalForce + pair.phys->shearForce;
        if (pair.ofItself() || pair.phys->normalForce.squaredNorm() == 0) continue;
        touching.append(boost::python::make_tuple(pair.id1, pair.id2, pair.phys->contactPoint, pair.normal(), force));
    }
    rigid.addWithForce(touching);
    return touching;
}

} // namespace yade
