// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/narrow_phase.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    /// Distance that neighbour lists look ahead of the reach [size of the smaller body].
    constexpr double skin = 0.1;
    /// A gap along the interpolated normal shrinks by little more than the bodies move.
    constexpr double safe_share = 0.8;
    constexpr double end_depth = 1e-3; ///< of lines [size of the other body]
    constexpr double own_depth = 0.02; ///< of a grain in itself; what is deeper may be the other side of a thin part [size]

    /// Forces of the last step go to the same points; both lists are in the same order.
    template <int Dim> void carry_forces(const std::vector<ContactPoint<Dim>>& old, std::vector<ContactPoint<Dim>>& fresh)
    {
        auto before = old.begin();
        for (auto& contact : fresh) {
            const auto key = [](const ContactPoint<Dim>& c) { return std::make_pair(c.on_second, c.point); };
            while (before != old.end() && key(*before) < key(contact))
                ++before;
            if (before == old.end() || key(*before) != key(contact)) continue;
            contact.force = before->force;
            contact.creep = before->creep;
        }
    }

    /// Where a point stands against the chord of a segment, drawn out at both ends: t is not bounded.
    Projection against_chord(const Surface<2>& surface, const Vec<2>& x, int segment)
    {
        const int n = surface.count, next = (segment + 1) % n;
        const Vec<2> start = surface.x(segment), chord = surface.x(next) - start;
        const double t = (x - start).dot(chord) / chord.squaredNorm();
        const Vec<2> normal = Vec<2>(chord.y(), -chord.x()).normalized();
        return { segment,
                 t,
                 { (segment + n - 1) % n, segment, next, (next + 1) % n },
                 { 0, 1 - t, t, 0 },
                 normal,
                 normal.dot(x - start) };
    }

    /// Normal at a point of a circle.
    Vec<2> outward(const Surface<2>& circle, int point)
    {
        const int n = circle.count;
        const Vec<2> chord = circle.x((point + 1) % n) - circle.x((point + n - 1) % n);
        return Vec<2>(chord.y(), -chord.x()).normalized();
    }

    /// The point faces the line, and is not on its way round an end.
    bool faces(const Surface<2>& line, const Projection& at) { return at.t >= 0 && at.t <= 1 && at.gap > -2 * line.size; }

} // namespace

template <int Dim> Projection stand(const Surface<Dim>& mine, int point, const Surface<Dim>& other, int face)
{
    using Kind = typename Surface<Dim>::Kind;
    const Vec<Dim> x = mine.x(point);
    if (other.kind == Kind::line) return against_chord(other, x, 0);
    const Projection at = project(other, x, face);
    if (mine.kind != Kind::line) return at;
    Projection straight = against_chord(other, x, at.segment); // outlines bulge over the joints of lines, chords do not
    straight.t = at.t;
    return straight;
}

template <int Dim> Bend bend_below(const Surface<Dim>& mine, const Surface<Dim>& other, int face, double place)
{
    if (mine.kind != Surface<Dim>::Kind::line) return bend_at(other, face, place);
    return { { 0, -1, 1, 0 }, (other.x((face + 1) % other.count) - other.x(face)).norm(), 0 };
}

template <int Dim> double reach(const Surface<Dim>& a, double other_speed, double dt)
{
    return 2 * dt * (a.speed + other_speed) + 1e-4 * a.size + a.ahead;
}

namespace {

    /// A share of the distance of a body's points.
    template <int Dim> double between_points(const Surface<Dim>& body) { return 0.25 * 2 * M_PI * body.size / body.count; }

} // namespace

template <int Dim> double allowance(const Surface<Dim>& larger, int point, const Surface<Dim>& smaller)
{
    if (larger.kind == Surface<Dim>::Kind::line) return end_depth * smaller.size;
    return larger.corner[point] ? 0 : between_points(smaller);
}

template <int Dim> bool is_folded(const Surface<Dim>& surface, bool may_meet_itself)
{
    return may_meet_itself ? covers_itself(surface, between_points(surface)) : crosses_itself(surface);
}

