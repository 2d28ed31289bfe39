// SPDX-License-Identifier: GPL-2.0-or-later
// A small scene that moves by explicit steps. Wires the core as its callers do: detect, predict, solve, account, correct.
#pragma once

#include "law/newton_impact.hpp"
#include "solver/adhesion.hpp"
#include "solver/nlgs.hpp"
#include "step/critical_step.hpp"
#include "support/scene.hpp"

#include <map>
#include <omp.h>

namespace softgrain::testing_support {

/// This share of the critical step of a grain as it is [s].
inline double step_of(const Grain<2>& grain, double share)
{
    return share * critical_step(grain, unit_critical_step(grain));
}

class World : public Scene {
public:
    NonlinearGaussSeidel<2> solver { 1e-6, 1000 };
    int threads = omp_get_max_threads();
    std::optional<NewtonImpact<2>> impact;
    std::optional<Adhesion<2>> adhesion;
    double damping = 0;     ///< of local_damping.hpp
    double rigid_below = 0; ///< of Assembly
    std::vector<int> order; ///< in which the assembly takes the grains; none: as they are

    // of the last step
    ContactProblem<2> problem;
    ContactProblem<2> pulls;    ///< of adhesion
    double dt = 0, deepest = 0; ///< [s]; smallest gap [m]
    // since the start
    int sweeps = 0, steps = 0;
    EnergyBalance pulled; ///< by adhesion

    void step(double dt_)
    {
        dt = dt_;
        if (!assembly_) start();
        detect();
        assembly_->predict(dt, gravity, threads);
        gather();
        give(pulls);
        sweeps += solver.solve(problem);
        scatter();
        Assembly<2>::account(problem, balance);
        Assembly<2>::account(pulls, pulled);
        assembly_->correct(dt, threads);
        pass(dt);
        ++steps;
    }

    /// Kinetic and elastic [J/m] of the last step.
    double energy()
    {
        if (!assembly_) start();
        assembly_->evaluate_energy(dt, threads);
        double sum = 0;
        for (const auto& grain : grains)
            sum += grain.motion.kinetic + grain.elastic;
        return sum;
    }
    /// Smallest stretches.
    void evaluate()
    {
        if (!assembly_) start();
        assembly_->evaluate_stretch(threads);
    }
    /// Grains in flight.
    int flying() const { return assembly_->flying(); }
    /// In the grains in the last step [J/m].
    Assembly<2>::Dissipation dissipated() const { return assembly_->dissipated(); }
    /// Hands the fields back to the grains; the next step takes them in again.
    void release() { assembly_.reset(); }
    /// Takes out each grain's place and velocity along x, as a guide along the y axis would.
    void guide()
    {
        release();
        for (auto& grain : grains) {
            const double x = grain.motion.position.x(), v = grain.motion.velocity.x();
            for (size_t i = 0; i < grain.displacement.size(); i += 2) {
                grain.displacement[i] -= x / grain.radius;
                grain.velocity[i] -= v / grain.radius;
            }
            Surface<2>& surface = grain.surface;
            for (size_t i = 0; i < surface.position.size(); i += 2) {
                surface.position[i] -= x;
                surface.velocity[i] -= v;
            }
            surface.min.x() -= x;
            surface.max.x() -= x;
        }
    }

private:
    std::vector<std::pair<ContactPoint<2>*, int>> owners_; ///< of the contacts; number of the plane or -1
    std::vector<int> pulled_planes_;                       ///< of the pulls; number of the plane or -1
    std::map<std::pair<int, int>, Bonds> bonds_;           ///< of a grain and another, or, negative, a plane

    void start()
    {
        std::vector<Grain<2>*> members;
        for (size_t k = 0; k < grains.size(); ++k)
            members.push_back(&grains[order.empty() ? k : size_t(order[k])]);
        for (auto& grain : grains)
            if (adhesion) grain.surface.ahead = adhesion->range;
        assemble(members);
        assembly_->damping = damping;
        assembly_->rigid_below = rigid_below;
    }

