// SPDX-License-Identifier: GPL-2.0-or-later
#include "FreeBodies.hpp"

#include <core/Clump.hpp>
#include <pkg/common/Wall.hpp>

namespace yade {

namespace {
    bool isWall(const Body& body) { return dynamic_cast<const Wall*>(body.shape.get()); }

    /// NewtonIntegrator turns it by its angular momentum.
    bool turnsByMomentum(const Body& body)
    {
        return body.isAspherical() && (body.state->blockedDOFs & State::DOF_RXRYRZ) == 0;
    }

    Real inverseInertia(const Body& body)
    {
        const State& state = *body.state;
        if (!turnsByMomentum(body)) return 1 / state.inertia[2];
        const Vector3r axis = state.ori.conjugate() * Vector3r::UnitZ();
        return axis.dot(axis.cwiseQuotient(state.inertia));
    }

    /// By the velocities that a surface had before at two of its points; a wall has one.
    softgrain::RigidBody<2>::Twist twistBefore(const softgrain::Surface<2>& surface, const softgrain::RigidBody<2>& rigid)
    {
        const auto velocity
            = [&surface](int p) { return Eigen::Map<const softgrain::Vec<2>>(&surface.velocity_before[2 * size_t(p)]); };
        const int far = surface.count / 2;
        const softgrain::Vec<2> way = surface.x(far) - surface.x(0), change = velocity(far) - velocity(0);
        softgrain::RigidBody<2>::Twist twist(0, 0, 0);
        if (far > 0) twist[2] = (way[0] * change[1] - way[1] * change[0]) / way.squaredNorm();
        twist.head<2>() = velocity(0) - rigid.lever(surface.x(0)) * twist;
        return twist;
    }

