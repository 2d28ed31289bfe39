// SPDX-License-Identifier: GPL-2.0-or-later
// A grid laid under points: what its interpolation reproduces, what its masses and its projection keep.
#include "grid/point_grid.hpp"
#include "support/layouts.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

std::vector<Vec<2>> surface_of(const Discretisation<2>& mesh)
{
    std::vector<Vec<2>> places;
    for (const auto& point : mesh.surface)
        places.push_back(point.position);
    return places;
}

PointGrid<2> laid(const Discretisation<2>& mesh, const Mat<2>& A, const Vec<2>& shift)
{
    std::vector<Vec<2>> points = mesh.point_position, surface = surface_of(mesh);
    for (auto* places : { &points, &surface })
        for (auto& x : *places)
            x = A * x + shift;
    PointGrid<2> grid;
    grid.lay(points, mesh.point_volume, surface, mesh.node_position[0], mesh.cell_width, mesh.node_threshold);
    return grid;
}

// Where the points have not moved the grid is that of the discretisation: nodes, masses and Delassus operator.
TEST(PointGrid, UnderUnmovedPointsIsTheDiscretisation)
{
    Random random(8);
    for (const auto& layout : layouts(random, { 60, 276 }, 2)) {
        const auto& mesh = *layout.mesh;
        const PointGrid<2> grid = laid(mesh, Mat<2>::Identity(), Vec<2>::Zero());
        ASSERT_EQ(grid.node_count(), mesh.master_count) << layout.name;
        for (int i = 0; i < mesh.master_count; ++i) {
            double apart = 1e300, mass = 0;
            for (int k = 0; k < grid.node_count(); ++k)
                if (const double d = (grid.node_position[k] - mesh.node_position[i]).norm(); d < apart) {
                    apart = d;
                    mass = grid.node_mass[k];
                }
            ASSERT_LE(apart, 1e-12) << layout.name;
            ASSERT_NEAR(mass, mesh.node_mass[i], 1e-11) << layout.name;
        }
        for (int p = 0; p < mesh.surface_count(); ++p)
            for (int q = 0; q < mesh.surface_count(); ++q)
                ASSERT_NEAR(grid.response.delassus(p, q), mesh.delassus(p, q), 1e-8 * mesh.delassus(p, p)) << layout.name;
    }
}

// Sum N = 1, sum N x = x, sum grad N = 0, sum x grad N = I; masses sum up.
TEST(PointGrid, ReproducesLines)
{
    Random random(9);
    for (const auto& layout : layouts(random, { 60, 276 }, 2)) {
        const auto& mesh = *layout.mesh;
        const Mat<2> A = Mat<2>::Identity() + random.matrix<2>(0.25);
        const Vec<2> shift = random.vector<2>(3);
        const PointGrid<2> grid = laid(mesh, A, shift);
        const int points = mesh.point_count();
        double mass = 0;
        for (int p = 0; p < points; ++p) {
            const Vec<2> at = A * mesh.point_position[p] + shift;
            double one = 0;
            Vec<2> x = Vec<2>::Zero(), slope = x;
            Mat<2> unit = Mat<2>::Zero();
            for (int k = grid.point_row[p]; k < grid.point_row[p + 1]; ++k) {
                const auto& entry = grid.entry[k];
                one += entry.weight;
                x += entry.weight * grid.node_position[entry.node];
                slope += entry.gradient;
                unit += grid.node_position[entry.node] * entry.gradient.transpose();
            }
            ASSERT_NEAR(one, 1, 1e-11) << layout.name;
            ASSERT_LE((x - at).norm(), 1e-10) << layout.name;
            ASSERT_LE(slope.norm(), 1e-9) << layout.name;
            ASSERT_LE((unit - Mat<2>::Identity()).norm(), 1e-9) << layout.name;
            mass += mesh.point_volume[p];
        }
        for (double m : grid.node_mass) {
            ASSERT_GT(m, 0) << layout.name;
            mass -= m;
        }
        EXPECT_NEAR(mass, 0, 1e-11) << layout.name;
    }
}

TEST(PointGrid, RefusesPointsThatDetermineNothing)
{
    PointGrid<2> grid;
    EXPECT_THROW(grid.lay({ Vec<2>(0, 0), Vec<2>(50, 0) }, { 1, 1e-3 }, {}, Vec<2>::Zero(), 1, 0.03), SimulationError);
}

} // namespace
