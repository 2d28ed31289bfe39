// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/adhesion.hpp"

#include <algorithm>
#include <iterator>

namespace softgrain {

void Bonds::hold(std::vector<int> now)
{
    std::set_difference(held.begin(), held.end(), now.begin(), now.end(), std::back_inserter(parted));
    std::sort(parted.begin(), parted.end());
    held = std::move(now);
}

template <> double width_within<2>(double range, const ContactPoint<2>& point, const Surface<2>& surface)
{
    const int n = surface.count;
    double width = 0;
    for (int side : { 1, -1 }) {
        const Vec<2> way = surface.x((point.point + n + side) % n) - surface.x(point.point);
        const double rise = way.dot(point.normal), share = point.gap + rise < range ? 0.5 : (range - point.gap) / rise;
        width += share * std::max(0.0, -side * Vec<2>(way.y(), -way.x()).dot(point.normal));
    }
    return width;
}

template <int Dim>
std::vector<double> Adhesion<Dim>::pulls(const std::vector<ContactPoint<Dim>>& points, const Surface<Dim>& carrier,
                                         bool on_second, double dt, Bonds& bonds) const
{
    std::vector<double> all(points.size(), 0);
    std::vector<int> held;
    for (size_t i = 0; i < points.size(); ++i) {
        const auto& point = points[i];
        if (point.on_second != on_second || point.gap >= range) continue;
        if (std::binary_search(bonds.parted.begin(), bonds.parted.end(), point.point)) continue;
        all[i] = tension * width_within<Dim>(range, point, carrier) * dt;
        held.push_back(point.point);
    }
    if (!reversible) bonds.hold(std::move(held));
    return all;
}

namespace {

    /// Velocities of a body by an impulse on one of its surface points.
    template <int Dim> void strike(Surface<Dim>& body, int point, const Vec<Dim>& impulse)
    {
        if (body.rigid) body.rigid->twist += body.rigid->mobility * body.rigid->lever(body.x(point)).transpose() * impulse;
        if (body.mobility == 0) return;
        const auto& response = *body.response;
        for (int j = response.delassus_row[point]; j < response.delassus_row[point + 1]; ++j)
            body.v(response.delassus_column[j]) += body.mobility * response.delassus_value[j] * impulse;
    }

} // namespace

template <int Dim> void give(const ContactProblem<Dim>& known)
{
    for (const auto& contact : known.contacts) {
        strike<Dim>(*known.bodies[contact.body], contact.point, contact.impulse);
        for (int k = 0; contact.other >= 0 && k < face_vertices<Dim>; ++k)
            if (contact.weight[k] != 0)
                strike<Dim>(*known.bodies[contact.other], contact.vertex[k], -contact.weight[k] * contact.impulse);
    }
}

template struct Adhesion<2>;
template void give<2>(const ContactProblem<2>&);

} // namespace softgrain
