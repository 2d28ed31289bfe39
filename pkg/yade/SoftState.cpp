// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftState.hpp"

#include "Bytes.hpp"
#include "SoftGrain.hpp"
#include "SoftMat.hpp"

#include "step/rigid_flight.hpp"
#include "step/untangling.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((SoftState));

namespace {
    using Plane = softgrain::Vec<2>;

    std::string whose(int id) { return "soft grain #" + std::to_string(id); }

    template <class Items> boost::python::object flattened(const Items& items)
    {
        std::vector<double> values;
        for (const auto& item : items)
            for (int i = 0; i < item.rows(); ++i)
                for (int j = 0; j < item.cols(); ++j)
                    values.push_back(item(i, j));
        return asBytes(values);
    }

    void takeMaterial(const Body& body, softgrain::Grain<2>& grain)
    {
        const auto* material = dynamic_cast<const SoftMat*>(body.material.get());
        if (!material)
            throw softgrain::UserError(whose(body.id)
                                       + ": its material has to be one of soft grains, such as NeoHookeanMat.");
        try {
            grain.law = &material->law();
        } catch (const softgrain::UserError& error) {
            throw softgrain::UserError(whose(body.id) + ": " + error.what());
        }
        grain.parameters = material->lawParameters();
        grain.density = material->density;
        grain.viscosity = material->viscosity;
        if (grain.updated && grain.law->memory_count > 0)
            throw softgrain::UserError(whose(body.id) + ": the plasticity of its material, a " + material->getClassName()
                                       + ", is not known to formulation='updated'; take formulation='total'.");
        if (grain.viscosity > 0 && grain.updated)
            throw softgrain::UserError(whose(body.id) + ": the viscosity of its material, "
                                       + softgrain::shown(grain.viscosity)
                                       + " Pa s, is not known to formulation='updated'; give viscosity=0, or take "
                                         "formulation='total'.");
    }
} // namespace

SoftState* softStateOf(const Body& body)
{
    // class indices are exact types: cheaper than dynamic casts, and nothing derives from these two; a rigid body of
    // a soft material has a SoftState too
    const bool soft = body.shape && body.shape->getClassIndex() == SoftGrain::getClassIndexStatic() && body.state
        && body.state->getClassIndex() == SoftState::getClassIndexStatic();
    return soft ? static_cast<SoftState*>(body.state.get()) : nullptr;
}

std::mutex& SoftState::settingUp()
{
    static std::mutex guard;
    return guard;
}

void SoftState::prepare(const Body& body)
{
    if (prepared()) return;
    const std::lock_guard lock(settingUp());
    auto* shape = static_cast<SoftGrain*>(body.shape.get());
    softgrain::Grain<2> fresh;
    try {
        fresh.mesh = shape->mesh();
        fresh.radius = shape->equivalentRadius();
        if (shape->updated()) fresh.updated.emplace();
    } catch (const softgrain::UserError& error) {
        throw softgrain::UserError(whose(body.id) + ": " + error.what());
    }
    fresh.id = body.id;
    takeMaterial(body, fresh);
    const bool loaded = saved();
    const Vector3r shift = pos - savedPos, kick = vel - savedVel, turn = angVel - savedAngVel; // by hand since loading
    if (!loaded) {
        if (!pos.allFinite() || !vel.allFinite() || !angVel.allFinite())
            throw softgrain::UserError(whose(body.id) + ": its position or velocity is not finite; give finite numbers.");
        if (!(std::abs(ori.norm() - 1) < 1e-3) || !((ori * Vector3r::UnitZ() - Vector3r::UnitZ()).norm() < 1e-6))
            throw softgrain::UserError(whose(body.id)
                                       + ": its orientation has to be a turn about the z axis (a unit quaternion); soft "
                                         "grains stay in the xy-plane.");
        if (vel[2] != 0 || angVel[0] != 0 || angVel[1] != 0)
            throw softgrain::UserError(
                whose(body.id)
                + ": its velocity has to lie in the xy-plane and its spin along z; soft grains stay in the plane.");
        origin = pos.head<2>();
        fresh.place(origin, ori.toRotationMatrix().topLeftCorner<2, 2>(), vel.head<2>(),
                    softgrain::rotation_rate(angVel[2]));
        refPos = pos;
        refOri = ori;
        justPlaced = true;
    } else {
        if (format != currentFormat || !takeSaved(fresh))
            throw softgrain::UserError(whose(body.id) + ": its saved state (format " + std::to_string(format) + ", "
                                       + std::to_string(nodeDisplacement.size() + pointState.size())
                                       + " values) is of another version of softgrain, which expects format "
                                       + std::to_string(currentFormat) + " and " + std::to_string(fresh.mesh->master_count)
                                       + " nodes, " + std::to_string(fresh.mesh->point_count())
                                       + " points; load it with the version that saved it.");
        fresh.elastic_energy();
        fresh.surface.travel = travel;
        fresh.surface.ahead = ahead;
    }
    grain = fresh;
    if (grain.mesh->is_concave() && !withItself) withItself.reset(new SoftGeom);
    known_ = body.material;
    mass = grain.mass();
    publish();
    if (loaded) {
        asked = { published.vel + kick, published.angVel + turn };
        if (shift != Vector3r::Zero()) setPosition(pos + shift);
    }
}

