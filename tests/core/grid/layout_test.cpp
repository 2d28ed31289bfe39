// SPDX-License-Identifier: GPL-2.0-or-later
// Where points, nodes and cells lie: integrals, masses, the wished number of points.
#include "support/layouts.hpp"
#include "support/triangulation.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

// Points at centroid + L (+-1, +-1), L L^T the covariance of the region: exact zeroth, first and second moments.
TEST(Layout, PointsCarryTheMomentsOfTheGrain)
{
    Random random(1);
    for (const auto& layout : layouts(random, { 12, 60, 124, 276, 1000 }, 4)) {
        const Discretisation<2>& mesh = *layout.mesh;
        Moments<2> sum;
        double regions = 0;
        for (int p = 0; p < mesh.point_count(); ++p) {
            const Vec<2>& x = mesh.point_position[p];
            EXPECT_GT(mesh.point_volume[p], 0) << layout.name;
            sum += { mesh.point_volume[p], mesh.point_volume[p] * x, mesh.point_volume[p] * x * x.transpose() };
        }
        for (const auto& region : mesh.regions)
            regions += region.volume;
        EXPECT_LE(difference(sum, layout.outline->moments()), 1e-12) << layout.name;
        EXPECT_LE(difference(mesh.moments, layout.outline->moments()), 1e-12) << layout.name;
        EXPECT_NEAR(regions, M_PI, 1e-12) << layout.name;
    }
}

// Lumped masses: sum_i m_i = V, sum_i m_i x_i = V x_c, because shape functions and slaves reproduce lines.
TEST(Layout, NodesCarryMassAndCentre)
{
    Random random(2);
    for (const auto& layout : layouts(random, { 12, 60, 124, 276, 1000 }, 4)) {
        const Discretisation<2>& mesh = *layout.mesh;
        double mass = 0;
        Vec<2> first = Vec<2>::Zero();
        for (int i = 0; i < mesh.master_count; ++i) {
            mass += mesh.node_mass[i];
            first += mesh.node_mass[i] * mesh.node_position[i];
        }
        EXPECT_NEAR(mass, M_PI, 1e-12) << layout.name;
        EXPECT_LE(first.norm(), 1e-12) << layout.name;
    }
}

TEST(Layout, NodeMassesArePositive)
{
    Random random(3);
    for (const auto& layout : layouts(random, { 12, 30, 60, 124, 276, 556, 1200 }, 12)) {
        const Discretisation<2>& mesh = *layout.mesh;
        ASSERT_EQ(mesh.node_mass.size(), size_t(mesh.master_count));
        ASSERT_EQ(mesh.inverse_mass.size(), size_t(mesh.master_count));
        for (int i = 0; i < mesh.master_count; ++i) {
            EXPECT_GT(mesh.node_mass[i], 0) << layout.name;
            EXPECT_NEAR(mesh.node_mass[i] * mesh.inverse_mass[i], 1, 1e-15) << layout.name;
        }
    }
}

/// Lumped mass of every node before slaves hand theirs on: sum over the points of V_p N_i(X_p).
std::vector<double> bare_masses(const Discretisation<2>& mesh)
{
    std::vector<double> mass(mesh.node_count(), 0);
    for (const auto& block : mesh.blocks)
        for (int p = block.first_point; p < block.first_point + block.point_count; ++p)
            for (int k = 0; k < mesh.stencil; ++k)
                mass[block.node[k]] += mesh.point_volume[p] * mesh.shape[size_t(p) * mesh.stencil + k];
    return mass;
}

TEST(Layout, NodesBelowTheThresholdAreSlavesAndNoOthers)
{
    Random random(4);
    for (const auto& layout : layouts(random, { 60, 276 }, 5)) {
        const Discretisation<2>& mesh = *layout.mesh;
        const auto mass = bare_masses(mesh);
        const double threshold = layout.resolution.threshold() * *std::max_element(mass.begin(), mass.end());
        for (int i = 0; i < mesh.node_count(); ++i)
            EXPECT_EQ(mass[i] < threshold, i >= mesh.master_count) << layout.name << " node " << i << " " << mass[i];
    }
}

TEST(Layout, MasterMassesAreTheirOwnAndWhatSlavesHandOn)
{
    Random random(5);
    for (const auto& layout : layouts(random, { 60, 276 }, 5)) {
        const Discretisation<2>& mesh = *layout.mesh;
        auto mass = bare_masses(mesh);
        mesh.each_link([&](int slave, int master, double weight) { mass[master] += weight * mass[slave]; });
        for (int i = 0; i < mesh.master_count; ++i)
            EXPECT_NEAR(mass[i], mesh.node_mass[i], 1e-14) << layout.name;
    }
}

