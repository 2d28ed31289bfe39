// SPDX-License-Identifier: GPL-2.0-or-later
// A grain by itself: where it is put, what it tells of its state.
#include "support/grains.hpp"
#include "support/layouts.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Puts x = A X (about the origin of the reference) into the nodes.
void deform(Grain<2>& grain, const Mat<2>& A)
{
    for (int i = 0; i < grain.mesh->master_count; ++i) {
        const Vec<2> u = (A - Mat<2>::Identity()) * grain.mesh->node_position[i];
        for (int d = 0; d < 2; ++d)
            grain.displacement[2 * i + d] = u[d];
    }
    grain.refresh();
}

// Every shape, slaves included, takes on a uniform deformation exactly.
TEST(Grain, UniformDeformationIsExact)
{
    Random random(1);
    for (const auto& layout : layouts(random, { 30, 276 }, 3)) {
        const Mat<2> A = random.rotation<2>() * (Mat<2>::Identity() + random.matrix<2>(0.2));
        const Vec<2> centre = random.vector<2>(0.01);
        GrainStart start;
        start.centre = centre;
        Grain<2> grain = make_grain(layout.mesh, neo_hookean(), start);
        deform(grain, A);
        for (const Mat<2>& F : grain.deformation_gradients())
            ASSERT_LE((F - A).norm(), 1e-12) << layout.name;
        const auto x = grain.point_positions();
        for (int p = 0; p < layout.mesh->point_count(); ++p)
            ASSERT_LE((x[p] - centre - 1e-3 * A * layout.mesh->point_position[p]).norm(), 1e-15) << layout.name;
        for (int p = 0; p < grain.surface.count; ++p)
            ASSERT_LE((grain.surface.x(p) - centre - 1e-3 * A * layout.mesh->surface[p].position).norm(), 1e-15)
                << layout.name;
        EXPECT_LE((grain.motion.mean_gradient - A).norm(), 1e-12) << layout.name;
        EXPECT_LE((grain.motion.position - centre).norm(), 1e-15) << layout.name;
    }
}

// E = V W(F); sigma of the closed forms: NH, plane strain: J sigma = mu (F F^T - I) + lambda ln J I.
TEST(Grain, EnergyAndStressOfAUniformDeformationAreClosedForms)
{
    const auto [lambda, mu] = std::make_pair(61e6, 1.26e6);
    Grain<2> grain = make_grain(disc_mesh(124), neo_hookean());
    const Mat<2> A = (Mat<2>() << 1.1, 0.2, -0.1, 0.85).finished();
    deform(grain, A);
    const double J = A.determinant(), log_J = std::log(J);
    const double W = mu / 2 * (A.squaredNorm() + 1 - 3) - mu * log_J + lambda / 2 * log_J * log_J;
    EXPECT_NEAR(grain.elastic_energy() / (M_PI * 1e-6 * W), 1, 1e-11);
    Mat<3> F = Mat<3>::Identity();
    F.topLeftCorner<2, 2>() = A;
    const Mat<3> sigma = (mu * (F * F.transpose() - Mat<3>::Identity()) + lambda * log_J * Mat<3>::Identity()) / J;
    for (const Mat<3>& stress : grain.cauchy_stresses())
        ASSERT_LE((stress - sigma).norm(), 1e-11 * sigma.norm());
    EXPECT_NEAR(grain.min_stretch, A.jacobiSvd().singularValues().minCoeff(), 1e-12);
}

