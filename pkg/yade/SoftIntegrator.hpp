// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Scene.hpp>

#include "SoftLoads.hpp"
#include "SoftPairs.hpp"

#include "solver/nlgs.hpp"
#include "step/assembly.hpp"
#include "step/critical_step.hpp"

#include <chrono>
#include <memory>
#include <mutex>

namespace yade {

class SoftIntegrator : public GlobalEngine {
public:
    virtual ~SoftIntegrator();
    void action() override;

    /// Renews elastic energies and smallest stretches.
    void evaluate();
    Real elasticEnergy();
    virtual Real kineticEnergy();
    Real solidArea();
    Real minJ() const;
    Real maxPenetration() const { return pairs_.deepest; }
    virtual Real residual() const;
    boost::python::list contacts() const;
    boost::python::object contactPoints() const;
    virtual boost::python::tuple contactProblem() const;
    void postLoad(SoftIntegrator&);
    using Pause = std::unique_lock<std::recursive_timed_mutex>;
    /// No step is taken while it lives; it owns no lock where a step has not ended within that time.
    Pause pause(std::chrono::milliseconds patience) const { return Pause(guard_, patience); }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftIntegrator,
            GlobalEngine,
            "Advances all soft grains by one step: internal forces of the material points, contacts of all interactions by Contact Dynamics "
            "(non-linear Gauss-Seidel), symplectic Euler. Stands behind InteractionLoop and NewtonIntegrator in O.engines. Rigid bodies "
            "that are free take part in the contacts with their mass and inertia: where they touch grains, this engine corrects the motion "
            "that NewtonIntegrator has given them. Reactions on rigid bodies are in O.forces after the step. Forces and torques that other engines put on a grain through "
            "O.forces act on it as a whole, spread over its mass as gravity is. With O.trackEnergy the sum of the soft entries of O.energy stays "
            "what it was; NewtonIntegrator counts the grains once more, as rigid bodies, in kinetic and gravWork. 2D: forces, energies and "
            "masses are per metre of thickness.",
            ((Vector3r, gravity, Vector3r::Zero(), , "Acceleration of all soft grains [m/s²]; its z component has to be 0."))(
                    (Real, tolerance, 1e-3, , "The contact solver stops when a sweep changes the impulses by less than this, relative [-]."))(
                    (Real,
                     recovery,
                     0.2,
                     ,
                     "Share of a penetration that the contact law takes back in one step [-]. Penetrations are errors of the discrete surfaces, of "
                     "about 1e-4 radii; taken back at once (1) they would feed energy in."))(
                    (Real, damping, 0, , "Numerical damping for relaxation, 0 (none) to below 1 [-]: Cundall's, as NewtonIntegrator.damping for rigid bodies, on each grain as a whole (along its motion, not axis by axis) and on its nodes relative to that. Gravity is damped too, as by default there; flight without forces is not. Explicit steps and total-Lagrangian grains without blockedDOFs."))(
                    (Real,
                     rigidBelow,
                     0,
                     ,
                     "Grains that nothing is near to and whose energy of deformation and vibration is no more than that of a shear by this share of "
                     "their shear modulus move as rigid bodies until something comes near [-]; dampingDissipation has what their vibration held. 0: "
                     "only undeformed grains that translate or rest, for which that is exact. Explicit steps and total-Lagrangian grains without blockedDOFs."))(
                    (int, maxSweeps, 1000, , "Most sweeps of the contact solver in a step [-]."))(
                    (int, checkInterval, 50, , "Steps between two evaluations of the stable time step [-]."))(
                    (Real, criticalStep, NaN, Attr::readonly, "Largest stable time step at its last evaluation [s]."))(
                    (Real, lastStep, 0, Attr::readonly, "Time step of the last step [s]; 0 before the first. Velocities belong to its middle."))(
                    (Real, externalWork, 0, Attr::readonly, "Work on the grains since the start [J/m]: of rigid bodies, gravity, O.forces, blocked degrees of freedom, and of velocities set by hand."))(
                    (Real, frictionDissipation, 0, Attr::readonly, "Energy dissipated by friction since the start [J/m]."))(
                    (Real, contactDissipation, 0, Attr::readonly, "Energy dissipated by normal impulses since the start [J/m]."))(
                    (Real, plasticDissipation, 0, Attr::readonly, "Energy dissipated by plastic flow in the grains since the start, the work of hardening included [J/m]."))(
                    (Real, viscousDissipation, 0, Attr::readonly, "Energy dissipated by the viscosity of the grains since the start [J/m]."))(
                    (Real, dampingDissipation, 0, Attr::readonly, "Energy dissipated by damping, and by rigidBelow, in the grains since the start [J/m]."))(
                    (Real, adhesionWork, 0, Attr::readonly, "Work against adhesion since the start [J/m]: stored where it is reversible."))(
                    (int, iterations, 0, Attr::readonly, "Sweeps of the contact solver in the last step [-]."))(
                    (long, totalIterations, 0, Attr::readonly, "Sweeps of the contact solver since the start [-]."))(
                    (Real, contactIterations, 0, Attr::readonly, "Local contact problems solved since the start: contact points times sweeps [-]."))(
                    (int, rigidCount, 0, Attr::readonly, "Grains that moved as rigid bodies in the last step, or rested undeformed [-]."))(
                    (int, contactCount, 0, Attr::readonly, "Contact points in the last step's contact problem [-]."))(
                    (vector<Real>,
                     stageSeconds,
                     vector<Real>(4, 0),
                     Attr::readonly,
                     "Wall-clock time since the start of [forces and kick, gathering contacts, solving them, moving the grains] [s].")),
            ,
            .def("elasticEnergy", &SoftIntegrator::elasticEnergy, "Elastic energy of all soft grains [J/m].")
                    .def("kineticEnergy", &SoftIntegrator::kineticEnergy, "Kinetic energy of all soft grains [J/m].")
                    .def("solidArea", &SoftIntegrator::solidArea, "Current area of all soft grains [m²].")
                    .def("minJ", &SoftIntegrator::minJ, "Smallest volume ratio of a material point at the start of the last step [-].")
                    .def("maxPenetration",
                         &SoftIntegrator::maxPenetration,
                         "Deepest penetration of a contact point at the start of the last step [radius of the smaller grain].")
                    .def("residual",
                         &SoftIntegrator::residual,
                         "Residual of the last step's contact problem: ||r - P_K(r - u - μ|uₜ|n)|| / max(|q|, |r|, |u|), as Siconos defines it [-].")
                    .def("contacts",
                         &SoftIntegrator::contacts,
                         "Contacts of two bodies with a force in the last step, one a pair: (id1, id2, point [m], normal from id1 to id2 [-], force on id2 [N/m]).")
                    .def("contactPoints",
                         &SoftIntegrator::contactPoints,
                         "Contact points of two bodies with a force in the last step, as bytes; softgrain.stresses.contactPoints() gives them as "
                         "numpy arrays.")
                    .def("contactProblem",
                         &SoftIntegrator::contactProblem,
                         "The last step's contact problem as a matrix and vectors; softgrain.fclib.lastProblem() gives it as numpy arrays."));

protected:
    void adopt();
    /// How far to look for contacts besides what speeds tell [radius].
    virtual Real lookAhead() const { return 0; }
    /// Whether grains may move as rigid bodies.
    virtual bool mayFly() const { return true; }
    /// The assembly is new.
    virtual void assembled() { }
    virtual void advance(double dt);
    virtual void requireSaneAttributes() const;
    virtual void requireStableStep();
    /// Adds what the grains have dissipated in themselves in a step of the assembly.
    void countDissipation();
    void refuseStrangersNowAndThen();
    void refuseCollapse() const;
    void refuseUndamped() const;
    /// What the Law2 functors were called for in this step.
    struct HandedPairs {
        std::vector<TouchingPair> soft;
        std::vector<RigidPair> rigid;
    };
    HandedPairs handedPairs() const;
    void meetThemselves() const;
    void takeOver();
    virtual void trackEnergies();
    /// How long the velocities' time is before that of the displacements [s].
    virtual Real velocitiesBehind() const { return scene->dt / 2; }
    int threads() const;

