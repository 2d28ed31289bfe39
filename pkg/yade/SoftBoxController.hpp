// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftBoundaryController.hpp"

#include <array>

namespace yade {

class SoftBoxController : public SoftBoundaryController {
public:
    YADE_CLASS_BASE_DOC_ATTRS(
            SoftBoxController,
            SoftBoundaryController,
            "Four walls around grains that go to a stress or a strain along each axis: isotropic, uniaxial and biaxial paths; "
            "PeriTriaxController does the like in periodic cells. See :yref:`SoftBoundaryController` for how, and for where the engine stands. Strains are "
            "ln(initial length / length), stresses those on the walls that move.",
            ((vector<int>, walls, , , "Ids of the left, right, bottom and top wall, in the order of softBox()."))(
                    (Vector2r, goal, Vector2r(NaN, NaN), , "Stress [Pa] or strain [-] wanted along x and y, as stressMask says; a strain may be infinite."))(
                    (int, stressMask, 0, , "Sum of 1 when the goal along x is a stress, and 2 when that along y is [-]."))(
                    (Vector2r,
                     maxStrainRate,
                     Vector2r(NaN, NaN),
                     ,
                     "Rate at which strains go to their goals along x and y, and that where nothing resists a wanted stress [1/s]."))(
                    (bool, symmetric, false, , "Both walls of an axis move; else the right and the top one."))(
                    (Vector2r, initialLength, Vector2r(NaN, NaN), , "Lengths of the box that strains refer to [m]; NaN: those when the engine first runs."))(
                    (Vector2r, strain, Vector2r::Zero(), Attr::readonly, "Strains of the box [-]."))(
                    (Vector2r, stress, Vector2r(NaN, NaN), Attr::readonly, "Mean stresses on the walls that move, of the last globUpdate steps [Pa]."))(
                    (vector<Real>, wallStress, , Attr::readonly, "Mean stress on the left, right, bottom and top wall of the last globUpdate steps [Pa]."))(
                    (Real, boxArea, NaN, Attr::readonly, "Area of the box [m²]."))(
                    (Vector2r, lastGoal, Vector2r(NaN, NaN), Attr::hidden, "Goals when stresses were last renewed."))(
                    (int, lastMask, 0, Attr::hidden, "Mask then.")));

protected:
    void steer(bool implicit) override;
    void publish(Real share) override;
    bool atGoal() const override;
    bool sameGoal() override;

private:
    struct Axis;
    bool controlsStress(int axis) const { return stressMask & (1 << axis); }
    void requireSaneBox() const;
    void steer(Axis& axis, Real across, bool implicit);
    void strainOn(Axis& axis);

    std::array<Real, 2> length_ {}; ///< of the box in this step [m]
};
REGISTER_SERIALIZABLE(SoftBoxController);

} // namespace yade
