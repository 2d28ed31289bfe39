// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Scene.hpp>

#include "ControlledWall.hpp"

namespace yade {

class SoftIntegrator;

class SoftBoundaryController : public GlobalEngine {
public:
    void action() override;

    YADE_CLASS_BASE_DOC_ATTRS(
            SoftBoundaryController,
            GlobalEngine,
            "Base of the engines that move walls around grains, not to be used directly. They stand behind SoftIntegrator, as in "
            "softEngines(more=[...]). Stresses and strains of a packing are positive in compression. In explicit steps a wall whose stress is "
            "controlled has a mass and takes part in the contact problem; the goal drives it against a damper that lets it run at its largest "
            "speed where nothing resists. In implicit steps it is driven, its way found by the secant method.",
            ((Real,
              mass,
              NaN,
              ,
              "Smallest mass of a wall whose stress is controlled, in explicit steps [kg/m]; NaN: that of all grains when the engine first runs. Walls are "
              "heavier where a step would kick them by over a tenth of their largest speed. Between steps their velocity holds the kick of the next."))(
                    (Real, relStressTol, 0.01, , "How far stresses may be off their goals when these count as reached [goal]."))(
                    (Real, absStressTol, 0, , "The same [Pa]; the larger of the two holds."))(
                    (Real,
                     maxUnbalanced,
                     0.01,
                     ,
                     "Largest mean force that accelerates grains when goals count as reached [mean force of contacts]; see currUnbalanced."))(
                    (int, globUpdate, 100, , "Steps over which stresses and currUnbalanced are means, and after which they are renewed [-]."))(
                    (string, doneHook, , , "Python command that is run once goals are reached; anew after a goal has changed and is reached."))(
                    (Real,
                     currUnbalanced,
                     NaN,
                     Attr::readonly,
                     "Mean over the grains of mass times the change of velocity in the last globUpdate steps over their duration [mean force of contacts]; 0 "
                     "without contacts."))(
                    (bool, reached, false, Attr::readonly, "Goals have been reached, and doneHook was run."))(
                    (Real, externalWork, 0, Attr::readonly, "Work of the walls on the grains since the start [J/m]."))(
                    (int, gathered, 0, Attr::hidden, "Steps since the last renewal [-]."))(
                    (Real, gatheredTime, 0, Attr::hidden, "Their duration [s]."))(
                    (vector<Real>, gatheredForces, , Attr::hidden, "Sum over them of the force on each wall [N/m]."))(
                    (vector<Real>, servos, , Attr::hidden, "Of each wall what softgrain::Servo remembers, in fours."))(
                    (vector<Vector3r>, velocitiesBefore, , Attr::hidden, "Of the grains at the last renewal [m/s].")));

protected:
    struct Press {
        Real wanted, speed; ///< force [N/m]; largest speed [m/s]
    };
    /// Sets the velocities of the walls for the next step.
    virtual void steer(bool implicit);
    /// Renews stresses from the sums, each of which is to be multiplied by this.
    virtual void publish(Real) { }
    virtual bool atGoal() const { return false; }
    /// All goals have been as they are since the last call.
    virtual bool sameGoal() { return true; }
    /// The wall with this number among those of the engine presses with a wanted force.
    void press(ControlledWall& wall, size_t number, const Press& press, bool implicit);
    /// Takes what the grains did to it in this step.
    void gather(const ControlledWall& wall, size_t number);
    bool isNear(Real stress, Real goal) const;
    void demand(bool sane, const char* name, Real value, const char* range) const;

private:
    const SoftIntegrator& integrator() const;
    void requireSaneAttributes() const;
    Real massOfGrains() const;
    Real unbalanced();
    void runHook() const;

    Vector3r gravity_ = Vector3r::Zero(); ///< of the integrator
};
REGISTER_SERIALIZABLE(SoftBoundaryController);

} // namespace yade
