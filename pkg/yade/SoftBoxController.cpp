// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftBoxController.hpp"

#include "base/types.hpp"

#include <utility>

namespace yade {

YADE_PLUGIN((SoftBoxController));

/// The two walls normal to x or y.
struct SoftBoxController::Axis {
    int axis;
    ControlledWall low, high;

    Real length() const { return high.place() - low.place(); }
};

void SoftBoxController::requireSaneBox() const
{
    if (walls.size() != 4)
        throw std::runtime_error("SoftBoxController: walls holds " + std::to_string(walls.size())
                                 + " ids; give four, those of the left, right, bottom and top wall.");
    demand(stressMask >= 0 && stressMask < 4, "stressMask", stressMask, "be 0, 1, 2 or 3");
    for (int a : { 0, 1 }) {
        const char *stress = a == 0 ? "goal along x" : "goal along y",
                   *rate = a == 0 ? "maxStrainRate along x" : "maxStrainRate along y";
        if (controlsStress(a))
            demand(goal[a] >= 0 && std::isfinite(goal[a]), stress, goal[a],
                   "be a stress of 0 or more, positive in compression");
        else
            demand(!std::isnan(goal[a]), stress, goal[a], "be a strain, positive in compression");
        demand(maxStrainRate[a] > 0 && std::isfinite(maxStrainRate[a]), rate, maxStrainRate[a], "be positive and finite");
    }
}

void SoftBoxController::steer(bool implicit)
{
    requireSaneBox();
    const auto wall = [&](int number, int axis, int side) {
        return ControlledWall(*scene, getClassName(), walls[size_t(number)], axis, side);
    };
    Axis x { 0, wall(0, 0, 1), wall(1, 0, -1) }, y { 1, wall(2, 1, 1), wall(3, 1, -1) };
    for (Axis* axis : { &x, &y }) {
        const int a = axis->axis;
        if (!(axis->length() > 0))
            throw std::runtime_error("SoftBoxController: walls #" + std::to_string(walls[size_t(2 * a)]) + " and #"
                                     + std::to_string(walls[size_t(2 * a + 1)]) + " are " + softgrain::shown(axis->length())
                                     + " m apart; give the lower one first, and keep the goal within what the grains bear.");
        length_[size_t(a)] = axis->length();
        if (std::isnan(initialLength[a])) initialLength[a] = axis->length();
        strain[a] = std::log(initialLength[a] / axis->length());
        gather(axis->low, size_t(2 * a));
        gather(axis->high, size_t(2 * a + 1));
    }
    boxArea = length_[0] * length_[1];
    steer(x, length_[1], implicit);
    steer(y, length_[0], implicit);
}

void SoftBoxController::steer(Axis& axis, Real across, bool implicit)
{
    const int a = axis.axis;
    if (!controlsStress(a)) {
        strainOn(axis);
        return;
    }
    const Press wanted { goal[a] * across, maxStrainRate[a] * axis.length() / (symmetric ? 2 : 1) };
    press(axis.high, size_t(2 * a + 1), wanted, implicit);
    if (symmetric)
        press(axis.low, size_t(2 * a), wanted, implicit);
    else
        axis.low.drive(0);
}

/// By as much as the rate allows, so that strains follow it exactly and end at the goal.
void SoftBoxController::strainOn(Axis& axis)
{
    const int a = axis.axis;
    const Real most = maxStrainRate[a] * scene->dt;
    const Real change = std::clamp(goal[a] - strain[a], -most, most);
    const Real speed = -axis.length() * std::expm1(-change) / scene->dt;
    axis.high.drive(symmetric ? speed / 2 : speed);
    axis.low.drive(symmetric ? speed / 2 : 0);
}

void SoftBoxController::publish(Real share)
{
    wallStress.resize(4);
    for (size_t w = 0; w < 4; ++w)
        wallStress[w] = share * gatheredForces[w] / length_[w < 2 ? 1 : 0];
    for (size_t a : { 0, 1 })
        stress[Eigen::Index(a)] = symmetric ? (wallStress[2 * a] + wallStress[2 * a + 1]) / 2 : wallStress[2 * a + 1];
}

bool SoftBoxController::atGoal() const
{
    constexpr Real round_off = 1e-6; // strains are set
    for (int a : { 0, 1 })
        if (!(controlsStress(a) ? isNear(stress[a], goal[a]) : std::abs(strain[a] - goal[a]) <= round_off)) return false;
    return true;
}

bool SoftBoxController::sameGoal()
{
    const bool same = lastGoal == goal && lastMask == stressMask;
    lastGoal = goal;
    lastMask = stressMask;
    return same;
}

} // namespace yade
