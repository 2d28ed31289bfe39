// SPDX-License-Identifier: GPL-2.0-or-later
// A small scene that moves by implicit steps.
#pragma once

#include "step/implicit_run.hpp"
#include "support/scene.hpp"

#include <omp.h>

namespace softgrain::testing_support {

class ImplicitWorld : public Scene, private ImplicitScene<2> {
public:
    ImplicitSettings settings;
    ImplicitWorld() { settings.threads = omp_get_max_threads(); }

    ImplicitStep<2>::Outcome last; ///< of the last substep
    // since the start
    int iterations = 0, substeps = 0, cuts = 0;
    double worst_penetration = 0, worst_residual = 0; ///< as in Outcome
    double dissipated = 0;                            ///< by the scheme [J/m]
    double flowed = 0;                                ///< dissipated by plastic flow [J/m]

    void step(double dt)
    {
        if (!run_) start();
        run_->advance(dt, settings, gravity, *this, [&](double h, const ImplicitStep<2>::Outcome& outcome) {
            last = outcome;
            worst_penetration = std::max(worst_penetration, outcome.penetration);
            worst_residual = std::max(worst_residual, outcome.residual);
            balance.external_work += outcome.work.external_work;
            balance.friction += outcome.work.friction;
            balance.contact_dissipation += outcome.work.contact_dissipation;
            plane_force.assign(planes.size(), Vec<2>::Zero());
            for (size_t c = 0; c < run_->step.contacts.size(); ++c) {
                const auto& contact = run_->step.contacts[c];
                if (contact.other < 0) plane_force[plane_of_[c]] -= contact.total();
                source_[c]->force = contact.total();
                source_[c]->creep = contact.creep;
            }
            assembly_->renew(h, settings.threads);
            flowed += assembly_->dissipated().plastic;
            pass(h);
        });
        iterations += run_->report.iterations;
        substeps += run_->report.substeps;
        cuts += run_->report.cuts;
        dissipated += run_->report.dissipated;
    }
    /// Elastic and, unless quasi-static, kinetic [J/m].
    double energy()
    {
        assembly_->evaluate_energy(0, 1);
        double kinetic = 0, elastic = 0;
        for (const auto& grain : grains) {
            kinetic += grain.motion.kinetic;
            elastic += grain.elastic;
        }
        return settings.quasistatic ? elastic : kinetic + elastic;
    }
    /// Forces of a plane on the points of a grain in the last step [N/m]: (point, force).
    std::vector<std::pair<int, Vec<2>>> forces_of_plane(size_t plane, size_t grain)
    {
        std::vector<std::pair<int, Vec<2>>> forces;
        each_plane_pair([&](const auto& contacts, size_t w, size_t i) {
            if (w != plane || i != grain) return;
            for (const auto& point : contacts.points)
                forces.push_back({ point.point, point.force });
        });
        return forces;
    }
    double min_J() const { return assembly_->min_J(); }

private:
    std::optional<ImplicitRun<2>> run_;
    std::vector<ContactPoint<2>*> source_; ///< of the contacts
    std::vector<size_t> plane_of_;         ///< number of the plane, where a contact is with one

    void start()
    {
        assemble(pointers(grains), false);
        // the assembly keeps the order
        for (Grain<2>* grain : assembly_->grains())
            bodies.push_back(&grain->surface);
        run_.emplace(*assembly_);
    }

    /// What contacts with grains and planes have in common; appended.
    BarrierContact<2>& append(std::vector<BarrierContact<2>>& found, ContactPoint<2>& point, size_t body, double size,
                              size_t plane)
    {
        source_.push_back(&point);
        plane_of_.push_back(plane);
        BarrierContact<2>& c = found.emplace_back();
        c.body = int(body);
        c.other = -1;
        c.point = point.point;
        c.friction = friction;
        c.size = size;
        c.normal = point.normal;
        c.force = std::max(0.0, point.force.dot(point.normal));
        c.shear = point.force.dot(c.tangent());
        c.creep = point.creep;
        return c;
    }
    std::vector<BarrierContact<2>> contacts(double ahead, double dt) override
    {
        std::vector<BarrierContact<2>> found;
        source_.clear();
        plane_of_.clear();
        each_pair([&](auto& contacts, size_t i, size_t j) {
            const Surface<2>&a = grains[i].surface, &b = grains[j].surface;
            const double size = std::min(a.size, b.size);
            contacts.look(a, b, ahead * size);
            for (auto& point : contacts.points) {
                auto& c = append(found, point, point.on_second ? j : i, size, 0);
                c.other = int(point.on_second ? i : j);
                c.face = point.face;
                c.let = point.let;
            }
        });
        each_plane_pair([&](auto& contacts, size_t w, size_t i) {
            const Surface<2>& surface = grains[i].surface;
            const Plane& plane = planes[w];
            contacts.look(surface, plane.axis, plane.position, plane.side,
                          ahead * surface.size + std::abs(plane.speed) * dt);
            for (auto& point : contacts.points) {
                auto& c = append(found, point, i, surface.size, w);
                c.plane = plane.side * (plane.position + dt * plane.speed);
                c.drive = dt * plane.speed * Vec<2>::Unit(plane.axis);
            }
        });
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
