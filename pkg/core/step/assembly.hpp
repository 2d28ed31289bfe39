// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit step of all grains: symplectic Euler with Contact Dynamics.
//
//     v* = v + dt f(u) / m + dt g        predict
//     v' = v* + contact impulses / m     (the caller fills the contact problem, a solver solves it)
//     u' = u + dt v'                     correct
//
// Total-Lagrangian grains advance in batches; updated-Lagrangian ones (Grain::updated) one by one, on grids of their own.
// A batch of grains at rest, undeformed, costs nothing until a load, an impulse or a velocity given by hand wakes it.
#pragma once

#include "solver/contact_problem.hpp"
#include "step/grain.hpp"
#include "step/local_damping.hpp"

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
    explicit Assembly(std::vector<Grain<Dim>*> grains);
    /// Hands the node fields back to the grains.
    ~Assembly();
    Assembly(const Assembly&) = delete;
    Assembly& operator=(const Assembly&) = delete;

    /// Of local_damping.hpp, 0 to 1: none to strong [-]. Total-Lagrangian grains alone know it.
    double damping = 0;
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
    /// Elastic energies of the grains over the last step, 2 E(u - dt v / 2) - [E(u) + E(u - dt v)] / 2. Velocities stand
    /// half a step behind displacements; with the kinetic energy this is what symplectic Euler conserves, exactly where
    /// the force is linear (for one spring, k u_n u_(n+1) / 2), and it differs from E by O(dt^2).
    void evaluate_energy(double dt, int threads);

    const std::vector<Grain<Dim>*>& grains() const { return grains_; }
    int batch_count() const { return int(batches_.size()); }
    Batch<Dim>& batch(int b) { return *batches_[b]; }
    const std::vector<Grain<Dim>*>& members(int b) const { return members_[b]; }
    /// Updated-Lagrangian ones, which no batch holds.
    const std::vector<Grain<Dim>*>& updated() const { return updated_; }

private:
    void put_in_batches(std::vector<Grain<Dim>*> group);
    bool is_at_rest(int b);
    double viscous_loss(int b) const;
    double advance_memory(int b);
    bool observe(int b, double dt, const Visit& after);
    void hand_out(int b, std::vector<double> Surface<Dim>::*field);
    void report_unsound(const std::vector<char>& sound, double dt);
    void report(const std::vector<std::string>& complaints) const; ///< of the updated-Lagrangian grains

    std::vector<Grain<Dim>*> grains_;
    std::vector<std::unique_ptr<Batch<Dim>>> batches_;
    std::vector<std::vector<Grain<Dim>*>> members_; ///< of each batch
    std::vector<Grain<Dim>*> updated_;
    std::vector<double> least_J_;                  ///< of each batch, then of each updated-Lagrangian grain
    std::vector<Dissipation> dissipated_;          ///< of each batch, in the last step
    std::vector<LocalDamping<Dim>> local_damping_; ///< of each batch, where there is any
    std::vector<char> asleep_;                     ///< of each batch: at rest since it is here
};

extern template class Assembly<2>;

} // namespace softgrain
