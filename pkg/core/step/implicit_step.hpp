// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/condensed_contacts.hpp"
#include "solver/contact_turning.hpp"
#include "solver/nlgs.hpp"
#include "step/implicit_grains.hpp"

namespace softgrain {

/// What an implicit step sees besides the grains.
template <int Dim> class ImplicitScene {
public:
    virtual ~ImplicitScene() = default;
    /// Bodies that contacts name: the grains in the order of their assembly, then rigid polygons.
    std::vector<Surface<Dim>*> bodies;
    /// Contact points with a gap below `ahead` radii (of the smaller body) at the start of a step of length dt, with the rigid
    /// bodies where they will be at its end; start values of the forces are those of the last step.
    virtual std::vector<BarrierContact<Dim>> contacts(double ahead, double dt) = 0;
    /// Way of a place during the step if everything moved with the walls [m].
    virtual Vec<Dim> prediction(const Vec<Dim>& place, double dt) const = 0;
};

/// One step of the implicit scheme: the displacements at its end minimise the incremental potential of ImplicitGrains under
/// all gaps >= 0, by a primal-dual interior-point method (Nocedal and Wright 2006, chapter 19; Mehrotra 1992). Each gap g(u)
/// has a slack s > 0 and a force r > 0, with
///     g(u) = s,    r s = kappa,    kappa driven down until Signorini's condition holds to the tolerance.
/// Coulomb's friction is smoothed by the same kappa: a contact that slides by d bears the force
///     t = - b^2 d / (kappa + sqrt(kappa^2 + b^2 d^2)),    b = mu_f r,
/// which tends to sticking below b and sliding at b. b follows r from iteration to iteration; the step ends when
/// both agree. Points that stick slide a little all the same; d goes on counting in the next step, or such slides would add
/// up with the number of steps. Gaps, normals and feet are those of the places that the iterations try.
template <int Dim> class ImplicitStep {
public:
    /// Gaps below are looked at [radius of the smaller body]; looked for anew when a grain has moved by a quarter of it.
    static constexpr double ahead = 0.1;

    explicit ImplicitStep(Assembly<Dim>& assembly);

    struct Outcome {
        bool converged = false;
        std::string trouble;    ///< why not
        int iterations = 0;     ///< of Newton's method
        int stages = 1;         ///< quasi-static: places that the grains were held at
        double held = 0;        ///< quasi-static: what still holds them, over contact forces
        double residual = 0;    ///< of the contacts, Siconos's measure
        double unbalanced = 0;  ///< forces that lack balance over contact forces
        double distance = 0;    ///< mean gap, weighted by the forces [radius of the smaller body]
        double penetration = 0; ///< deepest [radius of the smaller body]
        double dissipated = 0;  ///< by the scheme [J]
        EnergyBalance work;     ///< of the contacts in the step
        /// That the balance of the step lacks, or scheme and contacts create, or for theta < 1 non-linear internal forces make
        /// it off by; over changes of kinetic and elastic energies and what forces that count as none work.
        double missing_energy = 0;
    };
    /// Moves the grains by a step; leaves them at its start when it does not converge. After success `contacts` holds the
    /// contact forces, and velocities and start values for `Assembly::renew` are set.
    Outcome attempt(double dt, const ImplicitSettings& settings, const Vec<Dim>& gravity, ImplicitScene<Dim>& scene);

    /// Takes a step back that was a success.
    void undo() { grains_.restore(); }
    /// Quasi-static: share of the regularisation that the next step begins with. Smaller after a step whose grains were held
    /// too firmly to be in balance at once, larger after one that took many iterations.
    double hold = 1;
    std::vector<BarrierContact<Dim>> contacts;
    /// The contacts as a problem for ContactProblem::residual and Assembly::account.
    ContactProblem<Dim> problem;

private:
    void choose_hold(const Outcome& outcome);
    void make_room(double dt);
    void begin(double dt, const Vec<Dim>& gravity);
    void locate();
    void look_or_locate(double dt);
    void renew_contacts(double dt);
    void start_values();
    void sort_contacts();
    void condense();
    typename ImplicitGrains<Dim>::Forces judge(Outcome& outcome);
    bool find_direction(const Outcome& outcome);
    void refine(const Eigen::VectorXd& change);
    bool take_direction(double dt);
    double merit(double potential) const;
    double contact_residual() const;
    double mean_stiffness() const;
    SurfaceField& contact_forces();
    static void clear(SurfaceField& field);
    Eigen::VectorXd at_contacts(const SurfaceField& way) const;
    SurfaceField& at_surfaces(const Eigen::VectorXd& rows);
    Eigen::VectorXd solve_contacts(double kappa, const Eigen::VectorXd& correction);
    void change_forces(const Eigen::VectorXd& by);
    double largest_share(double BarrierContact<Dim>::*value, double BarrierContact<Dim>::*step) const;
    void fill_problem(double dt);
    void give_impulses(double dt);
    void take_stock(Outcome& outcome);

    static constexpr double fraction_to_boundary = 0.995;
    static constexpr int most_uses_of_factors = 4;

    Assembly<Dim>& assembly_;
    ImplicitGrains<Dim> grains_;
    CondensedContacts<Dim> system_;
    ContactTurning<Dim> turning_;
    NonlinearGaussSeidel<Dim> velocity_solver_;
    ImplicitScene<Dim>* scene_ = nullptr;
    ImplicitSettings settings_;
    typename ImplicitGrains<Dim>::Place place_ {};
    SurfaceField way_, forces_, moved_, conjugate_;
    std::vector<int> points_;
    /// Of the contact system: way along normals and tangents without changes of forces, and the one wished for.
    Eigen::VectorXd free_, target_;
    ContactProblem<Dim> begun_; ///< impulses at the start of a step
    double kappa_ = 0, damping_ = 0;
    bool sorted_ = false;      ///< contacts into those that count in the linear system and those that stand off
    int factor_age_ = 0;       ///< iterations that the factors have served
    double shear_modulus_ = 0; ///< the largest of a grain [Pa]
    double least_force_ = 0;   ///< forces below count as none: 1e-4 shear moduli times radius a grain [N]
};

extern template class ImplicitStep<2>;

} // namespace softgrain