TEST(Layout, RegionsHoldFourPointsInBlocksThatShareNodes)
{
    Random random(6);
    for (const auto& layout : layouts(random, { 60, 276 }, 3)) {
        const Discretisation<2>& mesh = *layout.mesh;
        int point = 0, block = 0;
        for (const auto& region : mesh.regions) {
            EXPECT_EQ(region.first_block, block) << layout.name;
            int points = 0;
            for (; block < region.first_block + region.block_count; ++block) {
                EXPECT_EQ(mesh.blocks[block].first_point, point) << layout.name;
                point += mesh.blocks[block].point_count;
                points += mesh.blocks[block].point_count;
            }
            EXPECT_EQ(points, 4) << layout.name;
        }
        EXPECT_EQ(point, mesh.point_count()) << layout.name;
        EXPECT_EQ(block, int(mesh.blocks.size())) << layout.name;
    }
}

TEST(Layout, FullCellsHaveTheGaussRule)
{
    // 2 x 2 Gauss points stand h / sqrt(12) from the middle of a cell, where the nodes are
    const auto mesh = Discretisation<2>(DiscOutline(), Resolution {});
    const double h = mesh.cell_width;
    int full = 0;
    for (const auto& region : mesh.regions) {
        if (region.volume < h * h * (1 - 1e-12) || region.volume > h * h * (1 + 1e-12)) continue;
        ++full;
        const auto& block = mesh.blocks[region.first_block];
        const Vec<2> middle = mesh.node_position[block.node[4]];
        for (int p = block.first_point; p < block.first_point + 4; ++p) {
            const Vec<2> from = (mesh.point_position[p] - middle).cwiseAbs() / h;
            EXPECT_NEAR(from.x(), 1 / std::sqrt(12.0), 1e-12);
            EXPECT_NEAR(from.y(), 1 / std::sqrt(12.0), 1e-12);
        }
    }
    EXPECT_GE(full, 30);
}

TEST(Layout, TakesTheNumberOfPointsNearestToTheWish)
{
    for (const auto& shape : shapes())
        for (int wish : { 4, 20, 60, 100, 124, 276, 300, 556 }) {
            Resolution resolution;
            resolution.points = wish;
            const Discretisation<2> mesh(*shape.outline, resolution);
            int nearest = 1 << 30;
            for (int cells = 1; cells <= 60; ++cells) {
                const int count = Discretisation<2>::points_with(*shape.outline, resolution, cells);
                if (std::abs(count - wish) < std::abs(nearest - wish)) nearest = count;
            }
            EXPECT_EQ(mesh.point_count(), nearest) << shape.name << " " << wish;
        }
}

TEST(Layout, GridMovesWithTheOffset)
{
    // nodes stand on the lattice of cell middles, shifted against the lattice without offset by -offset h
    Resolution plain, shifted;
    shifted.offset = { 0.3, 0.6, 0 };
    const Discretisation<2> a(DiscOutline(), plain), b(DiscOutline(), shifted);
    for (int d = 0; d < 2; ++d) {
        const auto phase = [&](const Discretisation<2>& mesh) {
            const double cells = (mesh.node_position[0][d] + 1) / mesh.cell_width;
            return cells - std::floor(cells);
        };
        const double moved = phase(a) - phase(b) - shifted.offset[d];
        EXPECT_NEAR(moved - std::round(moved), 0, 1e-12);
    }
    // a whole cell changes nothing
    Resolution whole = shifted;
    whole.offset = { 1.3, -0.4, 0 };
    const Discretisation<2> c(DiscOutline(), whole);
    ASSERT_EQ(b.node_count(), c.node_count());
    for (int i = 0; i < b.node_count(); ++i)
        EXPECT_LE((b.node_position[i] - c.node_position[i]).norm(), 1e-12);
}

TEST(Layout, RefusesAShapeTooThinForItsGrid)
{
    Resolution coarse;
    coarse.points = 4;
    try {
        const Discretisation<2> mesh(PolygonOutline(rectangle_vertices(100, 1)), coarse);
        // taken: then it has to be fit for use
        EXPECT_GE(mesh.master_count, 3);
        for (double mass : mesh.node_mass)
            EXPECT_GT(mass, 0);
    } catch (const UserError& error) {
        EXPECT_NE(std::string(error.what()).find("too thin"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("more points"), std::string::npos) << error.what();
    }
}

} // namespace
