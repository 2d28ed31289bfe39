// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>

#include "SoftGeom.hpp"

#include "step/grain.hpp"

#include <array>
#include <mutex>

namespace yade {

class SoftState : public State {
public:
    static constexpr int currentFormat = 6; ///< of the saved fields
    softgrain::Grain<2> grain;
    bool justPlaced = false; ///< by the user, not loaded: overlaps have still to be looked for
    Real insideUntil = 0;    ///< travel of its surface up to which its bound surely holds it [m]

    /// Sets the grain up from its body, at first from the placement and velocities, after loading from the saved
    /// fields; once done costs nothing. Throws softgrain::UserError.
    void prepare(const Body& body);
    bool prepared() const { return grain.mesh != nullptr; }
    /// Held while a grain is set up, so that another thread sees it before or after.
    static std::mutex& settingUp();
    /// Whether a state is one of these, which a scene may have replaced by another, and prepared.
    static bool ready(const State& state)
    {
        return state.getClassIndex() == getClassIndexStatic() && static_cast<const SoftState&>(state).prepared();
    }
    /// The body's material is not what the grain was set up with. Throws softgrain::UserError when the shape is not.
    bool outdated(const Body& body) const;
    /// Takes the body's material as it is now; the grain must not be in an assembly. Throws softgrain::UserError.
    void renew(const Body& body);
    /// Copies the grain's rigid motion and moment of inertia into pos, vel, ori, angVel, inertia; blocked velocities stay what they are asked to be.
    void publish();
    /// A velocity was set by hand since publish().
    bool touched() const { return asked.vel != published.vel || asked.angVel != published.angVel; }
    /// Changes the grain's velocity by that.
    void heed();
    /// Whether the motions along x and y and about z are blocked.
    std::array<bool, 3> held() const
    {
        return { bool(blockedDOFs & DOF_X), bool(blockedDOFs & DOF_Y), bool(blockedDOFs & DOF_RZ) };
    }
    void preSave(SoftState&);
    /// With positions as of now, which steps leave out where nothing touches. Threads may ask at once.
    const softgrain::Surface<2>& surface() const;
    /// Where the material points lie in the undeformed grain, put at refPos and turned by refOri [m].
    std::vector<softgrain::Vec<2>> referencePlaces() const;
    bool folded() const { return softgrain::is_folded(surface(), grain.mesh->is_concave()); }

    // what Python sees of State: other engines (NewtonIntegrator) change vel and angVel themselves
    Vector3r& velocity() { return prepared() ? asked.vel : vel; }
    Vector3r& spin() { return prepared() ? asked.angVel : angVel; }
    void setVelocity(const Vector3r& value) { velocity() = vel = value; }
    void setSpin(const Vector3r& value) { spin() = angVel = value; }
    Real massAsSet() const { return mass; }
    void setMass(Real value);
    Vector3r inertiaAsSet() const { return inertia; }
    void setInertia(const Vector3r& value);
    Vector3r position() const { return pos; }
    Quaternionr orientation() const { return ori; }
    void setPosition(const Vector3r& value);
    void setOrientation(const Quaternionr& value);
    Se3r placement() const { return Se3r(pos, ori); }
    void setPlacement(const Se3r& value)
    {
        setOrientation(value.orientation);
        setPosition(value.position);
    }

