// SPDX-License-Identifier: GPL-2.0-or-later
// Grains with points turned inside out come back: the mended state is sound, and quasi-static steps from it end in the
// undeformed grain.
#include "contact/polyline.hpp"
#include "step/untangling.hpp"
#include "support/finite_difference.hpp"
#include "support/implicit_world.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

double least_J(const Grain<2>& grain)
{
    double least = 1e300;
    for (const Mat<2>& F : grain.deformation_gradients())
        least = std::min(least, F.determinant());
    return least;
}

Vec<2> node(const Grain<2>& grain, int i) { return grain.mesh->node_position[i] + Vec<2>(&grain.displacement[2 * i]); }

/// A disc whose nodes X have been moved to place(X).
template <class Place> Grain<2> moved(const Place& place, bool polygon = false)
{
    const Mesh mesh = polygon ? mesh_of(PolygonOutline(polygons()[5].second), 124) : disc_mesh(124);
    Grain<2> grain = make_grain(mesh, neo_hookean());
    for (int i = 0; i < mesh->master_count; ++i) {
        const Vec<2> shift = place(mesh->node_position[i]) - mesh->node_position[i];
        std::copy_n(shift.data(), 2, &grain.displacement[2 * i]);
    }
    grain.refresh();
    return grain;
}

/// States that no step could start from.
std::vector<std::pair<std::string, Grain<2>>> spoilt()
{
    std::vector<std::pair<std::string, Grain<2>>> all;
    Random random(3);
    for (double amount : { 0.5, 1.0, 10.0 })
        all.push_back(
            { "random", moved([&](const Vec<2>& X) { return Vec<2>(X + random.vector<2>(amount)); }, amount == 0.5) });
    all.push_back({ "a line", moved([](const Vec<2>& X) { return Vec<2>(X.x(), 0); }) });
    all.push_back({ "a point", moved([](const Vec<2>&) { return Vec<2>(0.2, 0.1); }) });
    all.push_back({ "mirrored", moved([](const Vec<2>& X) { return Vec<2>(-X.x(), X.y()); }) });
    all.push_back({ "half of it folded over", moved([](const Vec<2>& X) { return Vec<2>(std::abs(X.x()), X.y()); }) });
    all.push_back({ "turned over twice", moved([](const Vec<2>& X) { // angle doubled: J > 0, but around the centre twice
                        const double angle = 2 * std::atan2(X.y(), X.x());
                        return Vec<2>(X.norm() * Vec<2>(std::cos(angle), std::sin(angle)));
                    }) });
    return all;
}

TEST(Untangling, EnergyHasTheSlopeAndCurvatureThatItSays)
{
    Random random(5);
    for (int k = 0; k < 50; ++k) {
        Mat<2> F = random.matrix<2>(1.5);
        if (F.determinant() < 0) F.col(0) *= -1;
        if (F.determinant() < 0.1) continue;
        const auto at = [&](const std::vector<double>& f) {
            return UntanglingEnergy<2>((Mat<2>() << f[0], f[1], f[2], f[3]).finished());
        };
        const std::vector<double> f { F(0, 0), F(0, 1), F(1, 0), F(1, 1) };
        const auto here = at(f);
        const auto slope = central_gradient([&](const auto& x) { return at(x).value; }, f, 1e-4);
        Eigen::Matrix4d whole;
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(here.slope[i], slope[i], 1e-6 * here.slope.norm());
            const auto row = central_gradient([&](const auto& x) { return at(x).slope[i]; }, f, 1e-4);
            for (int j = 0; j < 4; ++j)
                whole(i, j) = row[j];
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> spectrum(whole);
        const Eigen::Matrix4d kept = spectrum.eigenvectors() * spectrum.eigenvalues().cwiseMax(0).asDiagonal()
            * spectrum.eigenvectors().transpose();
        EXPECT_LT((here.curvature - kept).norm(), 1e-5 * whole.norm());
    }
}

