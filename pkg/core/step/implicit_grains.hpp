// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/barrier_contact.hpp"
#include "step/implicit_body.hpp"
#include "step/stiffness.hpp"

#include <numeric>

namespace softgrain {

/// How an implicit step is to be taken.
struct ImplicitSettings {
    double theta = 1;             ///< weight of the end of the step, 1/2 to 1
    bool quasistatic = false;     ///< no inertia
    double tolerance = 1e-3;      ///< of the balance of forces, and of the contact residual
    double regularisation = 0.02; ///< quasi-static: stiffness per area that holds grains at their centre [shear modulus]
    int most_iterations = 60;     ///< of Newton's method in a step
    int most_stages = 30;         ///< of a quasi-static step
    int threads = 1;
};

/// The grains' part of an implicit step. Theta scheme, u' the displacements sought, h the step (Jean 1999; Acary and
/// Brogliato 2008):
///     v' = v + h [theta f(u') + (1 - theta) f(u)] / m + h b + p / m,    u' = u + h [theta v' + (1 - theta) v]
/// With the contact forces r = p / (theta h), u' makes stationary, r held,
///     E(u') + |u' - target|^2_m / 2 (theta h)^2 - r . x(u'),   target = u + h v + theta h^2 [(1 - theta) f(u) / m + b].
/// Quasi-static: the same with a small stiffness in place of 1 / (theta h)^2 about a centre, at first the prediction, then
/// the place reached (a proximal point method: what holds the grains fades where there is an equilibrium).
template <int Dim> class ImplicitGrains {
public:
    explicit ImplicitGrains(Assembly<Dim>& assembly);

    using Prediction = std::function<Vec<Dim>(const Vec<Dim>&)>; ///< way of a place during the step [m]
    /// Begins a step at the grains' state: targets, and what can be restored.
    void begin(double dt, const ImplicitSettings& settings, const Vec<Dim>& gravity, const Prediction& prediction);
    enum class Start { rest, velocity, prediction };
    /// Lays the search direction from the state at the start to a guess.
    void aim(Start start);
    /// Puts the grains at `share` of the search direction from the base.
    struct Place {
        double potential; ///< [J]
        bool sound;       ///< J > 0 everywhere, all numbers finite
    };
    Place evaluate(double share);
    /// A grain with a point of J <= 0 or no number at the last place evaluated; -1: none.
    int turned_inside_out() const;
    /// Makes the last place evaluated the base.
    void settle();
    /// Quasi-static: holds the grains at the last place evaluated from now on.
    void recentre();
    /// Quasi-static: back to where the grains are held, and holds them four times as stiffly.
    void back_to_centre();
    /// Fits the boxes of the surfaces to the last place evaluated; ways count from it.
    void mark();
    /// Largest way of a surface point since the last mark over its grain's radius, at the last place evaluated.
    double farthest() const { return farthest_; }
    /// Largest way of a surface point along the search direction [radius].
    double reach_of_step() const { return reach_; }

    struct Forces {
        double unbalanced, contact, inertia; ///< norms of the nodal forces; inertia: or what holds the grains [N]
        int worst;                           ///< grain with the largest force that lacks balance
    };
    /// Forces that lack balance at the last place evaluated, under contact forces at the surfaces [N].
    Forces load(const SurfaceField& contact_forces);
    /// Stiffness K, its factor and the compliances of the surfaces. `damping` of each grain adds to the inertia in the search
    /// direction alone, per node mass [Pa]. An old factor does when it is not to be made anew and masses count alike.
    void condense(const std::vector<double>& damping, bool anew);
    const std::vector<const double*>& compliance() const { return compliance_view_; }
    /// Search direction K^-1 of the load and, when given, further surface forces; the way of the surfaces along it [m].
    void solve(SurfaceField& way, const SurfaceField* further = nullptr);

    /// The tools of conjugate gradients with the whole second derivative of the potential, A, K being what is easy to solve
    /// with. A x is a difference of internal forces; what contact forces change along a way comes as surface forces.
    /// Residual of the search direction under these surface forces, and their work with the direction [J].
    double begin_conjugate(const SurfaceField& forces);
    /// y = K^-1 of the residual and, when given, further surface forces; its way; returns y . residual [J].
    double precondition(SurfaceField& way, const SurfaceField* further = nullptr);
    /// p <- y + share p
    void turn_conjugate(double share);
    /// A p less these surface forces; returns p . of it [J].
    double curvature(const SurfaceField& forces);
    /// Search direction and residual a share of p further.
    void go_conjugate(double share);
    /// Makes the search direction the one that `evaluate` goes along; the way of the surfaces along it.
    void take_direction(SurfaceField& way);

    /// Way of the surfaces since the start of the step [m].
    void slide(SurfaceField& way) const;

    /// Takes the last place as the end of the step; velocities follow from the way.
    void accept();
    /// Velocities of the surfaces at the end of the step [m/s].
    void velocities(SurfaceField& velocity);
    /// Puts the surfaces at the start of the step; called again, back.
    void exchange_places();
    /// Gives impulses at the surfaces, `share` times these [N s].
    void strike(const SurfaceField& impulses, double share);
    /// Of the accepted step [J].
    struct Energy {
        double gained;     ///< kinetic and elastic, less the work of body forces
        double exchanged;  ///< changes of kinetic and elastic energies of all grains, without their signs
        double dissipated; ///< by the scheme; quasi-static: work of the contact forces of the last load that is not stored
        double bent;       ///< of it: what linear internal forces would not lose
    };
    Energy energy();
    /// Back to the start of the step.
    void restore();

private:
    static constexpr int most_lanes = 8;

    /// Vectors are [row][Dim][lane] in radii.
    struct Part {
        std::unique_ptr<ImplicitBody<Dim>> body;
        std::vector<size_t> index;                   ///< of the members among all grains
        AlignedVector displacement, velocity, force; ///< at the start of the step
        AlignedVector base, step, stage;
        AlignedVector place, arrived;       ///< displacement evaluated last; velocity at the end of the step
        AlignedVector centre, lift;         ///< the target without body forces, and what they add to it
        AlignedVector inertia;              ///< [lane], 1 / (theta h)^2 in units of the stiffness [Pa]
        AlignedVector held, factored;       ///< inertia and damping, [lane] [Pa]; those of the factor
        AlignedVector rhs, loads, internal; ///< loads: contact forces, or K^-1 of something
        AlignedVector direction, residual, conjugate, product;
        AlignedVector energy; ///< elastic, at the start of the step, [lane] [J/m^Dim]
        AlignedVector per_lane, matrix, compliance;
        double potential = 0, farthest = 0;
        bool sound = true;

        int lanes() const { return body->lanes; }
        int rows() const { return body->pattern->rows; }
        double mass(int row) const { return body->pattern->mass[size_t(row)]; }
        const Grain<Dim>& grain(size_t lane) const { return *body->members[lane]; }
        /// Inertia of a node mass of 1, in units of the stiffness: density radius^2 [Pa s^2].
        double mass_unit(size_t lane) const { return grain(lane).density * grain(lane).radius * grain(lane).radius; }
        size_t at(int row, int d, size_t lane) const { return (size_t(row) * Dim + size_t(d)) * size_t(body->lanes) + lane; }
        /// Calls visit(lane, row, d, index into a vector) for every component of the grains that are there.
        template <class Visit> void each_component(const Visit& visit) const
        {
            for (int r = 0; r < rows(); ++r)
                for (int d = 0; d < Dim; ++d)
                    for (size_t lane = 0; lane < body->members.size(); ++lane)
                        visit(lane, r, d, at(r, d, lane));
        }
        void resize();
    };
    template <class Work> void each_part(const Work& work)
    {
        const int count = int(parts_.size());
#pragma omp parallel for num_threads(team(settings_.threads, parts_.size())) schedule(dynamic)
        for (int b = 0; b < count; ++b)
            work(parts_[size_t(b)]);
    }
    template <class Work> double sum_over_parts(const Work& work)
    {
        std::vector<double> of_part(parts_.size());
        each_part([&](Part& part) { of_part[size_t(&part - parts_.data())] = work(part); });
        return std::accumulate(of_part.begin(), of_part.end(), 0.0);
    }
    static double dot(const Part& part, const AlignedVector& a, const AlignedVector& b);
    void add_surface_forces(const Part& part, const SurfaceField& forces, double share, AlignedVector& rows) const;
    double interpolate(const Part& part, const AlignedVector& rows, SurfaceField& way) const;
    void multiply(Part& part, const AlignedVector& x);

    Assembly<Dim>& assembly_;
    std::vector<Part> parts_;
    std::vector<std::vector<double>> compliance_; ///< [grain]
    std::vector<const double*> compliance_view_;
    SurfaceField start_, mark_; ///< positions at the start of the step and at the last mark [m]
    SurfaceField moved_;        ///< displacement of the surfaces at the last place evaluated [m]
    ImplicitSettings settings_;
    Prediction prediction_;
    double dt_ = 0, farthest_ = 0, reach_ = 0;
};

extern template class ImplicitGrains<2>;

} // namespace softgrain
