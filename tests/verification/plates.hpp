// SPDX-License-Identifier: GPL-2.0-or-later
// Discs between two frictionless rigid plates that approach each other, and what is read from it.
#pragma once

#include "support/random.hpp"
#include "support/world.hpp"

#include <array>

namespace softgrain::testing_support {

/// Means over a window of squeeze: force and squeeze belong together only when averaged over the same steps.
struct Window {
    double squeeze, force;         ///< relative approach of the plates; mean force on both plates [N/m]
    double area_ratio, half_width; ///< at the window's last step; its squeeze follows
    double squeeze_at_end;
    double between; ///< mean force between two discs [N/m]
};

struct Squeeze {
    std::vector<Window> windows;
    double min_J = 1, deepest = 0, residual = 0; ///< smallest J; deepest gap [m]; energy not accounted for, relative
    double off_middle = 0;                       ///< how far from the middle two discs meet [m]
    int steps = 0;
    int new_grids = 0; ///< laid by a grain in the updated-Lagrangian form after the first
};

/// Offset of the grid [cell widths] and turn of the grain.
inline std::array<double, 3> random_placing(Random& random)
{
    const double x = random.uniform(0, 1), y = random.uniform(0, 1);
    return { x, y, random.uniform(0, 2 * M_PI) };
}

struct SqueezeCase {
    Material material = neo_hookean();
    int points = 276, discs = 1; ///< discs: one upon the other
    double offset_x = 0, offset_y = 0, angle = 0;
    double speed = 0.1; ///< of each plate [m/s]
    double until = 0.4, window = 0.005;
    double radius = 1e-3;
    bool updated = false; ///< in the updated-Lagrangian form
};

inline Squeeze squeeze(const SqueezeCase& c)
{
    World world;
    const auto mesh = disc_mesh(c.points, c.offset_x, c.offset_y);
    for (int k = 0; k < c.discs; ++k) {
        GrainStart start;
        start.centre = Vec<2>(0, (2 * k + 1 - c.discs) * c.radius);
        start.angle = c.angle;
        start.updated = c.updated;
        world.add(make_grain(mesh, c.material, start, c.radius));
    }
    const double half = c.discs * c.radius;
    world.planes = { { 1, 1, -half, c.speed }, { 1, -1, half, -c.speed } };
    const double unit = unit_critical_step(world.grains[0]);
    double dt = 0.6 * critical_step(world.grains[0], unit);
    Squeeze result;
    double force = 0, between = 0, place = 0, next = c.window;
    double dissipated = 0; // in the grains
    int count = 0;
    const auto squeeze_now = [&] { return 1 - world.planes[1].position / half; };
    while (squeeze_now() < c.until + c.window / 2) {
        const double before = squeeze_now();
        const Mat<2> carried = c.updated ? world.grains[0].updated->carried()[0] : Mat<2>(Mat<2>::Zero());
        world.step(dt);
        if (c.updated) result.new_grids += world.grains[0].updated->carried()[0] != carried;
        dissipated += world.dissipated().plastic;
        // two discs on each other are unstable: without friction one slides off the other, at a rate of sqrt(F / m R)
        if (c.discs > 1 && world.steps % 5 == 0) world.guide();
        force += (world.plane_force[1].y() - world.plane_force[0].y()) / 2;
        place += (before + squeeze_now()) / 2;
        for (const auto& contact : world.problem.contacts)
            if (contact.other >= 0) between += std::abs(contact.impulse.y()) / world.dt;
        ++count;
        result.deepest = std::min(result.deepest, world.deepest);
        if (squeeze_now() < next) continue;
        world.evaluate();
        dt = 1e300;
        for (const auto& grain : world.grains) {
            dt = std::min(dt, 0.6 * critical_step(grain, unit));
            result.min_J = std::min(result.min_J, grain.min_J);
        }
        Grain<2> copy = world.grains[0];
        copy.pull();
        double area = 0;
        const auto F = copy.deformation_gradients();
        for (size_t p = 0; p < F.size(); ++p)
            area += mesh->point_volume[p] * F[p].determinant() / M_PI;
        const double half_width = (copy.surface.max.x() - copy.surface.min.x()) / 2;
        result.windows.push_back({ place / count, force / count, area, half_width, squeeze_now(), between / count });
        result.off_middle = std::max(
            result.off_middle, std::abs(world.grains.front().surface.max.y() + world.grains.back().surface.min.y()) / 2);
        force = between = place = 0;
        count = 0;
        next += c.window;
    }
    const double total = world.energy() + world.balance.contact_dissipation + dissipated;
    result.residual = total / world.balance.external_work - 1;
    result.steps = world.steps;
    return result;
}

} // namespace softgrain::testing_support
