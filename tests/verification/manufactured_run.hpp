// SPDX-License-Identifier: GPL-2.0-or-later
// Grains driven along a manufactured solution, and how far they are from it.
#pragma once

#include "manufactured.hpp"
#include "step/assembly.hpp"
#include "step/critical_step.hpp"

#include <deque>
#include <functional>

namespace softgrain::testing_support {

struct ManufacturedCase {
    Mesh mesh;
    double radius = 1, density = 1;  ///< [m], [kg/m3]
    std::vector<Material> materials; ///< of one grain each; the solution has to hold for all
    double until = 1;                ///< [s]
    double share = 0.5;              ///< of the stable step of the stiffest grain at the smallest stretch of the run
    int steps = 0;                   ///< instead of the share
};

/// Largest errors over the run, each in the L2 norm over the material points.
struct ManufacturedError {
    double displacement = 0; ///< over the largest norm of the exact one
    double velocity = 0;     ///< where velocities stand, half a step behind displacements; over the largest norm
    double stress = 0;       ///< Cauchy stress in the plane, over the shear modulus
};

class ManufacturedRun {
public:
    ManufacturedRun(const Manufactured& solution, const ManufacturedCase& given)
        : solution_(solution)
        , case_(given)
        , mesh_(*case_.mesh)
        , errors_(case_.materials.size())
    {
        const double stretch = smallest_stretch();
        double stable = 1e300;
        for (const Material& material : case_.materials) {
            Grain<2>& grain = grains_.emplace_back(make_grain(case_.mesh, material, {}, case_.radius, case_.density));
            grain.min_stretch = stretch;
            if (case_.steps == 0) stable = std::min(stable, critical_step(grain, unit_critical_step(grain)));
        }
        steps_ = case_.steps ? case_.steps : int(std::ceil(case_.until / (case_.share * stable)));
        dt_ = case_.until / steps_;
        // half a step back by the acceleration that the grid has: at the start there is neither strain nor traction
        std::vector<double> start = projected([&](const Vec<2>& X) { return solution_.velocity(X, 0); });
        const auto acceleration = averaged([&](int p) { return solution_.body_force(place(p), 0); });
        for (size_t i = 0; i < start.size(); ++i)
            start[i] -= dt_ / 2 * acceleration[i];
        for (Grain<2>& grain : grains_)
            grain.velocity = start;
        advance();
    }

    int steps() const { return steps_; }
    const std::vector<ManufacturedError>& errors() const { return errors_; } ///< [grain]
    /// As it is at the end.
    const Grain<2>& grain(int index) const { return grains_[size_t(index)]; }

private:
    const Manufactured& solution_;
    const ManufacturedCase case_;
    const Discretisation<2>& mesh_;
    std::deque<Grain<2>> grains_;
    int steps_ = 0;
    double dt_ = 0;
    std::vector<ManufacturedError> errors_;

    Vec<2> place(int point) const { return case_.radius * mesh_.point_position[size_t(point)]; }

    double smallest_stretch() const
    {
        double smallest = 1;
        for (int k = 0; k <= 20; ++k)
            for (int p = 0; p < mesh_.point_count(); ++p)
                smallest
                    = std::min(smallest, solution_.gradient(place(p), case_.until * k / 20).jacobiSvd().singularValues()[1]);
        return smallest;
    }

    void advance()
    {
        std::vector<Grain<2>*> all;
        for (Grain<2>& grain : grains_)
            all.push_back(&grain);
        Assembly<2> assembly(all, false);
        double largest_u = 0, largest_v = 0;
        for (int k = 0; k < steps_; ++k) {
            const double t = k * dt_;
            const auto gain = averaged([&](int p) { return Vec<2>(dt_ * solution_.body_force(place(p), t)); });
            for (Grain<2>* grain : all) {
                for (size_t i = 0; i < gain.size(); ++i)
                    grain->batch->velocity[i * grain->batch->lanes + grain->lane] += gain[i];
                load_surface(*grain, t);
            }
            assembly.predict(dt_, Vec<2>::Zero(), 1);
            assembly.correct(dt_, 1);
            if ((k + 1) % std::max(1, steps_ / 40) != 0 && k + 1 != steps_) continue;
            for (size_t g = 0; g < grains_.size(); ++g) {
                grains_[g].pull();
                compare(grains_[g], t + dt_, errors_[g], largest_u, largest_v);
            }
        }
        for (ManufacturedError& e : errors_) {
            e.displacement /= largest_u;
            e.velocity /= largest_v;
        }
    }

