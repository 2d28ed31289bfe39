// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>

#include "step/grain.hpp"

namespace yade {

class SoftState : public State {
public:
    softgrain::Grain<2> grain;
    bool justPlaced = false; ///< by the user, not loaded: overlaps have still to be looked for

    /// Sets the grain up from its body, at first from the placement and velocities, after loading from the saved
    /// fields; once done costs nothing. Throws softgrain::UserError.
    void prepare(const Body& body);
    bool prepared() const { return grain.mesh != nullptr; }
    /// Copies the grain's rigid motion into pos, vel, ori, angVel.
    void publish();
    void preSave(SoftState&);

    boost::python::object pointPositions();
    boost::python::object pointVelocities();
    boost::python::object pointVolumes();
    boost::python::object deformationGradients();
    boost::python::object cauchyStress();
    boost::python::object outline();
    Real area();
    Real minJ();
    Real elasticEnergy();
    Real kineticEnergy();

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftState,
            State,
            "State of a :yref:`SoftGrain`. pos, vel are those of the centre of mass, ori, angVel the rotation in the mean deformation "
            "gradient's polar decomposition and the angular momentum over the moment of inertia; renewed every step, in the xy-plane. "
            "Arrays come as bytes of float64; softgrain.points(body) and its like give them as numpy arrays.",
            ((Vector2r, origin, Vector2r::Zero(), Attr::hidden, "Centre of the undeformed grain: a node is at origin + radius (X + u) [m]."))(
                    (vector<Real>, nodeDisplacement, , Attr::hidden, "Displacements u of the grid nodes, [node][2] [radius]."))(
                    (vector<Real>, nodeVelocity, , Attr::hidden, "Velocities of the grid nodes, [node][2] [radius/s]."))(
                    (Real, travel, 0, Attr::hidden, "Bound on the path of any surface point since the start [m]."))(
                    (int, format, 1, Attr::hidden, "Version of the saved fields [-].")),
            createIndex(),
            .def("pointPositions", &SoftState::pointPositions, "Current positions of the material points, (points, 2) [m].")
                    .def("pointVelocities", &SoftState::pointVelocities, "Velocities of the material points, (points, 2) [m/s].")
                    .def("pointVolumes", &SoftState::pointVolumes, "Reference areas of the material points, (points,) [m²].")
                    .def("deformationGradients", &SoftState::deformationGradients, "F at the material points, (points, 2, 2) [-].")
                    .def("cauchyStress", &SoftState::cauchyStress, "Cauchy stress at the material points, (points, 3, 3) [Pa].")
                    .def("outline", &SoftState::outline, "Current surface points, counter-clockwise, (surface points, 2) [m].")
                    .def("area", &SoftState::area, "Current area [m²].")
                    .def("minJ", &SoftState::minJ, "Smallest volume ratio J = det F of a material point [-].")
                    .def("elasticEnergy", &SoftState::elasticEnergy, "Elastic energy [J/m].")
                    .def("kineticEnergy", &SoftState::kineticEnergy, "Kinetic energy, of deformation too [J/m]."));
    REGISTER_CLASS_INDEX(SoftState, State);

private:
    softgrain::Grain<2>& current();
};
REGISTER_SERIALIZABLE(SoftState);

/// The state of a soft grain, or null for other bodies.
SoftState* softStateOf(const Body& body);

} // namespace yade