/// Into a grain that has its discretisation; false when the numbers do not fit.
bool SoftState::takeSaved(softgrain::Grain<2>& fresh) const
{
    fresh.origin = origin;
    if (fresh.updated) {
        fresh.updated->place(*fresh.mesh, softgrain::Mat<2>::Identity());
        if (!fresh.updated->unpack(*fresh.mesh, pointState)) return false;
        fresh.refresh();
        return true;
    }
    fresh.displacement = nodeDisplacement;
    fresh.velocity = nodeVelocity;
    fresh.memory = pointMemory;
    const size_t expected = 2 * size_t(fresh.mesh->master_count);
    if (nodeDisplacement.size() != expected || nodeVelocity.size() != expected
        || pointMemory.size() != size_t(fresh.mesh->point_count()) * fresh.law->memory_count)
        return false;
    fresh.refresh();
    return softgrain::unpack_flight(flight, fresh);
}

bool SoftState::outdated(const Body& body) const
{
    auto& shape = static_cast<SoftGrain&>(*body.shape);
    if (shape.mesh() != grain.mesh || shape.equivalentRadius() != grain.radius
        || shape.updated() != grain.updated.has_value())
        throw softgrain::UserError(
            whose(body.id)
            + ": its shape was changed, which a deformed grain cannot follow; erase the body and append a new one.");
    if (body.material != known_) return true;
    const auto& material = static_cast<const SoftMat&>(*known_);
    return material.density != grain.density || material.viscosity != grain.viscosity
        || material.lawParameters() != grain.parameters;
}

void SoftState::renew(const Body& body)
{
    const auto* law = grain.law;
    takeMaterial(body, grain);
    if (grain.law != law) grain.forget();
    known_ = body.material;
    mass = grain.mass();
    grain.refresh();
    inertia = Vector3r::Constant(grain.motion.second_moment.trace());
}

/// Both follow from what a body is made of; a value of its own would be without effect.
void SoftState::setMass(Real value)
{
    if (prepared() && value != mass)
        throw softgrain::UserError(whose(grain.id) + ": its mass follows from its shape and its material's density and is "
                                   + softgrain::shown(mass) + " kg/m, not " + softgrain::shown(value)
                                   + "; change material.density instead.");
    mass = value;
}

void SoftState::setInertia(const Vector3r& value)
{
    if (prepared() && value != inertia)
        throw softgrain::UserError(whose(grain.id)
                                   + ": its moment of inertia follows from its shape and its material's density; change "
                                     "material.density instead.");
    inertia = value;
}

void SoftState::setPosition(const Vector3r& value)
{
    if (runs()) {
        if (!value.allFinite())
            throw softgrain::UserError(whose(grain.id)
                                       + ": its position was set to what is not finite; give finite numbers.");
        grain.translate(value.head<2>() - grain.motion.position);
        origin = grain.origin;
        justPlaced = Omega::instance().getScene()->doSort = true;
    }
    pos = value;
}

void SoftState::setOrientation(const Quaternionr& value)
{
    if (runs() && !(std::abs(value.dot(ori)) > 1 - 1e-9))
        throw softgrain::UserError(
            whose(grain.id)
            + ": a deformed grain cannot be turned by hand; set its ori before the first step, or its angVel.");
    ori = value;
}

void SoftState::heed()
{
    if (!asked.vel.allFinite() || !asked.angVel.allFinite() || asked.vel[2] != 0 || asked.angVel[0] != 0
        || asked.angVel[1] != 0)
        throw softgrain::UserError(
            whose(grain.id)
            + ": its velocity has to be finite and in the xy-plane, its spin about z; soft grains stay in the plane.");
    const Plane kick = (asked.vel - published.vel).head<2>();
    const Real turn = asked.angVel[2] - published.angVel[2];
    const auto before = grain.motion;
    grain.add_velocity(kick, softgrain::rotation_rate(turn));
    grain.refresh();
    for (int i = 0; i < 2; ++i) // blocked ones ask for these from now on
        if (asked.vel[i] != published.vel[i]) vel[i] = asked.vel[i];
    if (turn != 0) angVel[2] = asked.angVel[2];
    published = asked;
    workByHand += mass * kick.dot(before.velocity + kick / 2)
        + turn * (before.angular_momentum[0] + turn * before.second_moment.trace() / 2);
}

