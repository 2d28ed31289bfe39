// SPDX-License-Identifier: GPL-2.0-or-later
// A grain and a free rigid disc that meet: balances of momentum and energy.
#include "contact/narrow_phase.hpp"
#include "solver/nlgs.hpp"
#include "step/assembly.hpp"
#include "step/critical_step.hpp"
#include "support/grains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// A grain of radius 1 mm at rest, and a disc that flies into it off centre, turning.
struct Impact {
    Grain<2> grain = make_grain(disc_mesh(124), neo_hookean());
    Surface<2> surface;
    RigidBody<2> body;
    double radius, mass, friction;
    EnergyBalance balance;
    int touching = 0;

    Impact(double radius_, double mass_ratio, double friction_, double share = 0.5)
        : radius(radius_)
        , mass(mass_ratio * grain.mass())
        , friction(friction_)
    {
        surface.kind = Surface<2>::Kind::round;
        surface.size = radius;
        surface.rigid = &body;
        body.centre = Vec<2>(1.05e-3 + radius, 0.3e-3);
        body.twist << -2, 0.3, 800;
        body.mobility.setZero();
        body.mobility.diagonal() << 1 / mass, 1 / mass, 2 / (mass * radius * radius);
        dt = share * critical_step(grain, unit_critical_step(grain));
        assembly = std::make_unique<Assembly<2>>(std::vector<Grain<2>*> { &grain });
    }

    void step()
    {
        surface.resize(101);
        for (int p = 0; p < surface.count; ++p) {
            const double angle = 2 * M_PI * p / surface.count;
            const Vec<2> place = body.centre + radius * Vec<2>(std::cos(angle), std::sin(angle));
            Eigen::Map<Vec<2>>(&surface.position[size_t(2) * p]) = place;
            surface.v(p) = body.lever(place) * body.twist;
        }
        surface.velocity_before = surface.velocity;
        body.before = body.twist;
        surface.speed = body.twist.head<2>().norm() + radius * std::abs(body.twist[2]);
        surface.travel += dt * surface.speed;
        surface.bound();
        pair.update(surface, grain.surface, dt);
        assembly->predict(dt, Vec<2>::Zero(), 1);
        ContactProblem<2> problem;
        problem.bodies = { &surface, &grain.surface };
        for (const auto& p : pair.points)
            problem.add({ p.on_second, !p.on_second, p.point, p.face, p.vertex, p.weight, p.normal, p.gap / dt * p.normal,
                          Vec<2>::Zero(), friction, &law, p.force * dt });
        NonlinearGaussSeidel<2>(1e-8).solve(problem);
        Assembly<2>::account(problem, balance);
        touching += std::any_of(problem.contacts.begin(), problem.contacts.end(),
                                [](const auto& c) { return c.impulse.norm() > 0; });
        for (size_t c = 0; c < problem.contacts.size(); ++c) {
            const Contact<2>& contact = problem.contacts[c];
            pair.points[c].force = contact.impulse / dt;
            if (contact.body == 1) grain.surface.strike(contact.point, contact.impulse);
            for (int k = 0; contact.other == 1 && k < face_vertices<2>; ++k)
                grain.surface.strike(contact.vertex[k], -contact.weight[k] * contact.impulse);
        }
        assembly->correct(dt, 1);
        body.centre += dt * body.twist.head<2>();
    }

    /// Momentum along x and y, and angular momentum about the origin.
    Vec<3> momentum() const
    {
        const auto of = [](double m, const Vec<2>& x, const Vec<2>& v, double spin) {
            return Vec<3>(m * v[0], m * v[1], m * (x[0] * v[1] - x[1] * v[0]) + spin);
        };
        return of(grain.mass(), grain.motion.position, grain.motion.velocity, grain.motion.angular_momentum[0])
            + of(mass, body.centre, body.twist.head<2>(), body.twist[2] / body.mobility(2, 2));
    }
    double energy_of_body() const
    {
        return mass * body.twist.head<2>().squaredNorm() / 2 + body.twist[2] * body.twist[2] / body.mobility(2, 2) / 2;
    }
    double energy()
    {
        assembly->evaluate_energy(dt, 1);
        return energy_of_body() + grain.motion.kinetic + grain.elastic;
    }
    double lost() const { return balance.friction + balance.contact_dissipation; }

    double dt;
    std::unique_ptr<Assembly<2>> assembly;

private:
    PairContacts<2> pair;
    SignoriniCoulomb<2> law;
};

void expect_balanced(double radius, double mass_ratio, double friction)
{
    Impact impact(radius, mass_ratio, friction);
    const Vec<3> before = impact.momentum();
    const double energy = impact.energy(), kinetic = impact.energy_of_body();
    for (int i = 0; i < 1500; ++i)
        impact.step();
    const Vec<3> change = impact.momentum() - before;
    const double size = impact.mass * 2;
    EXPECT_GT(impact.touching, 3);
    EXPECT_LE(change.head<2>().norm(), 1e-13 * std::max(size, impact.grain.mass()));
    EXPECT_LE(std::abs(change[2]), 1e-13 * 1e-3 * std::max(size, impact.grain.mass())) << "friction makes no couple";
    EXPECT_GE(impact.balance.contact_dissipation, 0);
    EXPECT_GE(impact.balance.friction, -1e-15 * energy);
    const double lacking = (impact.energy() + impact.lost()) / energy - 1;
    EXPECT_LE(std::abs(lacking), 1e-3);
    EXPECT_NEAR(impact.balance.external_work, kinetic - impact.energy_of_body(), 1e-12 * energy) << "work on the grain";
    std::printf("disc of %.1f radii and mass ratio %.0e, friction %.1f: momentum %.1e %.1e %.1e, energy %.1e, lost %.1e\n",
                radius / 1e-3, mass_ratio, friction, change[0] / size, change[1] / size, change[2] / size / 1e-3, lacking,
                impact.lost() / energy);
}

TEST(FreeRigidDisc, KeepsMomentumAngularMomentumAndEnergy)
{
    for (double radius : { 0.5e-3, 2e-3 }) // its points on the grain's faces, and the other way round
        for (double ratio : { 0.01, 1.0, 100.0 })
            for (double friction : { 0.0, 0.4 })
                expect_balanced(radius, ratio, friction);
}

} // namespace