TEST(Grain, IsPutWhereItIsToldWithTheVelocityItIsTold)
{
    Random random(2);
    for (const auto& layout : layouts(random, { 60 }, 2)) {
        GrainStart start;
        start.centre = random.vector<2>(1);
        start.angle = random.uniform(0, 7);
        start.velocity = random.vector<2>(10);
        start.velocity_gradient = random.matrix<2>(1000);
        Grain<2> grain = make_grain(layout.mesh, mooney_rivlin(), start, 2e-3, 700);
        const Mat<2> Q = turn(start.angle);
        for (int p = 0; p < grain.surface.count; ++p) {
            const Vec<2> arm = 2e-3 * Q * layout.mesh->surface[p].position;
            EXPECT_LE((grain.surface.x(p) - start.centre - arm).norm(), 1e-15) << layout.name;
            EXPECT_LE((grain.surface.v(p) - start.velocity - start.velocity_gradient * arm).norm(), 1e-11) << layout.name;
        }
        const auto v = grain.point_velocities(), x = grain.point_positions();
        for (size_t p = 0; p < v.size(); ++p)
            EXPECT_LE((v[p] - start.velocity - start.velocity_gradient * (x[p] - start.centre)).norm(), 1e-11)
                << layout.name;
        EXPECT_LE((grain.motion.position - start.centre).norm(), 1e-15);
        EXPECT_LE((grain.motion.velocity - start.velocity).norm(), 1e-11);
        EXPECT_NEAR(grain.mass(), 700 * M_PI * 4e-6, 1e-12);
        EXPECT_NEAR(grain.reference_volume(), M_PI * 4e-6, 1e-15);
        EXPECT_NEAR(grain.surface.mobility * 700 * 4e-6, 1, 1e-14);
        EXPECT_LE((grain.motion.mean_gradient - Q).norm(), 1e-12);
        // of the lumped masses: L = sum over a, b of (a x (G b)) S_ab, kinetic = m v^2 / 2 + tr(G S G^T) / 2
        const Mat<2> S = grain.motion.second_moment, G = start.velocity_gradient;
        const Mat<2> SG = S * G.transpose();
        EXPECT_NEAR(grain.motion.angular_momentum[0], SG(0, 1) - SG(1, 0), 1e-12 * S.norm() * G.norm());
        EXPECT_NEAR(grain.motion.kinetic,
                    0.5 * grain.mass() * start.velocity.squaredNorm() + 0.5 * (G * S * G.transpose()).trace(),
                    1e-12 * grain.motion.kinetic);
    }
}

// Lumping adds h^2/4 to the second moments per mass (Marsden's identity), slaves change the rest by O(h^2) too: inertia
// comes with an error of order 2. A disc has m R^2 / 4.
TEST(Grain, OfALawThatIsNotThereIsRefusedWithTheNamesOfThoseThatAre)
{
    try {
        law_kernels<2>("Jelly");
        FAIL() << "was taken";
    } catch (const UserError& error) {
        for (const char* words : { "'Jelly' is not there", "' is not there; take one of: ", "Neo-Hookean" })
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Grain, LumpedInertiaIsOfOrder2)
{
    std::vector<double> error, width;
    for (int points : { 60, 276, 1200, 5000 }) {
        const Grain<2> grain = make_grain(disc_mesh(points), neo_hookean());
        error.push_back(grain.motion.second_moment.trace() / (grain.mass() * 1e-6 / 2) - 1);
        width.push_back(grain.mesh->cell_width);
        std::printf("%d points: moment of inertia %+.2f %%\n", grain.mesh->point_count(), 100 * error.back());
        EXPECT_LE(std::abs(error.back()), 1.1 * width.back() * width.back());
    }
    for (size_t k = 1; k < error.size(); ++k)
        EXPECT_NEAR(std::log(error[k - 1] / error[k]) / std::log(width[k - 1] / width[k]), 2, 0.25);
}

TEST(Grain, OutlineOfItsSurfaceKnowsCornersAndBounds)
{
    const auto square = std::make_shared<Discretisation<2>>(PolygonOutline(rectangle_vertices(1, 1)), Resolution {});
    const Grain<2> grain = make_grain(square, neo_hookean());
    int corners = 0;
    for (int p = 0; p < grain.surface.count; ++p) {
        corners += grain.surface.corner[p];
        EXPECT_EQ(bool(grain.surface.corner[p]), square->surface[p].corner);
    }
    EXPECT_EQ(corners, 4);
    const double half = std::sqrt(M_PI) / 2 * 1e-3;
    EXPECT_LE((grain.surface.max - Vec<2>(half, half)).norm(), 1e-15);
    EXPECT_LE((grain.surface.min + Vec<2>(half, half)).norm(), 1e-15);
    EXPECT_EQ(grain.surface.size, 1e-3);
}

} // namespace
