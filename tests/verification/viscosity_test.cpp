// SPDX-License-Identifier: GPL-2.0-or-later
// Viscosity of the solid: the decay of a free disc's vibrations against the theory of weakly damped modes, energies, and no
// stress in rigid motion.
#include "step/critical_step.hpp"
#include "support/dense.hpp"
#include "support/random.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double R = 1e-3, density = 1000;

/// The condition that modes of a free disc in plane strain with two nodal diameters are free of traction at the rim: with
/// Helmholtz's potentials displacements are u_r = A k J'(k r) + B n J(q r) / r, u_t = -A n J(k r) / r - B q J'(q r), k and q the
/// wave numbers of dilatation and shear.
double traction(double omega, double lambda, double mu)
{
    constexpr int n = 2;
    const double k = omega * std::sqrt(density / (lambda + 2 * mu)), q = omega * std::sqrt(density / mu);
    struct Bessel {
        double value, slope, curvature; ///< of r -> J_n(w r) at R
        Bessel(double w)
        {
            const double z = w * R, J = std::cyl_bessel_j(n, z), next = std::cyl_bessel_j(n + 1, z);
            value = J;
            slope = w * (n / z * J - next);
            curvature = -slope / R - (w * w - n * n / (R * R)) * J;
        }
    };
    const Bessel p(k), s(q);
    const double rr_p = 2 * mu * p.curvature - lambda * k * k * p.value,
                 rr_s = 2 * mu * n * (s.slope / R - s.value / (R * R)),
                 rt_p = -2 * mu * n * (p.slope / R - p.value / (R * R)),
                 rt_s = -mu * (s.curvature - s.slope / R + n * n * s.value / (R * R));
    return rr_p * rt_s - rr_s * rt_p;
}

/// Lowest angular frequency with two nodal diameters [1/s].
double lowest(double lambda, double mu)
{
    const double unit = std::sqrt(mu / density) / R;
    double low = 0.5 * unit, high = low;
    while (traction(low, lambda, mu) * traction(high, lambda, mu) > 0)
        high *= 1.01;
    for (int k = 0; k < 100; ++k) {
        const double middle = (low + high) / 2;
        (traction(low, lambda, mu) * traction(middle, lambda, mu) > 0 ? low : high) = middle;
    }
    return low;
}

/// Rate at which the amplitude falls: with viscosity on the deviator alone its share in the elastic energy of the mode counts,
/// which is the slope of ln omega^2 over ln mu at a constant bulk modulus (Rayleigh's principle).
double decay(double lambda, double mu, double viscosity)
{
    const double bulk = lambda + 2 * mu / 3, step = 1e-4;
    const auto omega = [&](double m) { return lowest(bulk - 2 * m / 3, m); };
    const double share = std::log(omega(mu * (1 + step)) / omega(mu * (1 - step))) / step; // of ln omega^2
    return viscosity / mu * std::pow(omega(mu), 2) / 2 * share;
}