void SoftState::publish()
{
    const auto& motion = grain.motion;
    pos.head<2>() = motion.position;
    inertia = Vector3r::Constant(motion.second_moment.trace());
    for (int d = 0; d < 2; ++d)
        if (!(blockedDOFs & axisDOF(d))) vel[d] = motion.velocity[d];
    if (!(blockedDOFs & DOF_RZ)) angVel[2] = motion.angular_momentum[0] / inertia[2];
    vel[2] = angVel[0] = angVel[1] = 0;
    asked = published = { vel, angVel };
    // rotation of the polar decomposition in the plane
    const auto& F = motion.mean_gradient;
    const Real c = F(0, 0) + F(1, 1), s = F(1, 0) - F(0, 1), size = std::sqrt(c * c + s * s);
    const Real w = std::sqrt(std::max(0.0, (1 + c / size) / 2)); // half angle, without trigonometry
    ori = Quaternionr(w, 0, 0, w > 1e-3 ? s / (2 * size * w) : std::copysign(1.0, s));
    ori.normalize();
}

const softgrain::Surface<2>& SoftState::surface() const
{
    static std::mutex guard;
    if (!grain.surface.wanted) {
        const std::lock_guard<std::mutex> lock(guard);
        const_cast<SoftState*>(this)->grain.renew_positions(); // what they say stays the same
    }
    return grain.surface;
}

/// Has a grain, or gets it now if it was loaded.
bool SoftState::runs()
{
    if (!prepared() && saved())
        for (const auto& body : *Omega::instance().getScene()->bodies)
            if (softStateOf(*body) == this) prepare(*body);
    return prepared();
}

softgrain::Grain<2>& SoftState::current()
{
    if (!runs())
        throw softgrain::UserError(
            "this SoftState belongs to no running scene yet: append its body to O.bodies and run a step first.");
    grain.pull();
    return grain;
}

void SoftState::preSave(SoftState&)
{
    if (!prepared()) return;
    savedPos = pos;
    savedVel = vel;
    savedAngVel = angVel;
    if (touched()) heed();
    grain.pull();
    origin = grain.origin;
    flight = softgrain::packed_flight(grain);
    nodeDisplacement = grain.flight ? grain.flight->displacement : grain.displacement;
    nodeVelocity = grain.velocity;
    pointMemory = grain.memory;
    if (grain.updated) pointState = grain.updated->packed();
    travel = grain.surface.travel;
    ahead = grain.surface.ahead;
}

std::vector<softgrain::Vec<2>> SoftState::referencePlaces() const
{
    auto places = grain.mesh->point_position;
    const softgrain::Mat<2> turn = refOri.toRotationMatrix().topLeftCorner<2, 2>();
    for (auto& place : places)
        place = refPos.head<2>() + grain.radius * turn * place;
    return places;
}

boost::python::object SoftState::pointPositions() { return flattened(current().point_positions()); }
boost::python::object SoftState::pointReferencePositions()
{
    current();
    return flattened(referencePlaces());
}
boost::python::object SoftState::pointVelocities() { return flattened(current().point_velocities()); }
boost::python::object SoftState::deformationGradients() { return flattened(current().deformation_gradients()); }
boost::python::object SoftState::cauchyStress() { return flattened(current().cauchy_stresses()); }
boost::python::object SoftState::plasticStrains() { return asBytes(current().plastic_strains()); }
boost::python::object SoftState::outline()
{
    current();
    return asBytes(surface().position);
}

boost::python::object SoftState::pointVolumes()
{
    std::vector<double> volumes = current().mesh->point_volume;
    for (double& volume : volumes)
        volume *= grain.radius * grain.radius;
    return asBytes(volumes);
}

Real SoftState::area()
{
    const auto F = current().deformation_gradients();
    Real sum = 0;
    for (size_t p = 0; p < F.size(); ++p)
        sum += grain.mesh->point_volume[p] * F[p].determinant();
    return sum * grain.radius * grain.radius;
}

Real SoftState::minJ()
{
    Real least = std::numeric_limits<Real>::max();
    for (const auto& F : current().deformation_gradients())
        least = std::min(least, F.determinant());
    return least;
}

void SoftState::untangle(Real leastJ)
{
    softgrain::Grain<2>& mine = current();
    if (mine.updated)
        throw softgrain::UserError(
            whose(mine.id)
            + ": untangle() moves grid nodes, and the points of an updated-Lagrangian grain carry its "
              "deformation; give its shape the formulation 'total'.");
    if (touched()) heed();
    mine.flight.reset();
    softgrain::untangle(mine, leastJ);
    mine.put();
    known_.reset(); // what holds the grain takes it in anew
    publish();
    justPlaced = Omega::instance().getScene()->doSort = true;
}

Real SoftState::elasticEnergy() { return current().elastic_energy(); }
Real SoftState::kineticEnergy() { return current().motion.kinetic; }

} // namespace yade