    mutable std::recursive_timed_mutex guard_; ///< O.run() steps in a thread of its own, while scripts ask
    SoftBodies soft_;
    std::vector<std::pair<shared_ptr<Body>, const State*>> known_; ///< all bodies of the scene when it was last looked at
    SoftLoads loads_ { soft_ };
    SoftPairs pairs_ { soft_ };
    std::unique_ptr<softgrain::Assembly<2>> assembly_;
    Real moved_ = 0;     ///< time step of NewtonIntegrator [s]
    bool fresh_ = false; ///< grains have come since the last step, or were moved by hand

private:
    bool knowsAllBodies();
    void takeIn(const shared_ptr<Body>& body);
    void refuseStrangers() const;
    void refuseStrangers(Body::id_t id1, Body::id_t id2) const;
    void settle(int grain, double dt);
    void countPulls();
    Real adhesionRange() const;

    softgrain::NonlinearGaussSeidel<2> solver_;
    softgrain::SmallestCriticalStep<2> smallestCriticalStep_;
    std::vector<shared_ptr<Body>> left_; ///< that may be gone from the scene; held until the next step
    size_t interactionCount_ = 0;        ///< in the last step
    Real evaluatedJ_ = 1;                ///< smallest J when the stable step was evaluated
    long evaluatedStep_ = -1;            ///< and the step of it
    int elasticId_ = -1, kineticId_ = -1, frictionId_ = -1, contactId_ = -1, viscousId_ = -1, plasticId_ = -1,
        dampingId_ = -1, workId_ = -1, adhesionId_ = -1;
};
REGISTER_SERIALIZABLE(SoftIntegrator);

} // namespace yade
