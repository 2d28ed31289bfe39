// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/untangling.hpp"

#include "base/skyline.hpp"
#include "contact/narrow_phase.hpp"
#include "step/stiffness_pattern.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace softgrain {

template <int Dim> UntanglingEnergy<Dim>::UntanglingEnergy(const Mat<Dim>& F)
{
    static_assert(Dim == 2, "the cofactor, and the second derivative of J, of the plane");
    const double J = F.determinant(), a = (F.squaredNorm() + J * J + 1) / (4 * J);
    const double by_J = 0.5 - a / J, by_JJ = (0.5 - 2 * by_J) / J, by_JF = -0.5 / (J * J); // of a
    using Vector = Eigen::Matrix<double, size, 1>;
    using Matrix = Eigen::Matrix<double, size, size>;
    Vector f, cof;
    f << F(0, 0), F(0, 1), F(1, 0), F(1, 1);
    cof << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
    Matrix bend = Matrix::Zero(); // d2J/dF2
    bend(0, 3) = bend(3, 0) = 1;
    bend(1, 2) = bend(2, 1) = -1;
    const Vector da = 0.5 / J * f + by_J * cof;
    const Matrix dda = 0.5 / J * Matrix::Identity() + by_J * bend + by_JJ * cof * cof.transpose()
        + by_JF * (f * cof.transpose() + cof * f.transpose());
    value = std::pow(a, 4);
    slope = 4 * std::pow(a, 3) * da;
    const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(4 * std::pow(a, 3) * dda + 12 * a * a * da * da.transpose());
    curvature
        = spectrum.eigenvectors() * spectrum.eigenvalues().cwiseMax(0).asDiagonal() * spectrum.eigenvectors().transpose();
}

namespace {