    /// As InsertionSortCollider is told by NewtonIntegrator, which has looked before.
    void sortWhenOutOfBound(Scene& scene, const Body& body)
    {
        if (!body.bound) return;
        const Real way = (body.state->pos - body.bound->refPos).cwiseAbs().maxCoeff();
        if (!(way < body.bound->sweepLength)) scene.doSort = true;
    }
} // namespace

const shared_ptr<Body>& FreeBodies::whole(const Scene& scene, const shared_ptr<Body>& body)
{
    return body->isClumpMember() ? (*scene.bodies)[body->clumpId] : body;
}

softgrain::RigidBody<2>::Twist FreeBodies::twistOf(const State& state)
{
    return { state.vel[0], state.vel[1], state.angVel[2] };
}

shared_ptr<Body> FreeBodies::mover(const Scene& scene, const shared_ptr<Body>& body)
{
    const auto& mover = whole(scene, body);
    const unsigned all = State::DOF_X | State::DOF_Y | (isWall(*body) ? 0 : State::DOF_RZ);
    return (mover->state->blockedDOFs & all) == all ? nullptr : mover;
}

void FreeBodies::clear()
{
    for (auto& [id, free] : all_)
        free.body = nullptr;
}

softgrain::RigidBody<2>* FreeBodies::take(const shared_ptr<Body>& mover, const SoftState& grain,
                                          const softgrain::Surface<2>& surface, Real moved)
{
    Free& free = all_[mover->id];
    if (take(free, mover, { "soft grain", grain.grain.id, grain.pos[2], 1e-6 * grain.grain.radius }, moved))
        free.rigid.before = twistBefore(surface, free.rigid);
    return &free.rigid;
}

softgrain::Surface<2>& FreeBodies::take(const shared_ptr<Body>& mover, const softgrain::RigidBody<2>::Twist& before,
                                        Body::id_t other, Real z, Real moved)
{
    constexpr unsigned offPlane = State::DOF_Z | State::DOF_RX | State::DOF_RY;
    Free& free = all_[mover->id];
    if (take(free, mover, { "body", other, z, std::numeric_limits<Real>::infinity() }, moved)) {
        free.rigid.before = before;
        if (!isWall(*mover) && (mover->state->blockedDOFs & offPlane) != offPlane)
            throw std::runtime_error(
                "body #" + std::to_string(mover->id) + ", a " + mover->shape->getClassName()
                + ", may leave the xy-plane, which Law2_ScGeom_FrictPhys_ContactDynamics does not know; "
                  "set its state.blockedDOFs = 'zXY'.");
    }
    return free.surface;
}

int FreeBodies::placeIn(softgrain::ContactProblem<2>& problem, Body::id_t mover)
{
    Free& free = all_.at(mover);
    if (free.place < 0) {
        free.place = int(problem.bodies.size());
        problem.bodies.push_back(&free.surface);
    }
    return free.place;
}

bool FreeBodies::take(Free& free, const shared_ptr<Body>& mover, const Met& met, Real moved)
{
    if (free.body) return false;
    const State& state = *mover->state;
    const auto blocked = [&state](unsigned axes) { return (state.blockedDOFs & axes) == axes; };
    const bool turns = !blocked(State::DOF_RZ) && !isWall(*mover);
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error("body #" + std::to_string(mover->id) + ", a " + mover->shape->getClassName()
                                 + ", is free to move and touches " + met.what + " #" + std::to_string(met.id) + ", but "
                                 + why);
    };
    if (!blocked(State::DOF_X | State::DOF_Y) && !(state.mass > 0))
        refuse("its mass is " + softgrain::shown(state.mass) + "; set state.mass above 0, or state.blockedDOFs = 'xyzXYZ'.");
    if (turns && !(state.inertia.minCoeff() > 0))
        refuse("its moment of inertia is " + softgrain::shown(state.inertia.minCoeff())
               + "; set state.inertia above 0, or block its turns by 'XYZ' in state.blockedDOFs.");
    if (!isWall(*mover) && !(std::abs(state.pos[2] - met.z) <= met.room))
        refuse("its centre is at z = " + softgrain::shown(state.pos[2]) + " m, off the plane of the grain; put it at z = "
               + softgrain::shown(met.z) + " m and keep it there by 'zXY' in state.blockedDOFs.");
    free.body = mover;
    free.moved = moved;
    free.rigid.centre = (state.pos - moved * state.vel).head<2>();
    free.rigid.twist = twistOf(state);
    free.rigid.mobility.setZero();
    for (int d = 0; d < 2; ++d)
        if (!blocked(State::axisDOF(d))) free.rigid.mobility(d, d) = 1 / state.mass;
    if (turns) free.rigid.mobility(2, 2) = inverseInertia(*mover);
    free.surface.resize(0);
    free.surface.rigid = &free.rigid;
    free.place = -1;
    return true;
}

void FreeBodies::move(Scene& scene, Real dt)
{
    for (auto& [id, free] : all_) {
        if (!free.body) continue;
        State& state = *free.body->state;
        const auto& twist = free.rigid.twist;
        const Vector3r vel(twist[0], twist[1], state.vel[2]);
        state.pos.head<2>() += (dt * vel - free.moved * state.vel).head<2>();
        const Real angle = dt * twist[2] - free.moved * state.angVel[2];
        state.ori = Quaternionr(AngleAxisr(angle, Vector3r::UnitZ())) * state.ori;
        state.ori.normalize();
        if (turnsByMomentum(*free.body) && free.rigid.mobility(2, 2) > 0)
            state.angMom[2] += (twist[2] - state.angVel[2]) / free.rigid.mobility(2, 2);
        state.vel = vel;
        state.angVel[2] = twist[2];
        sortWhenOutOfBound(scene, *free.body);
        if (!free.body->isClump()) continue;
        for (const auto& [member, place] : static_cast<const Clump&>(*free.body->shape).members) {
            const Body& body = *(*scene.bodies)[member];
            State& its = *body.state;
            its.pos = state.pos + state.ori * place.position;
            its.ori = state.ori * place.orientation;
            its.vel = state.vel + state.angVel.cross(its.pos - state.pos);
            its.angVel = state.angVel;
            sortWhenOutOfBound(scene, body);
        }
    }
}

} // namespace yade