TEST(Viscosity, DampsVibrationsOfADiscAsTheoryOfModesSays)
{
    struct Case {
        Material material;
        double lambda, mu;
    };
    for (const Case& c : { Case { soft_neo_hookean(), 1e6, 1e6 }, Case { neo_hookean(), 61e6, 1.26e6 } }) {
        const double omega = lowest(c.lambda, c.mu), viscosity = 0.05 * c.mu / omega,
                     expected = decay(c.lambda, c.mu, viscosity);
        World world;
        GrainStart start;
        start.velocity_gradient = 20 * Mat<2>(Vec<2>(1, -1).asDiagonal()); // has the shape of the mode, nearly
        Grain<2> grain = make_grain(disc_mesh(1200), c.material, start, R, density);
        grain.viscosity = viscosity;
        world.add(grain);
        SmallestCriticalStep<2> stable;
        const double dt = 0.5 * stable({ &grain }, 1);
        // the amplitude of the lowest mode, projected on the strain, over thirty periods
        const double period = 2 * M_PI / omega;
        std::vector<double> time, peak;
        double last = 0, before = 0;
        for (int k = 0; k * dt < 30 * period; ++k) {
            world.step(dt);
            const Mat<2>& F = world.grains[0].motion.mean_gradient;
            const double strain = F(0, 0) - F(1, 1);
            if (last > before && last > strain && last > 0) {
                const double bend = (before + strain) / 2 - last, tilt = (strain - before) / 2; // parabola through three
                time.push_back((k - tilt / (2 * bend)) * dt);
                peak.push_back(std::log(last - tilt * tilt / (4 * bend)));
            }
            before = last;
            last = strain;
        }
        const size_t from = 15; // higher modes have gone
        const double measured = -(peak.back() - peak[from]) / (time.back() - time[from]),
                     frequency = double(peak.size() - 1 - from) / (time.back() - time[from]);
        std::printf("lambda / mu %.0f: decay %.4g 1/s, theory %.4g (%+.2f %%); frequency %+.2f %%; damping ratio %.4f\n",
                    c.lambda / c.mu, measured, expected, 100 * (measured / expected - 1),
                    100 * (frequency * 2 * M_PI / omega - 1), expected / omega);
        EXPECT_NEAR(measured / expected, 1, 0.02); // twice the error of the frequency and some
    }
}

TEST(Viscosity, TakesTheEnergyThatItSays)
{
    World world;
    GrainStart start;
    start.velocity = Vec<2>(1, 2);
    start.velocity_gradient = spin(3000) + (Mat<2>() << 4000, 500, -300, -3500).finished();
    Grain<2> grain = make_grain(disc_mesh(124), neo_hookean(), start);
    grain.viscosity = 0.5;
    world.add(grain);
    SmallestCriticalStep<2> stable;
    const double dt = 0.5 * stable({ &grain }, 1);
    world.step(dt);
    const Sums before(world);
    const double energy = world.energy();
    double dissipated = 0;
    for (int k = 0; k < 3000; ++k) {
        world.step(dt);
        dissipated += world.dissipated().viscous;
    }
    const Sums after(world);
    std::printf("dissipated %.3f of the energy, missing %.1e; momentum %.1e, angular momentum %.1e\n", dissipated / energy,
                (world.energy() + dissipated) / energy - 1,
                (after.momentum - before.momentum).norm() / before.momentum.norm(), after.angular / before.angular - 1);
    EXPECT_GT(dissipated, 0.1 * energy);
    EXPECT_NEAR((world.energy() + dissipated) / energy, 1, 1e-4); // of finite strains
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-11 * before.momentum.norm());
    EXPECT_NEAR(after.angular / before.angular, 1, 1e-10);
}

// Viscous forces alone say whether a step is stable when they are strong.
TEST(Viscosity, IsStableBelowTheEstimatedStep)
{
    for (double viscosity : { 0.1, 10.0, 1000.0 })
        for (double share : { 0.95, 1.3 }) {
            World world;
            GrainStart start;
            start.velocity_gradient = (Mat<2>() << 40, 5, -3, -40).finished();
            Grain<2> grain = make_grain(disc_mesh(124), neo_hookean(), start);
            Random random(3);
            for (double& v : grain.velocity)
                v += random.uniform(-1, 1);
            grain.refresh();
            grain.viscosity = viscosity;
            world.add(grain);
            SmallestCriticalStep<2> stable;
            const double dt = share * stable({ &grain }, 1);
            const double energy = world.energy();
            bool grew = false;
            try {
                for (int k = 0; k < 500 && !grew; ++k) {
                    world.step(dt);
                    grew = !(world.energy() < 10 * energy);
                }
            } catch (const SimulationError&) {
                grew = true;
            }
            std::printf("viscosity %g Pa s, %.2f of the step %.2e s: %s\n", viscosity, share, dt / share,
                        grew ? "grows" : "stable");
            EXPECT_EQ(grew, share > 1);
        }
}

} // namespace
