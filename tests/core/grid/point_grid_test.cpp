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

// Sum N = 1, sum N x = x, sum grad N = 0, sum x grad N = I; masses sum up, and so do their first moments; the projection
// returns a linear field, and keeps momentum and angular momentum of any other.
TEST(PointGrid, ReproducesLinesAndKeepsMomenta)
{
    Random random(9);
    for (const auto& layout : layouts(random, { 60, 276 }, 2)) {
        const auto& mesh = *layout.mesh;
        const Mat<2> A = Mat<2>::Identity() + random.matrix<2>(0.25);
        const Vec<2> shift = random.vector<2>(3);
        const PointGrid<2> grid = laid(mesh, A, shift);
        const int points = mesh.point_count();
        double mass = 0, spin = 0;
        std::vector<Vec<2>> any(points), line(points), v, w;
        Vec<2> momentum = Vec<2>::Zero();
        const Mat<2> G = random.matrix<2>(5);
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
            any[p] = random.vector<2>(1);
            line[p] = G * at;
            mass += mesh.point_volume[p];
            momentum += mesh.point_volume[p] * any[p];
            spin += mesh.point_volume[p] * (at[0] * any[p][1] - at[1] * any[p][0]);
        }
        grid.project(mesh.point_volume, line, v);
        grid.project(mesh.point_volume, any, w);
        for (int i = 0; i < grid.node_count(); ++i) {
            ASSERT_GT(grid.node_mass[i], 0) << layout.name;
            ASSERT_LE((v[i] - G * grid.node_position[i]).norm(), 1e-8) << layout.name;
            mass -= grid.node_mass[i];
            momentum -= grid.node_mass[i] * w[i];
        }
        for (int p = 0; p < points; ++p) { // of the interpolated field, by the consistent mass
            Vec<2> at = Vec<2>::Zero(), speed = at;
            for (int k = grid.point_row[p]; k < grid.point_row[p + 1]; ++k) {
                at += grid.entry[k].weight * grid.node_position[grid.entry[k].node];
                speed += grid.entry[k].weight * w[grid.entry[k].node];
            }
            spin -= mesh.point_volume[p] * (at[0] * speed[1] - at[1] * speed[0]);
        }
        EXPECT_NEAR(mass, 0, 1e-11) << layout.name;
        EXPECT_LE(momentum.norm(), 1e-10) << layout.name;
        EXPECT_NEAR(spin, 0, 1e-9) << layout.name;
    }
}

TEST(PointGrid, RefusesPointsThatDetermineNothing)
{
    PointGrid<2> grid;
    EXPECT_THROW(grid.lay({ Vec<2>(0, 0), Vec<2>(50, 0) }, { 1, 1e-3 }, {}, Vec<2>::Zero(), 1, 0.03), SimulationError);
}

} // namespace