    /// sum_p V_p N_i f_p / m_i of the masters, lumped as the mass is [radius].
    std::vector<double> averaged(const std::function<Vec<2>(int)>& f) const
    {
        constexpr int stencil = Discretisation<2>::stencil;
        std::vector<double> sum(2 * size_t(mesh_.node_count()), 0);
        for (const auto& block : mesh_.blocks)
            for (int p = block.first_point; p < block.first_point + block.point_count; ++p) {
                const Vec<2> value = mesh_.point_volume[p] * f(p);
                for (int k = 0; k < stencil; ++k)
                    for (int d = 0; d < 2; ++d)
                        sum[2 * size_t(block.node[k]) + d] += mesh_.shape[size_t(p) * stencil + k] * value[d];
            }
        mesh_.each_link([&](int slave, int master, double weight) {
            for (int d = 0; d < 2; ++d)
                sum[2 * size_t(master) + d] += weight * sum[2 * size_t(slave) + d];
        });
        sum.resize(2 * size_t(mesh_.master_count));
        for (size_t i = 0; i < sum.size(); ++i)
            sum[i] *= mesh_.inverse_mass[i / 2] / case_.radius;
        return sum;
    }

    /// Nodal values whose interpolation is the field: 10 iterations of the lumped mass on the consistent one. Values at the
    /// nodes' places would start the run with an error of h^2 / 8 times the second derivatives.
    std::vector<double> projected(const std::function<Vec<2>(const Vec<2>&)>& field) const
    {
        Grain<2> grain = make_grain(case_.mesh, case_.materials[0], {}, case_.radius, case_.density);
        for (int iteration = 0; iteration < 10; ++iteration) {
            const auto now = grain.point_velocities();
            const auto change = averaged([&](int p) { return Vec<2>(field(place(p)) - now[size_t(p)]); });
            for (size_t i = 0; i < change.size(); ++i)
                grain.velocity[i] += change[i];
        }
        return grain.velocity;
    }

    /// Impulses of the boundary traction over the step, at the surface points.
    void load_surface(Grain<2>& grain, double t) const
    {
        for (int p = 0; p < grain.surface.count; ++p) {
            const BoundaryPoint<2>& point = mesh_.surface[p];
            grain.surface.strike(p,
                                 dt_ * case_.radius * point.weight * solution_.traction(case_.radius * point.position, t));
        }
    }

    /// Errors at time t into `error`; norms of the exact fields into the last two.
    void compare(const Grain<2>& grain, double t, ManufacturedError& error, double& exact_u, double& exact_v) const
    {
        const auto x = grain.point_positions(), v = grain.point_velocities();
        const auto stress = grain.cauchy_stresses();
        const Material material { grain.law->name, grain.parameters };
        double du = 0, dv = 0, ds = 0, u2 = 0, v2 = 0; // squares, mean over the grain
        for (int p = 0; p < mesh_.point_count(); ++p) {
            const Vec<2> X = place(p), u = solution_.displacement(X, t), now = solution_.velocity(X, t - dt_ / 2);
            const Mat<2> F = solution_.gradient(X, t), exact = piola_stress(material, F) * F.transpose() / F.determinant();
            const double share = mesh_.point_volume[p] / mesh_.moments.volume;
            du += share * (x[p] - X - u).squaredNorm();
            dv += share * (v[p] - now).squaredNorm();
            ds += share * (stress[p].topLeftCorner<2, 2>() - exact).squaredNorm();
            u2 += share * u.squaredNorm();
            v2 += share * now.squaredNorm();
        }
        error.displacement = std::max(error.displacement, std::sqrt(du));
        error.velocity = std::max(error.velocity, std::sqrt(dv));
        error.stress = std::max(error.stress, std::sqrt(ds) / shear_modulus(material));
        exact_u = std::max(exact_u, std::sqrt(u2));
        exact_v = std::max(exact_v, std::sqrt(v2));
    }
};

} // namespace softgrain::testing_support
