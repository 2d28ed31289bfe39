// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/spectrum.hpp"

#include <Eigen/Eigenvalues>

#include <random>

namespace softgrain {
namespace {

    /// a^T M b of every lane.
    template <int Dim> Eigen::ArrayXd product(const Batch<Dim>& batch, const AlignedVector& a, const AlignedVector& b)
    {
        Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(batch.lanes);
        for (int i = 0; i < Dim * batch.mesh->master_count; ++i)
            for (int lane = 0; lane < batch.lanes; ++lane) {
                const size_t at = size_t(i) * batch.lanes + lane;
                sum[lane] += batch.mesh->node_mass[i / Dim] * a[at] * b[at];
            }
        return sum;
    }

    /// a += factor b, lane by lane.
    void add(AlignedVector& a, const Eigen::ArrayXd& factor, const AlignedVector& b)
    {
        for (size_t at = 0; at < a.size(); ++at)
            a[at] += factor[at % factor.size()] * b[at];
    }

} // namespace

template <int Dim> void lanczos(Batch<Dim>& batch, int steps, double* per_lane, const Response& respond)
{
    const int lanes = batch.lanes;
    const size_t size = size_t(Dim) * batch.mesh->master_count * lanes;
    AlignedVector now(size), before(size), next(size);
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (size_t at = 0; at < size; at += lanes)
        std::fill_n(now.begin() + at, lanes, uniform(generator));
    const auto normalise = [&](AlignedVector& x) {
        const Eigen::ArrayXd norm = product(batch, x, x).sqrt();
        for (size_t at = 0; at < size; ++at) // an exhausted space leaves nothing
            x[at] = norm[at % lanes] > 0 ? x[at] / norm[at % lanes] : 0;
        return norm;
    };
    normalise(now);
    Eigen::ArrayXXd diagonal(steps, lanes), beside(steps, lanes);
    for (int k = 0; k < steps; ++k) {
        respond(now, next);
        for (size_t at = 0; at < size; ++at)
            next[at] *= batch.mesh->inverse_mass[at / lanes / Dim];
        if (k > 0) add(next, -beside.row(k - 1).transpose(), before);
        diagonal.row(k) = product(batch, next, now).transpose();
        add(next, -diagonal.row(k).transpose(), now);
        beside.row(k) = normalise(next).transpose();
        before.swap(now);
        now.swap(next);
    }
    for (int lane = 0; lane < lanes; ++lane) {
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
        solver.computeFromTridiagonal(diagonal.col(lane).matrix(), beside.col(lane).head(steps - 1).matrix(),
                                      Eigen::EigenvaluesOnly);
        per_lane[lane] = solver.eigenvalues().maxCoeff();
    }
}

template <int Dim> void highest_eigenvalues(Batch<Dim>& batch, int steps, double* per_lane)
{
    // differences of forces at displacements small enough to be linear and large enough to be exact
    constexpr double small = 1e-7;
    const size_t size = size_t(Dim) * batch.mesh->master_count * batch.lanes;
    AlignedVector moved(batch.displacement), rest(size), min_J(batch.lanes);
    KernelData<Dim> data = batch.data();
    data.displacement = moved.data();
    const auto force = [&] {
        motion_kernels<Dim>().extend[batch.wide()](data);
        batch.law.internal_force[batch.wide()](data, min_J.data());
    };
    force();
    std::copy(data.force, data.force + size, rest.begin());
    lanczos<Dim>(batch, steps, per_lane, [&](const AlignedVector& way, AlignedVector& response) {
        for (size_t at = 0; at < size; ++at)
            moved[at] = batch.displacement[at] + small * way[at];
        force();
        for (size_t at = 0; at < size; ++at)
            response[at] = (rest[at] - data.force[at]) / small;
    });
}

template void highest_eigenvalues<2>(Batch<2>&, int, double*);
template void lanczos<2>(Batch<2>&, int, double*, const Response&);

} // namespace softgrain
