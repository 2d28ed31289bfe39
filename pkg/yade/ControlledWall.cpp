// SPDX-License-Identifier: GPL-2.0-or-later
#include "ControlledWall.hpp"

#include <pkg/common/Wall.hpp>

namespace yade {

namespace {
    State& stateOf(const Scene& scene, const std::string& engine, Body::id_t id)
    {
        if (!scene.bodies->exists(id))
            throw std::runtime_error(engine + ": there is no body #" + std::to_string(id) + "; give the id of a Wall.");
        return *(*scene.bodies)[id]->state;
    }
} // namespace

ControlledWall::ControlledWall(Scene& scene, const std::string& engine, Body::id_t id, int axis, int side)
    : scene_(scene)
    , id_(id)
    , state_(stateOf(scene, engine, id))
    , side_(side)
{
    const auto& shape = (*scene.bodies)[id]->shape;
    const auto* wall = dynamic_cast<const Wall*>(shape.get());
    const std::string name = engine + ": body #" + std::to_string(id);
    const std::string normal = axis < 0 ? "x or y" : axis == 0 ? "x" : "y";
    if (!wall)
        throw std::runtime_error(name + " is a " + (shape ? shape->getClassName() : "body without shape")
                                 + "; give the id of a Wall normal to " + normal + ".");
    if (axis >= 0 ? wall->axis != axis : wall->axis > 1)
        throw std::runtime_error(name + " is a Wall with axis = " + std::to_string(wall->axis) + "; give one normal to "
                                 + normal + ".");
    axis_ = wall->axis;
    if (side_ == 0) side_ = wall->sense;
    if (side_ == 0)
        throw std::runtime_error(name
                                 + " is a Wall with sense = 0, which does not tell on which side the grains are; make "
                                   "it with sense=1 or sense=-1.");
}

Real ControlledWall::borne() const { return -along(scene_.forces.getForce(id_)); }

Real ControlledWall::work() const
{
    const Real impulse = borne() * scene_.dt;
    const bool free = !(state_.blockedDOFs & State::axisDOF(axis_));
    // what contacts have taken of a free wall's velocity was there before
    return impulse * (velocity() + (free ? impulse / state_.mass / 2 : 0));
}

void ControlledWall::drive(Real velocity)
{
    block(State::DOF_ALL);
    state_.vel[axis_] = side_ * velocity;
}

void ControlledWall::give(Real velocity, Real mass)
{
    block(State::DOF_ALL & ~State::axisDOF(axis_));
    state_.mass = mass;
    state_.vel[axis_] = side_ * velocity;
}

} // namespace yade
