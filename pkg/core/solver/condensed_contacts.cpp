// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/condensed_contacts.hpp"

namespace softgrain {
namespace {

    /// Surface points of one body that a contact moves, and their weights.
    template <int Dim> struct Share {
        int count;
        std::array<int, face_vertices<Dim>> point;
        std::array<double, face_vertices<Dim>> weight;
        Share(const BarrierContact<Dim>& contact, bool of_point)
        {
            if (of_point) {
                count = 1;
                point[0] = contact.point;
                weight[0] = 1;
                return;
            }
            count = face_vertices<Dim>;
            point = contact.vertex;
            for (int k = 0; k < count; ++k)
                weight[k] = -contact.weight[k];
        }
    };

    template <int Dim> Mat<Dim> frame(const BarrierContact<Dim>& contact)
    {
        Mat<Dim> axes;
        axes.row(0) = contact.normal;
        axes.row(1) = contact.tangent();
        return axes;
    }

} // namespace

template <int Dim> void CondensedContacts<Dim>::analyse(const std::vector<BarrierContact<Dim>>& contacts, int bodies)
{
    std::vector<int> key;
    for (const auto& contact : contacts)
        key.insert(key.end(), { contact.body, contact.other, contact.size_of_problem() });
    if (key == analysed_ && sides_.size() == size_t(bodies)) return;
    analysed_ = std::move(key);
    sides_.assign(size_t(bodies), {});
    row_.clear();
    rows_ = 0;
    for (size_t c = 0; c < contacts.size(); ++c) {
        if (!contacts[c].aloof) sides_[size_t(contacts[c].body)].push_back({ int(c), true });
        if (!contacts[c].aloof && contacts[c].other >= 0) sides_[size_t(contacts[c].other)].push_back({ int(c), false });
        row_.push_back(rows_);
        rows_ += contacts[c].size_of_problem();
    }
    using Entry = Eigen::Triplet<double>;
    std::vector<Entry> entries;
    for (int r = 0; r < rows_; ++r)
        entries.emplace_back(r, r, 1);
    std::vector<std::pair<int, int>> order; // of the entries that assemble() adds
    for (const auto& sides : sides_)
        for (size_t a = 0; a < sides.size(); ++a)
            for (size_t b = 0; b <= a; ++b) {
                const int ca = sides[a].contact, cb = sides[b].contact;
                for (int i = 0; i < contacts[size_t(ca)].size_of_problem(); ++i)
                    for (int j = 0; j < contacts[size_t(cb)].size_of_problem(); ++j)
                        order.emplace_back(row_[size_t(ca)] + i, row_[size_t(cb)] + j);
            }
    for (const auto& [row, column] : order)
        entries.emplace_back(std::max(row, column), std::min(row, column), 1);
    matrix_.resize(rows_, rows_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    const auto place_of = [&](int row, int column) {
        const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
        const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
        return int(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
    };
    place_.clear();
    for (const auto& [row, column] : order)
        place_.push_back(place_of(std::max(row, column), std::min(row, column)));
    diagonal_place_.clear();
    for (int r = 0; r < rows_; ++r)
        diagonal_place_.push_back(place_of(r, r));
    if (rows_ > 0) solver_.analyzePattern(matrix_);
}

template <int Dim>
void CondensedContacts<Dim>::assemble(std::vector<BarrierContact<Dim>>& contacts,
                                      const std::vector<const double*>& compliance, const std::vector<int>& points)
{
    W_.assign(size_t(matrix_.nonZeros()), 0);
    for (auto& contact : contacts)
        if (!contact.aloof) contact.compliance = 0;
    const int* place = place_.data();
    std::vector<double> moved; // by a unit force of a contact along each axis, [point][Dim][Dim]
    for (size_t body = 0; body < sides_.size(); ++body) {
        const auto& sides = sides_[body];
        const double* C = compliance[body];
        const int n = points[body];
        for (size_t a = 0; a < sides.size(); ++a) {
            auto& first = contacts[size_t(sides[a].contact)];
            const int size_a = first.size_of_problem();
            const Mat<Dim> axes_a = frame(first);
            if (C) {
                const Share<Dim> share(first, sides[a].of_point);
                moved.assign(size_t(n) * Dim * Dim, 0);
                for (int k = 0; k < share.count; ++k) {
                    const double* row = C + size_t(share.point[k]) * n * Dim * Dim;
                    for (int i = 0; i < n * Dim * Dim; ++i)
                        moved[size_t(i)] += share.weight[k] * row[i];
                }
            }
            for (size_t b = 0; b <= a; ++b) {
                const auto& second = contacts[size_t(sides[b].contact)];
                const int size_b = second.size_of_problem();
                if (!C) {
                    place += size_a * size_b;
                    continue;
                }
                const Share<Dim> share(second, sides[b].of_point);
                Mat<Dim> between = Mat<Dim>::Zero();
                for (int k = 0; k < share.count; ++k)
                    between += share.weight[k]
                        * Eigen::Map<const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(
                                   &moved[size_t(share.point[k]) * Dim * Dim]);
                const Mat<Dim> local = axes_a * between * frame(second).transpose();
                const bool same = &first == &second; // if its sides differ, both are of one body: counts in both orders
                const double times = same && a != b ? 2 : 1;
                if (same) first.compliance += times * local(0, 0);
                for (int i = 0; i < size_a; ++i)
                    for (int j = 0; j < size_b; ++j, ++place)
                        if (a != b || j <= i) W_[size_t(*place)] += (i == j ? times : 1) * local(i, j);
            }
        }
    }
}

template <int Dim> bool CondensedContacts<Dim>::factorise(const Eigen::VectorXd& diagonal)
{
    std::copy(W_.begin(), W_.end(), matrix_.valuePtr());
    for (int r = 0; r < rows_; ++r)
        matrix_.valuePtr()[diagonal_place_[size_t(r)]] += diagonal[r];
    solver_.factorize(matrix_);
    return solver_.info() == Eigen::Success && (solver_.vectorD().array() > 0).all();
}

template class CondensedContacts<2>;

} // namespace softgrain