    void detect()
    {
        for (auto& grain : grains)
            grain.surface.near = false;
        each_pair([&](auto& contacts, size_t i, size_t j) {
            contacts.update(grains[i].surface, grains[j].surface, dt);
            for (size_t g : { i, j })
                grains[g].surface.near |= !contacts.points.empty();
        });
        each_plane_pair([&](auto& contacts, size_t w, size_t i) {
            const Plane& plane = planes[w];
            contacts.update(grains[i].surface, plane.axis, plane.position, plane.side, std::abs(plane.speed), dt);
            grains[i].surface.near |= !contacts.points.empty();
        });
    }

    void gather(std::vector<ContactPoint<2>>& points, int first, int second, const Vec<2>& drive, int plane)
    {
        static const SignoriniCoulomb<2> law;
        for (auto& p : points) {
            problem.contacts.push_back({ p.on_second ? second : first, p.on_second ? first : second, p.point, p.face,
                                         p.vertex, p.weight, p.normal, p.gap / dt * p.normal, drive, friction, &law,
                                         p.force * dt });
            if (impact) {
                Contact<2>& contact = problem.contacts.back();
                contact.offset = impact->offset(p, contact.offset, problem.relative(contact, &Surface<2>::velocity_before),
                                                problem.relative(contact, &Surface<2>::velocity));
            }
            deepest = std::min(deepest, p.gap);
            owners_.push_back({ &p, plane });
        }
        if (adhesion) pull(points, first, second, plane);
    }

    /// Of the contacts that were added last.
    void pull(const std::vector<ContactPoint<2>>& points, int first, int second, int plane)
    {
        const bool on_second
            = second >= 0 && points_are_of_second(grains[size_t(first)].surface, grains[size_t(second)].surface);
        const auto impulses = adhesion->pulls(points, grains[size_t(on_second ? second : first)].surface, on_second, dt,
                                              bonds_[{ first, plane < 0 ? second : -1 - plane }]);
        for (size_t i = 0; i < points.size(); ++i) {
            if (impulses[i] == 0) continue;
            pulls.contacts.push_back(problem.contacts[problem.contacts.size() - points.size() + i]);
            pulls.contacts.back().impulse = -impulses[i] * points[i].normal;
            pulls.contacts.back().friction = 0;
            pulled_planes_.push_back(plane);
        }
    }

    void gather()
    {
        problem = pulls = {};
        owners_.clear();
        pulled_planes_.clear();
        deepest = 0;
        for (auto& grain : grains)
            problem.bodies.push_back(&grain.surface);
        pulls.bodies = problem.bodies;
        each_pair([&](auto& contacts, size_t i, size_t j) { gather(contacts.points, int(i), int(j), Vec<2>::Zero(), -1); });
        each_plane_pair([&](auto& contacts, size_t w, size_t i) {
            gather(contacts.points, int(i), -1, planes[w].speed * Vec<2>::Unit(planes[w].axis), int(w));
        });
    }

    void scatter()
    {
        plane_force.assign(planes.size(), Vec<2>::Zero());
        for (size_t c = 0; c < problem.contacts.size(); ++c) {
            owners_[c].first->force = problem.contacts[c].impulse / dt;
            load(problem.contacts[c], owners_[c].second);
        }
        for (size_t c = 0; c < pulls.contacts.size(); ++c)
            load(pulls.contacts[c], pulled_planes_[c]);
    }

    void load(const Contact<2>& contact, int plane)
    {
        if (plane >= 0) plane_force[size_t(plane)] -= contact.impulse / dt;
        grains[size_t(contact.body)].surface.strike(contact.point, contact.impulse);
        if (contact.other < 0) return;
        for (int k = 0; k < face_vertices<2>; ++k)
            grains[size_t(contact.other)].surface.strike(contact.vertex[k], -contact.weight[k] * contact.impulse);
    }
};

} // namespace softgrain::testing_support