template <int Dim> double bulge(const Surface<Dim>& surface)
{
    return surface.mobility > 0 || surface.kind == Surface<Dim>::Kind::round ? 2 * M_PI * surface.size / surface.count / 8
                                                                             : 0;
}

namespace {

    /// Where a point of a grain stands against its own outline, to be looked for from the segment nearest to it.
    template <int Dim> int nearest_to(const Surface<Dim>& mine, int point, const Surface<Dim>& other)
    {
        return &mine == &other ? faced_segment(mine, point, own_depth * mine.size) : nearest_segment(other, mine.x(point));
    }

    /// Of a grain and itself: the point and its foot are a pair, and this is the list that has it.
    template <int Dim> bool faces_own(const Surface<Dim>& grain, int point, const Projection& at, bool earlier)
    {
        return earlier == (point < at.segment)
            && face_each_other(grain, point, at.segment, grain.x(point) - at.gap * at.normal, at.normal,
                               own_depth * grain.size);
    }

} // namespace

template <int Dim>
void PairContacts<Dim>::search(const Surface<Dim>& mine, const Surface<Dim>& other, bool of_larger, double margin,
                               std::vector<Candidate>& found) const
{
    found.clear();
    const double beyond = margin + bulge(other);
    const Vec<Dim> lo = other.min.array() - beyond, hi = other.max.array() + beyond;
    for (int p = 0; p < mine.count; ++p) {
        if (of_larger && mine.mobility == 0 && !mine.corner[p]) continue;
        const Vec<Dim> x = mine.x(p);
        if ((x.array() < lo.array()).any() || (x.array() > hi.array()).any()) continue;
        const int nearest = nearest_to(mine, p, other);
        if (nearest < 0) continue;
        const Projection at = stand(mine, p, other, nearest);
        if (&mine == &other && !faces_own(mine, p, at, of_larger)) continue;
        if (at.gap + (of_larger ? allowance(mine, p, other) : 0) < margin) found.push_back({ p, at.segment, 0 });
    }
}

namespace {

    template <int Dim> bool shows_faces(const Surface<Dim>& body)
    {
        return body.mobility == 0 && body.kind != Surface<Dim>::Kind::round;
    }

} // namespace

template <int Dim> bool points_are_of_second(const Surface<Dim>& first, const Surface<Dim>& second)
{
    const bool smaller = second.size < first.size;
    if (first.mobility == 0 || second.mobility == 0) return second.mobility > 0 && (shows_faces(first) || smaller);
    if (first.count == second.count) return smaller;                                // of one resolution
    const double sparser = second.size * first.count / (first.size * second.count); // points of the second
    return sparser < (smaller ? 4.0 / 3 : 3.0 / 4);
}

namespace {

    template <int Dim> double reach_of_pair(const Surface<Dim>& first, const Surface<Dim>& second, double dt)
    {
        const bool second_smaller = points_are_of_second(first, second);
        return reach(second_smaller ? second : first, (second_smaller ? first : second).speed, dt);
    }

} // namespace

template <int Dim> void PairContacts<Dim>::update(const Surface<Dim>& first, const Surface<Dim>& second, double dt)
{
    look(first, second, reach_of_pair(first, second, dt));
}

template <int Dim> bool PairContacts<Dim>::apart(const Surface<Dim>& first, const Surface<Dim>& second, double dt) const
{
    return points.empty() && first.travel + second.travel + reach_of_pair(first, second, dt) < memory.apart_until;
}