    /// The nodes of one grain on their way, in the rows of its stiffness.
    template <int Dim> class Untangling {
    public:
        explicit Untangling(const Grain<Dim>& grain)
            : pattern_(*grain.mesh)
        {
            for (int r = 0; r < pattern_.rows; ++r)
                for (int d = 0; d < Dim; ++d)
                    wished_.push_back(grain.displacement[size_t(Dim) * pattern_.master[r] + d]);
            place_ = wished_;
        }

        /// To the undeformed grain that is nearest to the place wished for.
        void straighten()
        {
            Vec<Dim> centre = Vec<Dim>::Zero();
            double mass = 0, along = 0, across = 0;
            each_row([&](const Vec<Dim>& X, const Vec<Dim>& x, double m, double*) {
                mass += m;
                centre += m * x;
                along += m * X.dot(x);
                across += m * (X.x() * x.y() - X.y() * x.x());
            });
            centre /= mass;
            const Mat<Dim> turned = Eigen::Rotation2Dd(std::atan2(across, along)).toRotationMatrix();
            each_row([&](const Vec<Dim>& X, const Vec<Dim>&, double, double* u) {
                Eigen::Map<Vec<Dim>> { u } = centre + turned * X - X;
            });
        }

        double least_J() const
        {
            double least = 1e300;
            each_point([&](const auto&, int, const Mat<Dim>& F) { least = std::min(least, F.determinant()); }, place_);
            return least;
        }

        /// To the least of the energy with this hold, by Newton's method.
        void relax(double hold)
        {
            for (int step = 0; step < most_steps && advance(hold); ++step) { }
        }

        void hand_over(Grain<Dim>& grain) const
        {
            for (int r = 0; r < pattern_.rows; ++r)
                for (int d = 0; d < Dim; ++d)
                    grain.displacement[size_t(Dim) * pattern_.master[r] + d] = place_[size_t(Dim) * r + d];
        }

    private:
        static constexpr int points = power(2, Dim);
        static constexpr int most_steps = 50;
        static constexpr double nothing = 1e-6, sufficient = 1e-4, least_share = 1e-6; ///< of the search along a direction

        /// Calls visit(X, x, mass, displacement) for every row, undeformed place and place.
        template <class Visit> void each_row(const Visit& visit)
        {
            for (int r = 0; r < pattern_.rows; ++r) {
                double* const u = &place_[size_t(Dim) * r];
                const Vec<Dim>& X = pattern_.position[r];
                visit(X, X + Eigen::Map<const Vec<Dim>>(u), pattern_.mass[r], u);
            }
        }

        /// Calls visit(region, point in it, F).
        template <class Visit> void each_point(const Visit& visit, const std::vector<double>& displacement) const
        {
            for (const auto& region : pattern_.regions) {
                Tensor<Dim, double> F[points];
                pattern_.deform(region, displacement.data(), F);
                for (int q = 0; q < points; ++q)
                    visit(region, q, Eigen::Map<const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(&F[q].at[0][0]));
            }
        }

        /// A step of Newton's method; false when it leads nowhere.
        bool advance(double hold)
        {
            std::vector<double> direction(place_.size()), tried(place_.size());
            const double fall = find_direction(hold, direction), before = energy(hold, place_);
            if (!(fall > nothing * before)) return false;
            for (double share = 1; share > least_share; share /= 2) {
                for (size_t i = 0; i < tried.size(); ++i)
                    tried[i] = place_[i] + share * direction[i];
                if (!(energy(hold, tried) < before - sufficient * share * fall)) continue;
                place_ = tried;
                return true;
            }
            return false;
        }

        /// No number where a point has J <= 0.
        double energy(double hold, const std::vector<double>& displacement) const
        {
            double sum = 0;
            for (size_t i = 0; i < displacement.size(); ++i) {
                const double way = displacement[i] - wished_[i];
                sum += 0.5 * hold * pattern_.mass[i / Dim] * way * way;
            }
            each_point(
                [&](const auto& region, int, const Mat<Dim>& F) {
                    sum += F.determinant() > 0 ? region.volume / points * UntanglingEnergy<Dim>(F).value : std::nan("");
                },
                displacement);
            return sum;
        }

        /// Returns how fast the energy falls along the direction; 0: there is none.
        double find_direction(double hold, std::vector<double>& direction) const
        {
            std::vector<int> first;
            for (size_t i = 0; i < place_.size(); ++i)
                first.push_back(Dim * pattern_.first[i / Dim]);
            SkylineCholesky matrix(first);
            std::vector<double> slope(place_.size());
            for (size_t i = 0; i < place_.size(); ++i) {
                const double stiffness = hold * pattern_.mass[i / Dim];
                matrix.at(int(i), int(i)) = stiffness;
                slope[i] = stiffness * (place_[i] - wished_[i]);
            }
            each_point(
                [&](const auto& region, int q, const Mat<Dim>& F) {
                    add_point(region, q, region.volume / points, UntanglingEnergy<Dim>(F), slope, matrix);
                },
                place_);
            if (!matrix.factorise()) return 0; // by round-off
            for (size_t i = 0; i < direction.size(); ++i)
                direction[i] = -slope[i];
            matrix.solve(direction);
            double fall = 0;
            for (size_t i = 0; i < direction.size(); ++i)
                fall -= slope[i] * direction[i];
            return fall;
        }

        /// Slope and curvature of the energy of a point, dF = sum over rows of du (x) gradient.
        void add_point(const typename StiffnessPattern<Dim>::Region& region, int q, double volume,
                       const UntanglingEnergy<Dim>& local, std::vector<double>& slope, SkylineCholesky& matrix) const
        {
            const int* row = &pattern_.region_row[region.row];
            const double* gradient = &pattern_.region_gradient[region.gradient + size_t(q) * region.rows * Dim];
            Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> shape(Dim * Dim, Dim * region.rows);
            shape.setZero();
            for (int a = 0; a < region.rows; ++a)
                for (int i = 0; i < Dim; ++i)
                    for (int j = 0; j < Dim; ++j)
                        shape(Dim * i + j, Dim * a + i) = gradient[Dim * a + j];
            const Eigen::VectorXd of_rows = volume * shape.transpose() * local.slope;
            const Eigen::MatrixXd between = volume * shape.transpose() * local.curvature * shape;
            const auto place = [&](int k) { return Dim * row[k / Dim] + k % Dim; };
            for (int k = 0; k < Dim * region.rows; ++k) {
                slope[size_t(place(k))] += of_rows[k];
                for (int l = 0; l <= k; ++l)
                    matrix.at(place(k), place(l)) += between(k, l);
            }
        }

        StiffnessPattern<Dim> pattern_;
        std::vector<double> wished_, place_;
    };

} // namespace

template <int Dim> void untangle(Grain<Dim>& grain, double least_J)
{
    constexpr double loosest = 1e-3, firmest = 1e6, firmer = 2;
    const std::string whose = "soft grain #" + std::to_string(grain.id) + ": ";
    if (!(least_J > 0 && least_J <= 1))
        throw UserError(whose + "the least J asked for, " + shown(least_J) + ", has to lie above 0 and not above 1.");
    if (!std::all_of(grain.displacement.begin(), grain.displacement.end(), [](double u) { return std::isfinite(u); }))
        throw UserError(whose + "displacements of its nodes are not finite numbers; start from others.");
    grain.renew_positions();
    const std::vector<double> before = grain.surface.position;
    Untangling<Dim> way(grain);
    const auto is_sound = [&] {
        way.hand_over(grain);
        grain.refresh();
        return way.least_J() >= least_J * (1 - 1e-12) && !is_folded(grain.surface, grain.mesh->is_concave());
    };
    if (is_sound()) return;
    way.straighten();
    way.hand_over(grain);
    std::vector<double> sound = grain.displacement;
    for (double hold = loosest; hold < firmest; hold *= firmer) {
        way.relax(hold);
        if (!is_sound()) break;
        sound = grain.displacement;
    }
    grain.displacement = sound;
    grain.refresh();
    double farthest = 0;
    for (int p = 0; p < grain.surface.count; ++p)
        farthest = std::max(farthest, (grain.surface.x(p) - Eigen::Map<const Vec<Dim>>(&before[size_t(Dim) * p])).norm());
    grain.surface.travel += farthest;
}

template void untangle<2>(Grain<2>&, double);
template struct UntanglingEnergy<2>;

} // namespace softgrain
