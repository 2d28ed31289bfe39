// SPDX-License-Identifier: GPL-2.0-or-later
// A small scene for the implicit scheme: soft grains, rigid planes that move at given speeds, all pairs tested for contact.
#pragma once

#include "contact/narrow_phase.hpp"
#include "step/implicit_run.hpp"
#include "support/grains.hpp"
#include "support/world.hpp"

#include <deque>
#include <optional>

namespace softgrain::testing_support {

class ImplicitWorld : private ImplicitScene<2> {
public:
    std::deque<Grain<2>> grains; ///< addresses hold
    std::vector<Plane> planes;
    ImplicitSettings settings;
    double friction = 0;
    Vec<2> gravity = Vec<2>::Zero();

    double time = 0, kinetic = 0, elastic = 0, dissipated = 0;
    EnergyBalance balance;
    std::vector<Vec<2>> plane_force; ///< at the end of the last step [N/m]
    ImplicitStep<2>::Outcome last;
    int iterations = 0, substeps = 0, cuts = 0;
    double worst_penetration = 0, worst_residual = 0;

    Grain<2>& add(const Grain<2>& grain)
    {
        grains.push_back(grain);
        grains.back().id = int(grains.size()) - 1;
        return grains.back();
    }

    void step(double dt)
    {
        if (!run_) start();
        run_->advance(dt, settings, gravity, *this, [&](double h, const ImplicitStep<2>::Outcome& outcome) {
            last = outcome;
            worst_penetration = std::max(worst_penetration, outcome.penetration);
            worst_residual = std::max(worst_residual, outcome.residual);
            Assembly<2>::account(run_->step.problem, balance);
            plane_force.assign(planes.size(), Vec<2>::Zero());
            for (size_t c = 0; c < run_->step.contacts.size(); ++c) {
                const auto& contact = run_->step.contacts[c];
                if (contact.other < 0) plane_force[plane_of_[c]] -= contact.total();
                source_[c]->force = contact.total();
            }
            assembly_->renew(h, settings.threads);
            for (Plane& plane : planes)
                plane.position += h * plane.speed;
        });
        iterations += run_->report.iterations;
        substeps += run_->report.substeps;
        cuts += run_->report.cuts;
        dissipated += run_->report.dissipated;
        time += dt;
    }
    double total_energy()
    {
        assembly_->evaluate_energy(0, 1);
        kinetic = elastic = 0;
        for (const auto& grain : grains) {
            kinetic += grain.motion.kinetic;
            elastic += grain.elastic;
        }
        return settings.quasistatic ? elastic : kinetic + elastic;
    }
    size_t contact_count() const { return run_->step.contacts.size(); }
    double min_J() const { return assembly_->min_J(); }

private:
    std::optional<Assembly<2>> assembly_;
    std::optional<ImplicitRun<2>> run_;
    std::vector<PairContacts<2>> pairs_;        ///< of i < j
    std::vector<PlaneContacts<2>> plane_pairs_; ///< [plane][grain]
    std::vector<ContactPoint<2>*> source_;
    std::vector<size_t> plane_of_;

    void start()
    {
        std::vector<Grain<2>*> members;
        for (auto& grain : grains)
            members.push_back(&grain);
        assembly_.emplace(members);
        // the assembly keeps the order
        for (Grain<2>* grain : assembly_->grains())
            bodies.push_back(&grain->surface);
        run_.emplace(*assembly_);
        pairs_.resize(grains.size() * (grains.size() - 1) / 2);
        plane_pairs_.resize(planes.size() * grains.size());
    }

    std::vector<BarrierContact<2>> contacts(double ahead, double dt) override
    {
        std::vector<BarrierContact<2>> found;
        source_.clear();
        plane_of_.clear();
        size_t pair = 0;
        for (size_t i = 0; i < grains.size(); ++i)
            for (size_t j = i + 1; j < grains.size(); ++j) {
                auto& contacts = pairs_[pair++];
                Surface<2>&a = grains[i].surface, &b = grains[j].surface;
                const double size = std::min(a.size, b.size);
                contacts.look(a, b, ahead * size);
                for (auto& point : contacts.points) {
                    BarrierContact<2> c {};
                    c.body = int(point.on_second ? j : i);
                    c.other = int(point.on_second ? i : j);
                    c.point = point.point;
                    c.face = point.face;
                    c.let = point.let;
                    c.friction = friction;
                    c.size = size;
                    c.normal = point.normal;
                    c.force = std::max(0.0, point.force.dot(point.normal));
                    c.shear = point.force.dot(c.tangent());
                    found.push_back(c);
                    source_.push_back(&point);
                    plane_of_.push_back(0);
                }
            }
        for (size_t w = 0; w < planes.size(); ++w)
            for (size_t i = 0; i < grains.size(); ++i) {
                auto& contacts = plane_pairs_[w * grains.size() + i];
                const Plane& plane = planes[w];
                contacts.look(grains[i].surface, plane.axis, plane.position, plane.side,
                              ahead * grains[i].surface.size + std::abs(plane.speed) * dt);
                for (auto& point : contacts.points) {
                    BarrierContact<2> c {};
                    c.body = int(i);
                    c.other = -1;
                    c.point = point.point;
                    c.normal = point.normal;
                    c.plane = plane.side * (plane.position + dt * plane.speed);
                    c.drive = dt * plane.speed * Vec<2>::Unit(plane.axis);
                    c.friction = friction;
                    c.size = grains[i].surface.size;
                    c.force = std::max(0.0, point.force.dot(point.normal));
                    c.shear = point.force.dot(c.tangent());
                    found.push_back(c);
                    source_.push_back(&point);
                    plane_of_.push_back(w);
                }
            }
        return found;
    }
    Vec<2> prediction(const Vec<2>& place, double dt) const override
    {
        Vec<2> way = Vec<2>::Zero();
        for (int axis : { 0, 1 }) {
            const Plane *low = nullptr, *high = nullptr;
            for (const Plane& plane : planes)
                if (plane.axis == axis) (plane.side > 0 ? low : high) = &plane;
            if (!low || !high) continue;
            const double share = (place[axis] - low->position) / (high->position - low->position);
            way[axis] = dt * (low->speed + share * (high->speed - low->speed));
        }
        return way;
    }
};

} // namespace softgrain::testing_support