    boost::python::object pointPositions();
    boost::python::object pointReferencePositions();
    boost::python::object pointVelocities();
    boost::python::object pointVolumes();
    boost::python::object deformationGradients();
    boost::python::object cauchyStress();
    boost::python::object plasticStrains();
    boost::python::object outline();
    Real area();
    Real minJ();
    Real elasticEnergy();
    Real kineticEnergy();
    void untangle(Real leastJ);

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftState,
            State,
            "State of a :yref:`SoftGrain`. pos, vel are those of the centre of mass, ori, angVel the rotation in the mean deformation "
            "gradient's polar decomposition and the angular momentum over the moment of inertia; renewed every step, in the xy-plane. pos, vel, "
            "angVel can be set at any time; blockedDOFs of x, y, Z keep the velocity that is set, of the grain as a whole. "
            "Arrays come as bytes of float64; softgrain.arrays.points(body) and its like give them as numpy arrays.",
            ((Vector2r, origin, Vector2r::Zero(), Attr::hidden, "Centre of the undeformed grain: a node is at origin + radius (X + u) [m]."))(
                    (vector<Real>, nodeDisplacement, , Attr::hidden, "Displacements u of the grid nodes, [node][2] [radius]."))(
                    (vector<Real>, flight, , Attr::hidden, "Motion of a grain that moves as a rigid body [SI units]; empty while it deforms."))(
                    (vector<Real>, nodeVelocity, , Attr::hidden, "Velocities of the grid nodes, [node][2] [radius/s]."))(
                    (vector<Real>, pointMemory, , Attr::hidden, "What the points of a material with plasticity remember, [point][number]."))(
                    (vector<Real>,
                     pointState,
                     ,
                     Attr::hidden,
                     "Of an updated-Lagrangian grain instead: positions of points and surface points and deformation gradients as the grid was "
                     "laid, positions and velocities of its nodes, in units of the radius."))(
                    (Vector3r, savedPos, Vector3r::Zero(), Attr::hidden, "What pos held when saved [m]."))(
                    (Vector3r, savedVel, Vector3r::Zero(), Attr::hidden, "What vel held when saved [m/s]."))(
                    (Vector3r, savedAngVel, Vector3r::Zero(), Attr::hidden, "What angVel held when saved [rad/s]."))(
                    (Vector3r,
                     contactLoad,
                     Vector3r::Zero(),
                     Attr::hidden,
                     "Contact force along x and y [N/m] and torque [N] in the last step, where these are blocked."))(
                    (Real, workByHand, 0, Attr::hidden, "Work of velocities set by hand that has not been accounted for [J/m]."))(
                    (shared_ptr<SoftGeom>,
                     withItself,
                     ,
                     Attr::hidden,
                     "Contact points with itself, of a grain whose undeformed outline is concave; else none."))(
                    (Real, travel, 0, Attr::hidden, "Bound on the path of any surface point since the start [m]."))(
                    (Real, ahead, 0, Attr::hidden, "How far to look for contacts besides what speeds tell [m]."))(
                    (int, format, currentFormat, Attr::hidden, "Version of the saved fields [-].")),
            createIndex(),
            .def("pointPositions", &SoftState::pointPositions, "Current positions of the material points, (points, 2) [m].")
                    .def("pointReferencePositions",
                         &SoftState::pointReferencePositions,
                         "Where the material points lie in the undeformed grain at refPos, turned by refOri, (points, 2) [m].")
                    .def("pointVelocities", &SoftState::pointVelocities, "Velocities of the material points, (points, 2) [m/s].")
                    .def("pointVolumes", &SoftState::pointVolumes, "Reference areas of the material points, (points,) [m²].")
                    .def("deformationGradients", &SoftState::deformationGradients, "F at the material points, (points, 2, 2) [-].")
                    .def("cauchyStress", &SoftState::cauchyStress, "Cauchy stress at the material points, (points, 3, 3) [Pa].")
                    .def("plasticStrains",
                         &SoftState::plasticStrains,
                         "Plastic strains that have gathered at the material points, (points,) [-]; 0 where the material has no plasticity.")
                    .def("outline", &SoftState::outline, "Current surface points, counter-clockwise, (surface points, 2) [m].")
                    .def("area", &SoftState::area, "Current area [m²].")
                    .def("minJ", &SoftState::minJ, "Smallest volume ratio J = det F of a material point [-].")
                    .def("elasticEnergy", &SoftState::elasticEnergy, "Elastic energy [J/m].")
                    .def("kineticEnergy", &SoftState::kineticEnergy, "Kinetic energy, of deformation too [J/m].")
                    .def("untangle",
                         &SoftState::untangle,
                         (boost::python::arg("leastJ") = 0.3),
                         "Mends a state that no step can start from: moves the grid nodes of a total-Lagrangian grain little, until J is leastJ (0 to "
                         "1) or more at all material points and the boundary does not cross itself; a sound grain stays as it is, and so do the centre "
                         "of mass and the nodes' velocities. Smaller values move nodes less and leave more elastic energy; explicit steps want about "
                         "0.5. Raises ValueError where the displacements are no numbers and for updated-Lagrangian grains. Barrier of Garanzha et al. "
                         "2021; see doc/theory.md, section 7.")
                    .add_property("pos", &SoftState::position, &SoftState::setPosition, "Centre of mass [m]; setting it moves the grain as it is.")
                    .add_property(
                            "ori",
                            &SoftState::orientation,
                            &SoftState::setOrientation,
                            "Rotation in the polar decomposition of the mean deformation gradient; to be set before the first step only.")
                    .add_property("mass", &SoftState::massAsSet, &SoftState::setMass, "Mass [kg/m]; follows from shape and density once the grain runs.")
                    .add_property(
                            "inertia",
                            &SoftState::inertiaAsSet,
                            &SoftState::setInertia,
                            "Moment of inertia about the centre of mass, of the grain as it is deformed [kg m]; follows from shape and density once the grain runs.")
                    .add_property("se3", &SoftState::placement, &SoftState::setPlacement, "pos and ori.")
                    .add_property(
                            "vel",
                            boost::python::make_function(&SoftState::velocity, boost::python::return_internal_reference<>()),
                            &SoftState::setVelocity,
                            "Velocity of the centre of mass [m/s]; setting it changes the velocity of every point by the difference.")
                    .add_property(
                            "angVel",
                            boost::python::make_function(&SoftState::spin, boost::python::return_internal_reference<>()),
                            &SoftState::setSpin,
                            "Angular momentum over the moment of inertia [rad/s]; setting it adds the difference as a rigid spin."));
    REGISTER_CLASS_INDEX(SoftState, State);

private:
    struct Velocities {
        Vector3r vel = Vector3r::Zero(), angVel = Vector3r::Zero();
    } published, asked;                ///< by publish(), and by Python since
    shared_ptr<const Material> known_; ///< that the grain was set up with

    bool saved() const { return !nodeDisplacement.empty() || !pointState.empty(); }
    bool takeSaved(softgrain::Grain<2>& fresh) const;
    softgrain::Grain<2>& current();
    bool runs();
};
REGISTER_SERIALIZABLE(SoftState);

/// The state of a soft grain, or null for other bodies.
SoftState* softStateOf(const Body& body);

} // namespace yade
