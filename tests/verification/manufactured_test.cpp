// SPDX-License-Identifier: GPL-2.0-or-later
// Manufactured solutions: order in space and time, and no locking as the Poisson ratio goes to 1/2.
#include "manufactured_run.hpp"
#include "support/finite_difference.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const std::vector<double> poisson_ratios { 0.3, 0.4, 0.45, 0.49, 0.499, 0.4999 };
using Law = Material (*)(double nu);
const std::vector<Law> laws { unit_neo_hookean, unit_mooney_rivlin };

/// d/dt of a vector, and d/dX_j in the columns of a matrix.
Vec<2> rate_of(const std::function<Vec<2>(double)>& f, double t)
{
    Vec<2> rate;
    for (int i = 0; i < 2; ++i)
        rate[i] = central_gradient([&](const std::vector<double>& at) { return f(at[0])[i]; }, { t }, 1e-3)[0];
    return rate;
}
Mat<2> gradient_of(const std::function<Vec<2>(const Vec<2>&)>& f, const Vec<2>& X)
{
    Mat<2> gradient;
    for (int i = 0; i < 2; ++i) {
        const auto row = central_gradient([&](const std::vector<double>& at) { return f(Vec<2>(at[0], at[1]))[i]; },
                                          { X[0], X[1] }, 1e-3);
        gradient.row(i) << row[0], row[1];
    }
    return gradient;
}

/// x, F, v and b belong together: F = dx/dX, v = dx/dt, density (a - b) = Div P with P of the code's law. Differences are
/// good to h^4 times a fifth derivative: 1e-12 times some (2 pi)^5, or 3072 (...) of the ring's profile.
void expect_consistent(const Manufactured& motion, const Material& material, double density, const Vec<2>& X, double t)
{
    const auto where = [&](const Vec<2>& at) { return Vec<2>(at + motion.displacement(at, t)); };
    EXPECT_LE((gradient_of(where, X) - motion.gradient(X, t)).norm(), 1e-6);
    EXPECT_LE((rate_of([&](double at) { return motion.displacement(X, at); }, t) - motion.velocity(X, t)).norm(), 1e-6);
    const Vec<2> acceleration = rate_of([&](double at) { return motion.velocity(X, at); }, t);
    Vec<2> divergence = Vec<2>::Zero();
    for (int j = 0; j < 2; ++j) {
        const auto traction
            = [&](const Vec<2>& at) { return Vec<2>(piola_stress(material, motion.gradient(at, t)).col(j)); };
        divergence += gradient_of(traction, X).col(j);
    }
    const Vec<2> expected = acceleration - divergence / density, b = motion.body_force(X, t);
    EXPECT_LE((b - expected).norm(), 1e-6 * (1 + acceleration.norm() + divergence.norm() / density))
        << material.law << " " << X.transpose();
}

TEST(Manufactured, BodyForcesBalanceStressAndInertia)
{
    Random random(1);
    for (const Law& law : laws)
        for (double nu : { 0.3, 0.49 }) {
            const Material material = law(nu);
            for (double amplitude : { 0.1, 1.0 }) {
                const Vortex disc(disc_profile, amplitude, 2, 1 / 1.7), ring(ring_profile, amplitude, 5, 1 / 1.7);
                for (int trial = 0; trial < 20; ++trial) {
                    const double t = random.uniform(0, 1);
                    const Vec<2> X = random.unit<2>();
                    expect_consistent(disc, material, 1.7, random.uniform(0.05, 1) * X, t);
                    expect_consistent(ring, material, 1.7, random.uniform(0.76, 1.24) * X, t);
                    EXPECT_NEAR(disc.gradient(random.uniform(0, 1) * X, t).determinant(), 1, 1e-13);
                    EXPECT_LE((piola_stress(material, disc.gradient(X, t)) * X).norm(), 1e-12); // free rim
                    EXPECT_LE((piola_stress(material, ring.gradient(1.25 * X, t)) * X).norm(), 1e-12);
                }
            }
            const AxisAligned waves(material, 0.05, 3, 1.7);
            for (int trial = 0; trial < 20; ++trial)
                expect_consistent(waves, material, 1.7, random.vector<2>(0.5), random.uniform(0, 1));
        }
}

// The body force in the form in which Kamojjala et al. (2015) have it.
TEST(Manufactured, VortexForceIsThePublishedOne)
{
    constexpr double A = 1, rate = M_PI, mu = 384.615, rho = 1000;
    const Vortex vortex(ring_profile, A, rate, mu / rho);
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const double R = random.uniform(0.75, 1.25), Theta = random.uniform(0, 6), t = random.uniform(0, 2);
        const double s = std::sin(rate * t), c = std::cos(rate * t), p = 4 * R - 3, q = 4 * R - 5, r = R - 1;
        const double radial = -R * A * A * rate * rate * c * c * std::pow(p * q, 4)
            + 4096 * mu / rho * R * A * A * s * s * r * r * p * p * q * q;
        const double hoop
            = -A * s * (R * rate * rate * p * p * q * q + 64 * mu / rho * (96 * R * R * R - 240 * R * R + 188 * R - 45));
        const double beta = Theta + A * s * (1 - 32 * r * r + 256 * r * r * r * r);
        const Vec<2> expected = turn(beta) * Vec<2>(radial, hoop);
        const Vec<2> b = vortex.body_force(R * Vec<2>(std::cos(Theta), std::sin(Theta)), t);
        EXPECT_LE((b - expected).norm(), 1e-12 * (1 + expected.norm()));
    }
}