TEST(Untangling, MendsWhatNoStepCouldStartFromAndKeepsCentreAndVelocities)
{
    Random random(1);
    for (auto& [name, grain] : spoilt()) {
        for (double& v : grain.velocity)
            v = random.uniform(-1, 1);
        grain.refresh();
        const Motion<2> motion = grain.motion;
        const auto velocity = grain.velocity;
        const double before = least_J(grain);
        untangle(grain, 0.3);
        std::printf("%s: least J %.3g, then %.3g\n", name.c_str(), before, least_J(grain));
        EXPECT_GE(least_J(grain), 0.3) << name;
        EXPECT_FALSE(crosses_itself(grain.surface)) << name;
        EXPECT_LT((grain.motion.position - motion.position).norm(), 1e-12 * grain.radius) << name;
        EXPECT_LT((grain.motion.velocity - motion.velocity).norm(), 1e-12 * grain.radius) << name;
        EXPECT_EQ(grain.velocity, velocity) << name;
    }
}

// From any of these states the energy of the disc has one minimum, the disc itself: its outline is that of the undeformed one,
// turned somehow.
TEST(Untangling, IsFollowedByTheUndeformedGrain)
{
    for (auto& [name, grain] : spoilt()) {
        untangle(grain, 0.3);
        ImplicitWorld world;
        world.settings.quasistatic = true;
        Grain<2>& free = world.add(grain);
        double smallest = 1;
        for (int k = 0; k < 10; ++k) {
            world.step(1e-4);
            smallest = std::min(smallest, world.min_J());
        }
        const double left = world.energy() / (1.26e6 * free.reference_volume());
        double spread = 0; // of the distances of surface points from the centre
        for (int p = 0; p < free.surface.count; ++p)
            spread = std::max(spread,
                              std::abs((free.surface.x(p) - free.motion.position).norm() / free.radius
                                       - free.mesh->surface[p].position.norm()));
        std::printf("%s: %d iterations; energy left %.1e moduli, outline off by %.1e R\n", name.c_str(), world.iterations,
                    left, spread);
        EXPECT_GT(smallest, 0) << name;
        EXPECT_LT(left, 1e-6) << name;
        EXPECT_LT(spread, 1e-3) << name;
    }
}

TEST(Untangling, LeavesWhatIsSoundWhereItIs)
{
    Grain<2> grain = moved([](const Vec<2>& X) { return Vec<2>(1.2 * X.x() + 0.3 * X.y(), 0.7 * X.y()); });
    const auto before = grain.displacement;
    untangle(grain, 0.8);
    EXPECT_EQ(grain.displacement, before);
}

// A node of a squeezed grain that was pulled across its neighbours comes back behind them; four cells off it is hardly felt.
TEST(Untangling, MovesNodesLittle)
{
    const Mesh mesh = disc_mesh(276);
    Grain<2> grain = make_grain(mesh, neo_hookean());
    for (int i = 0; i < mesh->master_count; ++i) {
        const Vec<2>& X = mesh->node_position[i];
        grain.displacement[2 * i] = 0.25 * X.x();
        grain.displacement[2 * i + 1] = -0.2 * X.y();
    }
    int middle = 0;
    for (int i = 1; i < mesh->master_count; ++i)
        if (mesh->node_position[i].norm() < mesh->node_position[middle].norm()) middle = i;
    grain.displacement[2 * middle] += 4 * mesh->cell_width;
    grain.refresh();
    ASSERT_LT(least_J(grain), 0);
    const Grain<2> before = grain;
    untangle(grain, 0.1);
    double far = 0;
    for (int i = 0; i < mesh->master_count; ++i)
        if ((mesh->node_position[i] - mesh->node_position[middle]).norm() > 4 * mesh->cell_width)
            far = std::max(far, (node(grain, i) - node(before, i)).norm());
    const double way = (node(grain, middle) - node(before, middle)).norm();
    std::printf("the node moves by %.2f cells, others far off by %.3f\n", way / mesh->cell_width, far / mesh->cell_width);
    EXPECT_LT(far, 0.01 * way);
}

TEST(Untangling, RefusesWhatIsNoNumberAndWhatCannotBe)
{
    Grain<2> grain = make_grain(disc_mesh(60), neo_hookean());
    grain.displacement[3] = std::nan("");
    EXPECT_THROW(untangle(grain, 0.3), UserError);
    grain = make_grain(disc_mesh(60), neo_hookean());
    for (double least : { -0.1, 0.0, 1.1, std::nan("") })
        EXPECT_THROW(untangle(grain, least), UserError) << least;
}

} // namespace
