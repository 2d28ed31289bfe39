// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftImplicitScene.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Wall.hpp>

namespace yade {

void SoftImplicitScene::begin(const Scene& scene, double dt, bool ahead, const Search& search)
{
    scene_ = &scene;
    search_ = search;
    length_ = dt;
    elapsed_ = fastest_ = 0;
    ahead_ = ahead;
    searched_ = false;
    boxes_.clear();
    for (auto& sides : walls_)
        sides.clear();
    for (const auto& body : *scene.bodies) {
        if (!body->shape || softStateOf(*body)) continue;
        const auto* wall = dynamic_cast<const Wall*>(body->shape.get());
        if (!wall && !dynamic_cast<const Box*>(body->shape.get())) continue;
        fastest_ = std::max(fastest_, body->state->vel.norm());
        if (!wall || wall->axis > 1) continue;
        const double v = body->state->vel[wall->axis];
        walls_[size_t(wall->axis)].push_back({ body->state->pos[wall->axis] - (ahead ? dt * v : 0), v });
    }
    for (auto& sides : walls_)
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.position < b.position; });
}

/// The collider knows all bodies that could meet within a look ahead, and the way of the walls.
bool SoftImplicitScene::boxesHold(double ahead, double dt) const
{
    for (size_t g = 0; g < soft_.states.size(); ++g) {
        const auto& surface = soft_.states[g]->grain.surface;
        const auto& bound = soft_.bodies[g]->bound;
        const double room = ahead * surface.size + (searched_ ? 0 : fastest_ * dt);
        for (int d = 0; d < 2; ++d)
            if (surface.min[d] - room < bound->min[d] || surface.max[d] + room > bound->max[d]) return false;
    }
    return true;
}

/// Surface of the first body of a pair that is no wall; a box as it stands after a further dt.
softgrain::Surface<2>& SoftImplicitScene::first(const SoftPairs::Pair& pair, double dt)
{
    if (pair.first) return pair.first->grain.surface;
    auto& box = pair.geom->rigid;
    const auto [start, added] = boxes_.try_emplace(pair.geom.get(), box.position);
    for (size_t i = 0; i < box.position.size(); ++i) {
        if (added && searched_ && ahead_) start->second[i] -= length_ * box.velocity[i];
        box.position[i] = start->second[i] + (elapsed_ + dt) * box.velocity[i];
    }
    box.travel += box.speed * dt;
    box.bound();
    return box;
}

std::vector<softgrain::BarrierContact<2>> SoftImplicitScene::contacts(double ahead, double dt)
{
    if (!boxesHold(ahead, dt)) {
        search_();
        searched_ = true;
    }
    bodies = pairs_.problem.bodies;
    std::vector<softgrain::BarrierContact<2>> found;
    for (SoftPairs::Pair& pair : pairs_.pairs()) {
        SoftGeom& geom = *pair.geom;
        const double near = ahead * pair.size();
        const double speed = pair.rigid ? pair.rigid->vel[geom.axis] : 0;
        double position = 0; // of a wall, now
        if (!dynamic_cast<const softgrain::SignoriniCoulomb<2>*>(pair.phys->law))
            throw std::runtime_error("SoftImplicitIntegrator knows contacts of Signorini and Coulomb alone; take "
                                     "Law2_SoftGeom_SoftPhys_ContactDynamics for bodies #"
                                     + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2) + ".");
        if (geom.withPlane) {
            position = pair.rigid->pos[geom.axis] + (elapsed_ - (ahead_ ? length_ : 0)) * speed;
            geom.plane.look(pair.second->grain.surface, geom.axis, position, geom.side, near + std::abs(speed) * dt);
        } else {
            const auto& surface = first(pair, dt);
            geom.pair.memory = {}; // feet follow from places alone, so that a run goes on the same after a break
            geom.pair.look(surface, pair.second->grain.surface, near + (pair.rigid ? surface.speed * dt : 0));
        }
        for (const auto& point : geom.points()) {
            softgrain::BarrierContact<2> contact {};
            pair.describe(point, contact);
            contact.let = point.let;
            contact.creep = point.creep;
            if (geom.withPlane) {
                contact.plane = geom.side * (position + dt * speed);
                contact.drive = dt * pair.rigid->vel.head<2>();
            }
            contact.size = pair.size();
            contact.force = std::max(0.0, point.force.dot(point.normal));
            contact.shear = point.force.dot(contact.tangent());
            found.push_back(contact);
        }
    }
    return found;
}

softgrain::Vec<2> SoftImplicitScene::prediction(const softgrain::Vec<2>& place, double dt) const
{
    softgrain::Vec<2> way = softgrain::Vec<2>::Zero();
    for (int axis : { 0, 1 }) {
        const auto& sides = walls_[size_t(axis)];
        if (sides.size() < 2) continue;
        const Side &low = sides.front(), &high = sides.back();
        const double at = low.position + elapsed_ * low.velocity,
                     width = high.position - low.position + elapsed_ * (high.velocity - low.velocity);
        way[axis] = dt * (low.velocity + (place[axis] - at) / width * (high.velocity - low.velocity));
    }
    return way;
}

} // namespace yade
