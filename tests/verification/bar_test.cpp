// SPDX-License-Identifier: GPL-2.0-or-later
// A slender bar in its first longitudinal mode, free at both ends, in plane strain.
#include "support/shapes.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double length = 1e-2, height = 1e-3, density = 1000, wave_number = M_PI / length;

/// Speed of long longitudinal waves, the square root of E' / rho with E' = E / (1 - nu^2) = 4 mu (lambda + mu) / (lambda + 2 mu).
double bar_speed(double lambda, double mu) { return std::sqrt(4 * mu * (lambda + mu) / (lambda + 2 * mu) / density); }

/// Angular frequency of the lowest symmetric wave in a plate (Lamb 1917) at the wave
/// number of the bar: the plate between y = +-H/2 in plane strain is the bar, with its lateral inertia. With
/// s^2 = k^2 - omega^2 / c_l^2, q^2 = omega^2 / c_t^2 - k^2, both positive here, and a = H/2:
///     (q^2 - k^2)^2 cosh(s a) sin(q a) / q - 4 k^2 s sinh(s a) cos(q a) = 0.
double plate_frequency(double lambda, double mu)
{
    const double k2 = wave_number * wave_number, a = height / 2;
    const auto f = [&](double omega) {
        const double s = std::sqrt(k2 - omega * omega * density / (lambda + 2 * mu));
        const double q = std::sqrt(omega * omega * density / mu - k2);
        return std::pow(q * q - k2, 2) * std::cosh(s * a) * std::sin(q * a) / q
            - 4 * k2 * s * std::sinh(s * a) * std::cos(q * a);
    };
    double lo = 0.97 * wave_number * bar_speed(lambda, mu), hi = wave_number * bar_speed(lambda, mu);
    for (int k = 0; k < 60; ++k) {
        const double middle = (lo + hi) / 2;
        (f(lo) * f(middle) <= 0 ? hi : lo) = middle;
    }
    return lo;
}

struct Bar {
    double frequency, cell_width; ///< [rad/s]; [height]
    int points;
};

/// Frequency of the run over ten half periods, at strains of 1e-4.
Bar vibrate(const Material& material, int cells_across_height)
{
    const double lambda = material.parameters[0], mu = material.parameters[1], c = bar_speed(lambda, mu);
    const auto mesh
        = mesh_of(PolygonOutline(rectangle_vertices(length, height)), 40 * cells_across_height * cells_across_height);
    const double radius = std::sqrt(length * height / M_PI);
    World world;
    Grain<2>& grain = world.add(make_grain(mesh, material, {}, radius, density));
    const double contraction = lambda / (lambda + 2 * mu); // nu / (1 - nu)
    std::vector<double> shape;                             // of the mode along x, at the nodes
    for (int i = 0; i < mesh->master_count; ++i) {
        const Vec<2> X = radius * mesh->node_position[i];
        shape.push_back(std::sin(wave_number * X.x()));
        grain.velocity[2 * i] = 1e-4 * c / radius * shape.back();
        grain.velocity[2 * i + 1] = -1e-4 * c / radius * contraction * wave_number * X.y() * std::cos(wave_number * X.x());
    }
    grain.refresh();
    const double dt = step_of(grain, 0.5);
    std::vector<double> zeros;
    double before = 0;
    while (zeros.size() < 11) {
        world.step(dt);
        grain.pull();
        double now = 0;
        for (size_t i = 0; i < shape.size(); ++i)
            now += mesh->node_mass[i] * shape[i] * grain.displacement[2 * i];
        if (before * now < 0) zeros.push_back(world.time - dt * now / (now - before));
        before = now;
    }
    return { 10 * M_PI / (zeros.back() - zeros.front()), mesh->cell_width * radius / height, mesh->point_count() };
}

// Lumping adds h^2 / 4 per mass to second moments (doc/theory.md, section 2): frequencies are low by (k h)^2 / 8, and the
// lateral inertia, of second moment H^2 / 12, is too large by 3 (h / H)^2. The step raises frequencies by (omega dt)^2 / 24,
// some 5 % of the sum of both.
TEST(VibratingBar, HasTheFrequencyOfTheLowestPlateWave)
{
    for (const auto& [name, material] :
         { std::pair("nu = 0.25", soft_neo_hookean()), std::pair("nu = 0.49", neo_hookean()) }) {
        const double lambda = material.parameters[0], mu = material.parameters[1];
        const double expected = plate_frequency(lambda, mu), long_wave = wave_number * bar_speed(lambda, mu);
        std::printf("%s: %.2f Hz of long waves, sqrt(E' / rho) / 2 L; %.2f Hz with lateral inertia (%+.3f %%)\n", name,
                    long_wave / (2 * M_PI), expected / (2 * M_PI), 100 * (expected / long_wave - 1));
        std::vector<double> error, width;
        for (int across : { 2, 4, 8 }) {
            const Bar bar = vibrate(material, across);
            error.push_back(bar.frequency / expected - 1);
            width.push_back(bar.cell_width);
            const double h = bar.cell_width;
            const double lumping = -std::pow(wave_number * height * h, 2) / 8 + (expected / long_wave - 1) * 3 * h * h;
            std::printf("%s, %d points, h = H / %.0f: %.2f Hz, %+.4f %%; lumping alone %+.4f %%\n", name, bar.points, 1 / h,
                        bar.frequency / (2 * M_PI), 100 * error.back(), 100 * lumping);
            EXPECT_NEAR(error.back() / lumping, 1, 0.1) << name;
        }
        const double order = std::log(error[0] / error[2]) / std::log(width[0] / width[2]);
        std::printf("%s: order %.2f\n", name, order);
        EXPECT_NEAR(order, 2, 0.1) << name;
        EXPECT_LE(std::abs(error[2]), 5e-4) << name;
    }
}

} // namespace
