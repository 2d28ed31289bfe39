// SPDX-License-Identifier: GPL-2.0-or-later
// A small scene: soft grains, rigid planes that move at given speeds, all pairs tested for contact. Wires the core
// as its callers do: detect, predict, solve, account, correct.
#pragma once

#include "contact/narrow_phase.hpp"
#include "solver/nlgs.hpp"
#include "step/assembly.hpp"
#include "step/critical_step.hpp"
#include "support/grains.hpp"

#include <deque>
#include <optional>

namespace softgrain::testing_support {

struct Plane {
    int axis, side;         ///< grains stand on the `side` (+1, -1) of x[axis] = position
    double position, speed; ///< [m], [m/s] along the axis
};

class World {
public:
    std::deque<Grain<2>> grains; ///< addresses hold
    std::vector<Plane> planes;
    NonlinearGaussSeidel<2> solver { 1e-6, 1000 };
    double friction = 0;
    Vec<2> gravity = Vec<2>::Zero();
    int threads = 1;
    std::vector<int> order; ///< in which the assembly takes the grains; none: as they are

    // of the last step
    ContactProblem<2> problem;
    double dt = 0, deepest = 0;      ///< [s]; smallest gap [m]
    std::vector<Vec<2>> plane_force; ///< on the planes [N/m]
    // since the start
    EnergyBalance balance;
    double time = 0;
    int sweeps = 0, steps = 0;

    Grain<2>& add(const Grain<2>& grain)
    {
        grains.push_back(grain);
        grains.back().id = int(grains.size()) - 1;
        return grains.back();
    }

    void step(double dt_)
    {
        dt = dt_;
        if (!assembly_) start();
        detect();
        assembly_->predict(dt, gravity, threads);
        gather();
        sweeps += solver.solve(problem);
        scatter();
        Assembly<2>::account(problem, balance);
        assembly_->correct(dt, threads);
        for (Plane& plane : planes)
            plane.position += dt * plane.speed;
        time += dt;
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
    std::optional<Assembly<2>> assembly_;
    std::vector<PairContacts<2>> pairs_;                   ///< of i < j
    std::vector<PlaneContacts<2>> plane_pairs_;            ///< [plane][grain]
    std::vector<std::pair<ContactPoint<2>*, int>> owners_; ///< of the contacts; number of the plane or -1

    void start()
    {
        std::vector<Grain<2>*> members;
        for (size_t k = 0; k < grains.size(); ++k)
            members.push_back(&grains[order.empty() ? k : size_t(order[k])]);
        assembly_.emplace(members);
        pairs_.resize(grains.size() * (grains.size() - 1) / 2);
        plane_pairs_.resize(planes.size() * grains.size());
    }

    void detect()
    {
        size_t pair = 0;
        for (size_t i = 0; i < grains.size(); ++i)
            for (size_t j = i + 1; j < grains.size(); ++j)
                pairs_[pair++].update(grains[i].surface, grains[j].surface, dt);
        for (size_t w = 0; w < planes.size(); ++w)
            for (size_t i = 0; i < grains.size(); ++i)
                plane_pairs_[w * grains.size() + i].update(grains[i].surface, planes[w].axis, planes[w].position,
                                                           planes[w].side, std::abs(planes[w].speed), dt);
    }

    void add(std::vector<ContactPoint<2>>& points, int first, int second, const Vec<2>& drive, int plane)
    {
        static const SignoriniCoulomb<2> law;
        for (auto& p : points) {
            problem.contacts.push_back({ p.on_second ? second : first, p.on_second ? first : second, p.point, p.face,
                                         p.vertex, p.weight, p.normal, p.gap / dt, drive, friction, &law, p.force * dt });
            deepest = std::min(deepest, p.gap);
            owners_.push_back({ &p, plane });
        }
    }

    void gather()
    {
        problem = {};
        owners_.clear();
        deepest = 0;
        for (auto& grain : grains)
            problem.bodies.push_back(&grain.surface);
        const int count = int(grains.size());
        size_t pair = 0;
        for (int i = 0; i < count; ++i)
            for (int j = i + 1; j < count; ++j)
                add(pairs_[pair++].points, i, j, Vec<2>::Zero(), -1);
        for (size_t w = 0; w < planes.size(); ++w)
            for (int i = 0; i < count; ++i)
                add(plane_pairs_[w * grains.size() + i].points, i, -1, planes[w].speed * Vec<2>::Unit(planes[w].axis),
                    int(w));
    }

    void scatter()
    {
        plane_force.assign(planes.size(), Vec<2>::Zero());
        for (size_t c = 0; c < problem.contacts.size(); ++c) {
            const Contact<2>& contact = problem.contacts[c];
            owners_[c].first->force = contact.impulse / dt;
            if (owners_[c].second >= 0) plane_force[owners_[c].second] -= contact.impulse / dt;
            give(grains[contact.body].surface, contact.point, contact.impulse);
            if (contact.other < 0) continue;
            for (int k = 0; k < face_vertices<2>; ++k)
                give(grains[contact.other].surface, contact.vertex[k], -contact.weight[k] * contact.impulse);
        }
    }
    static void give(Surface<2>& surface, int point, const Vec<2>& impulse)
    {
        for (int d = 0; d < 2; ++d)
            surface.impulse[2 * point + d] += impulse[d];
    }
};

} // namespace softgrain::testing_support