/// Errors of a sweep over cell widths, printed as one line; orders from the coarsest to the finest and of the last refinement.
struct Convergence {
    std::vector<double> width;
    std::vector<ManufacturedError> error;

    double order(double ManufacturedError::*field, size_t from = 0) const
    {
        return std::log(error[from].*field / error.back().*field) / std::log(width[from] / width.back());
    }
    void print(const std::string& what) const
    {
        std::printf("%s:", what.c_str());
        for (const auto& [name, field] :
             { std::pair("displacement", &ManufacturedError::displacement),
               std::pair("velocity", &ManufacturedError::velocity), std::pair("stress / mu", &ManufacturedError::stress) }) {
            std::printf(" %s", name);
            for (const auto& e : error)
                std::printf(" %.1e", e.*field);
            std::printf(" order %.2f, at the end %.2f;", order(field), order(field, error.size() - 2));
        }
        std::printf("\n");
    }
};

/// The vortex on discs of several resolutions, all Poisson ratios in one batch. [ratio]
std::vector<Convergence> vortex_errors(const Vortex& vortex, ManufacturedCase c, const std::vector<int>& points)
{
    std::vector<Convergence> all(c.materials.size());
    for (int count : points) {
        c.mesh = disc_mesh(count, 0.3, 0.51); // the grid lies anyhow
        const ManufacturedRun run(vortex, c);
        std::printf("%d points, %d steps\n", c.mesh->point_count(), run.steps());
        for (size_t k = 0; k < all.size(); ++k) {
            all[k].width.push_back(c.mesh->cell_width);
            all[k].error.push_back(run.errors()[k]);
        }
    }
    return all;
}

std::string named(const Material& material, double amplitude, double nu)
{
    return std::string(material.law) + ", A = " + shown(amplitude) + ", nu = " + shown(nu);
}

// Second order in space at every Poisson ratio, and no locking: at each resolution the error at 0.4999 is within twice that
// at 0.3. The exact solution does not depend on the ratio. Shear up to 3.2 A. Cells are as wide as the waves of the
// profile are long at the coarse end, so that errors fall faster than h^2 at first: orders of 2.2 to 2.7.
TEST(Vortex, IsOfOrder2AndDoesNotLock)
{
    constexpr double rate = 2, until = M_PI / 4; // from no to full turn, slow against the shear waves of wave number 6
    for (const Law& law : laws)
        for (double amplitude : { 0.1, 1.0 }) {
            ManufacturedCase c;
            c.until = until;
            for (double nu : poisson_ratios)
                c.materials.push_back(law(nu));
            const auto all = vortex_errors(Vortex(disc_profile, amplitude, rate, 1), c, { 276, 600, 1200, 2400 });
            double worst = 0;
            for (size_t k = 0; k < all.size(); ++k) {
                const std::string name = named(c.materials[k], amplitude, poisson_ratios[k]);
                all[k].print(name);
                EXPECT_GE(all[k].order(&ManufacturedError::displacement), 1.9) << name;
                EXPECT_GE(all[k].order(&ManufacturedError::velocity), 1.9) << name;
                for (size_t level = 0; level < all[k].error.size(); ++level)
                    worst = std::max(worst, all[k].error[level].displacement / all[0].error[level].displacement);
            }
            std::printf("%s, A = %g: error over that at nu = 0.3 at most %.2f\n", c.materials[0].law, amplitude, worst);
            EXPECT_LE(worst, 2) << c.materials[0].law << " " << amplitude;
        }
}

// The published case: E = 1000 Pa at nu = 0.3, rho = 1000 kg/m3, c = 1, the ring between 0.75 and 1.25 m, here on the whole disc.
// At A = 1 the shear is 7.07: principal stretches of 7.2 and 0.14. With 6 to 9 cells across the ring the order is not yet full;
// from 9932 to 20244 points it is 1.95 at A = 0.1.
TEST(Vortex, OfKamojjalaConverges)
{
    constexpr double mu = 384.615;
    for (double amplitude : { 0.1, 1.0 }) {
        ManufacturedCase c;
        c.radius = 1.25;
        c.density = 1000;
        c.until = 0.5;
        const std::vector<double> ratios { 0.3, 0.4999 };
        for (double nu : ratios) {
            c.materials.push_back(unit_neo_hookean(nu));
            for (double& p : c.materials.back().parameters)
                p *= mu;
        }
        const auto all = vortex_errors(Vortex(ring_profile, amplitude, M_PI, mu / c.density), c, { 2400, 5000 });
        for (size_t k = 0; k < all.size(); ++k) {
            const std::string name = "ring, " + named(c.materials[k], amplitude, ratios[k]);
            all[k].print(name);
            EXPECT_GE(all[k].order(&ManufacturedError::displacement), 1.5) << name;
            EXPECT_LE(all[k].error.back().displacement / all[0].error.back().displacement, 2) << name;
        }
    }
}

