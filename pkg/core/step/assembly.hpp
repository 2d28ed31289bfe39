// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit step of all grains: symplectic Euler with Contact Dynamics.
//
//     v* = v + dt f(u) / m + dt g        predict
//     v' = v* + contact impulses / m     (the caller fills the contact problem, a solver solves it)
//     u' = u + dt v'                     correct
//
// Total-Lagrangian grains advance in batches; updated-Lagrangian ones (Grain::updated) one by one, on grids of their own; those in
// flight (Grain::flight) as rigid bodies: undeformed ones that translate or rest, from the start until something comes near
// (Surface::near), and, where a tolerance is given, those that have come to that again.
#pragma once

#include "solver/contact_problem.hpp"
#include "step/local_damping.hpp"
#include "step/seating.hpp"

#include <functional>

namespace softgrain {

/// Energies since the start [J] (J/m in 2D). Elastic and kinetic stand with the grains.
struct EnergyBalance {
    double external_work = 0;       ///< of rigid bodies and body forces on the grains
    double friction = 0;            ///< dissipated by sliding
    double contact_dissipation = 0; ///< dissipated by normal impulses (inelastic impact of surface points)
};

template <int Dim> class Assembly {
public:
    /// Takes the grains in; their order decides nothing but the order of sums.
    /// Of grains that may not fly all deform.
    explicit Assembly(std::vector<Grain<Dim>*> grains, bool may_fly = true);
    /// Hands the node fields back to the grains.
    ~Assembly();
    Assembly(const Assembly&) = delete;
    Assembly& operator=(const Assembly&) = delete;

    /// Of local_damping.hpp, 0 to 1: none to strong [-]. Total-Lagrangian grains alone know it.
    double damping = 0;
    /// Of is_nearly_rigid: which total-Lagrangian grains take off [shear modulus]; 0: none but at the start.
    double rigid_below = 0;
    int flying() const { return int(flights_.size()); }
    /// Velocities of the surfaces without contact impulses. Throws SimulationError when a point has inverted.
    void predict(double dt, const Vec<Dim>& gravity, int threads);
    using Visit = std::function<void(Grain<Dim>&)>;
    /// Takes the surface impulses in, sets them to zero, moves the grains, renews surfaces and motions. Each grain is
    /// shown to `before` and, moved, to `after` while it is in cache, by the thread that works on it; neither may throw.
    /// Throws SimulationError when a value is no longer finite.
    void correct(double dt, int threads, const Visit& before = {}, const Visit& after = {});
    /// Takes nodes that another scheme has moved, with their velocities: smallest J, surfaces and motions. `after` and
    /// errors as in correct.
    void renew(double dt, int threads, const Visit& after = {});
    /// In the grains in the last step [J].
    struct Dissipation {
        double viscous = 0, plastic = 0, numerical = 0;
    };
    Dissipation dissipated() const;
    /// Smallest J of a material point at the last predict or renew, 1 at most.
    double min_J() const;
    /// Work of the solved contacts over the step, with the mean of the velocities before and after it.
    static void account(const ContactProblem<Dim>& problem, EnergyBalance& balance);
    /// Smallest stretches of the grains.
    void evaluate_stretch(int threads);
    /// Elastic energies of the grains, see energy_over_step.
    void evaluate_energy(double dt, int threads);

    const std::vector<Grain<Dim>*>& grains() const { return grains_; }
    /// Of total-Lagrangian ones that deform.
    Seating<Dim>& seats() { return seats_; }
    /// Updated-Lagrangian ones, which no batch holds.
    const std::vector<Grain<Dim>*>& updated() const { return updated_; }

private:
    void land_touched();
    void take_off(const std::vector<char>& ready, double dt);
    bool fly(double dt, int threads, const Visit& before, const Visit& after);
    void push(int b);
    void damp(int b);
    void count_viscous_loss(int b);
    void advance_memory(int b);
    bool observe(int b, double dt, const Visit& after);
    void hand_out(int b, std::vector<double> Surface<Dim>::*field);
    void report_unsound(const std::vector<char>& sound, double dt);
    void report(const std::vector<std::string>& complaints) const; ///< of the updated-Lagrangian grains

    std::vector<Grain<Dim>*> grains_;
    Seating<Dim> seats_;
    std::vector<Grain<Dim>*> flights_, updated_;
    std::vector<double> least_J_;                  ///< of each batch and each updated-Lagrangian grain
    std::vector<Dissipation> dissipated_;          ///< of each grain, in the last step
    std::vector<LocalDamping<Dim>> local_damping_; ///< of each batch, where there is any
    double kick_ = 0;                              ///< time step of the last predict [s]
    Vec<Dim> gravity_ = Vec<Dim>::Zero();          ///< of the same
};

extern template class Assembly<2>;

} // namespace softgrain