template <int Dim> void PairContacts<Dim>::look(const Surface<Dim>& first, const Surface<Dim>& second, double near)
{
    const bool second_smaller = points_are_of_second(first, second);
    const Surface<Dim>&small = second_smaller ? second : first, &large = second_smaller ? first : second;
    if (first.travel + second.travel + near >= memory.valid_until) {
        const double ahead = skin * small.size;
        search(small, large, false, near + ahead, memory.near[0]);
        search(large, small, true, near + ahead, memory.near[1]);
        memory.valid_until = first.travel + second.travel + near + ahead;
    }
    memory.apart_until = memory.valid_until;
    if (memory.near[0].empty() && memory.near[1].empty() && points.empty()) return;
    const double travel = first.travel + second.travel;
    thread_local std::vector<ContactPoint<Dim>> fresh; // keeps its room from pair to pair
    fresh.clear();
    for (bool on_second : { false, true }) {
        const bool mine_small = on_second == second_smaller;
        const Surface<Dim>&mine = on_second ? second : first, &other = on_second ? first : second;
        for (Candidate& candidate : memory.near[mine_small ? 0 : 1]) {
            if (travel + near < candidate.clear_until) {
                memory.apart_until = std::min(memory.apart_until, candidate.clear_until);
                continue;
            }
            Projection at = stand(mine, candidate.point, other, candidate.face);
            if (&mine == &other && !faces_own(mine, candidate.point, at, !mine_small)) continue;
            const double let = mine_small ? 0 : allowance(mine, candidate.point, other);
            if (mine.kind == Surface<Dim>::Kind::round) at.normal = -outward(mine, candidate.point);
            at.gap += let;
            candidate.face = at.segment;
            candidate.clear_until = travel + safe_share * at.gap;
            memory.apart_until = std::min(memory.apart_until, candidate.clear_until);
            if (at.gap >= near || (other.kind == Surface<Dim>::Kind::line && !faces(other, at))) continue;
            fresh.push_back({ candidate.point, on_second, at.segment, at.vertex, at.weight, at.normal, at.gap, let });
        }
    }
    carry_forces(points, fresh);
    points.assign(fresh.begin(), fresh.end());
}

template <int Dim> double overlap(const Surface<Dim>& first, const Surface<Dim>& second)
{
    double deepest = 0;
    for (bool swapped : { false, true }) {
        const Surface<Dim>&mine = swapped ? second : first, &other = swapped ? first : second;
        const double beyond = bulge(other);
        for (int p = 0; p < mine.count; ++p) {
            const Vec<Dim> x = mine.x(p);
            if ((x.array() < other.min.array() - beyond).any() || (x.array() > other.max.array() + beyond).any()) continue;
            deepest = std::max(deepest, -project(other, x, nearest_segment(other, x)).gap);
        }
    }
    return deepest;
}

namespace {

    template <int Dim> double distance(const Surface<Dim>& grain, int axis, double position, int side)
    {
        return side > 0 ? grain.min[axis] - position : position - grain.max[axis];
    }

} // namespace

template <int Dim>
void PlaneContacts<Dim>::update(const Surface<Dim>& grain, int axis, double position, int side, double plane_speed,
                                double dt)
{
    look(grain, axis, position, side, reach(grain, plane_speed, dt));
}

template <int Dim>
bool PlaneContacts<Dim>::apart(const Surface<Dim>& grain, int axis, double position, int side, double plane_speed, double dt)
{
    return distance(grain, axis, position, side) >= reach(grain, plane_speed, dt);
}

template <int Dim> void PlaneContacts<Dim>::look(const Surface<Dim>& grain, int axis, double position, int side, double near)
{
    thread_local std::vector<ContactPoint<Dim>> fresh;
    fresh.clear();
    const double closest = distance(grain, axis, position, side);
    near_ = closest < near + skin * grain.size;
    if (closest < near)
        for (int p = 0; p < grain.count; ++p) {
            const double gap = side * (grain.x(p)[axis] - position);
            if (gap < near) fresh.push_back({ p, false, 0, {}, {}, side * Vec<Dim>::Unit(axis), gap, 0 });
        }
    carry_forces(points, fresh);
    points.assign(fresh.begin(), fresh.end());
}

template double reach<2>(const Surface<2>&, double, double);
template Projection stand<2>(const Surface<2>&, int, const Surface<2>&, int);
template Bend bend_below<2>(const Surface<2>&, const Surface<2>&, int, double);
template double allowance<2>(const Surface<2>&, int, const Surface<2>&);
template bool points_are_of_second<2>(const Surface<2>&, const Surface<2>&);
template bool is_folded<2>(const Surface<2>&, bool);
template double bulge<2>(const Surface<2>&);
template double overlap<2>(const Surface<2>&, const Surface<2>&);
template class PairContacts<2>;
template class PlaneContacts<2>;

} // namespace softgrain