Mesh square_mesh(int points, double offset)
{
    return mesh_of(PolygonOutline(rectangle_vertices(1, 1)), points, offset, 1.7 * offset);
}

// Displacements and velocities are of order 2; the stress is of order 1, since its pressure is one value a region. Edges are
// loaded by tractions of about (lambda + mu) 4 pi A, kept the same for all ratios: more than some mu would make the square
// unstable (Rivlin 1948, for a cube under dead loads). With the load, the pressure stays and the displacement goes with
// 1 / lambda; the error of pressure gradients goes into shear, as h^2 load / mu (Linke 2014, on incompressible flow), so
// that is its measure: displacement x (lambda + mu) / mu.
TEST(AxisAlignedDisplacement, IsOfOrder2WithTractions)
{
    for (const auto& [law, offset] :
         { std::pair<Law, double>(unit_neo_hookean, 0.0), { unit_neo_hookean, 0.3 }, { unit_mooney_rivlin, 0.3 } }) {
        double first = 0, worst = 0;
        for (double nu : poisson_ratios) {
            const Material material = law(nu);
            const double load = 1 / (1 - 2 * nu); // (lambda + mu) / mu
            const double amplitude = 0.125 / load;
            const AxisAligned waves(material, amplitude, M_PI, 1);
            Convergence all;
            for (int points : { 256, 1024, 4096 }) {
                ManufacturedCase c;
                c.mesh = square_mesh(points, offset);
                c.radius = 1 / std::sqrt(M_PI); // side 1
                c.materials.push_back(material);
                c.until = 0.5;
                all.width.push_back(c.mesh->cell_width);
                all.error.push_back(ManufacturedRun(waves, c).errors()[0]);
            }
            const std::string name = named(material, amplitude, nu) + ", offset " + shown(offset);
            all.print(name);
            EXPECT_GE(all.order(&ManufacturedError::displacement, 1), 1.7) << name;
            EXPECT_GE(all.order(&ManufacturedError::velocity, 1), 1.6)
                << name; // 1.69 to 2.2; the 1.69 becomes 2.03 at 16636 points
            EXPECT_GE(all.order(&ManufacturedError::stress, 1), 0.8) << name;
            const double error = all.error.back().displacement / load;
            if (nu == poisson_ratios[0]) first = error;
            worst = std::max(worst, error / first);
        }
        std::printf("%s, offset %g: error per load over that at nu = 0.3 at most %.2f\n", law(0.3).law, offset, worst);
        EXPECT_LE(worst, 3); // measured 2.3: pressure gradients, see above; between 0.49 and 0.4999 it no longer grows
    }
}

// Leapfrog: displacements at t and velocities at t - dt/2 are of order 2 (Hairer, Lubich and Wanner 2003); velocities taken
// for those at t are of order 1, the mean of two in a row of order 2 again. Order from runs of one grid, so that errors in
// space drop out.
TEST(ManufacturedTime, IsOfOrder2AndVelocitiesStandHalfAStepBehind)
{
    constexpr double until = 0.6;
    const Vortex vortex(disc_profile, 1, 2, 1);
    std::vector<Eigen::VectorXd> u, v, mean;
    const std::vector<int> counts { 200, 400, 800, 1600 };
    for (int steps : counts) {
        ManufacturedCase c;
        c.mesh = disc_mesh(60);
        c.materials.push_back(unit_neo_hookean(0.3));
        c.until = until;
        c.steps = steps;
        const ManufacturedRun to_end(vortex, c);
        c.until = until * (steps + 1) / steps;
        c.steps = steps + 1;
        const ManufacturedRun one_more(vortex, c);
        const auto field = [](const std::vector<double>& f) {
            return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(f.data(), long(f.size())));
        };
        u.push_back(field(to_end.grain(0).displacement));
        v.push_back(field(to_end.grain(0).velocity));
        mean.push_back((v.back() + field(one_more.grain(0).velocity)) / 2);
    }
    const auto order = [&](const std::vector<Eigen::VectorXd>& f, size_t k) {
        return std::log2((f[k] - f[k + 1]).norm() / (f[k + 1] - f[k + 2]).norm());
    };
    for (size_t k = 0; k + 2 < counts.size(); ++k) {
        std::printf("order in time from %d steps: displacement %.3f, velocity %.3f, mean of two velocities %.3f\n",
                    counts[k], order(u, k), order(v, k), order(mean, k));
        EXPECT_NEAR(order(u, k), 2, 0.1);
        EXPECT_NEAR(order(v, k), 1, 0.1);
        EXPECT_NEAR(order(mean, k), 2, 0.1);
    }
}

} // namespace
