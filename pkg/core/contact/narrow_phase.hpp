// SPDX-License-Identifier: GPL-2.0-or-later
// Contact points of two bodies: surface points of one against the boundary of the other.
//
//   PairContacts     a grain against a grain or a rigid polygon, or a grain against itself
//   PlaneContacts    a grain against the half-space behind a rigid plane
#pragma once

#include "contact/polyline.hpp"

#include <array>

namespace softgrain {

/// One surface point against one face. Impulses act along +force on the point, against it on the face.
template <int Dim> struct ContactPoint {
    int point;                                     ///< surface point
    bool on_second;                                ///< the point belongs to the pair's second body, the face to the first
    int face;                                      ///< segment (2D) of the other body
    std::array<int, face_vertices<Dim>> vertex;    ///< that the face follows
    std::array<double, face_vertices<Dim>> weight; ///< of the vertices at the foot of the point, sum 1
    Vec<Dim> normal;                               ///< from the face to the point, unit
    double gap;                                    ///< [m], negative: penetration
    double let;                                    ///< how far the point may enter, in the gap already; see allowance() [m]
    Vec<Dim> force = Vec<Dim>::Zero();             ///< [N] (N/m in 2D) of the last step: where the solver starts
    double creep = 0;                              ///< implicit steps: that a sticking point is off where it stuck [m]
};

/// How far ahead contacts are looked for: [m], beyond what two bodies can close in one step.
template <int Dim> double reach(const Surface<Dim>& a, double other_speed, double dt);

/// Where a surface point of `mine` stands against another body. The foot is sought from segment `face` on; a line
/// shows its first segment, drawn out at both ends, and the points of lines meet chords.
template <int Dim> Projection stand(const Surface<Dim>& mine, int point, const Surface<Dim>& other, int face);
/// How an outline goes on at a foot of stand().
template <int Dim> Bend bend_below(const Surface<Dim>& mine, const Surface<Dim>& other, int face, double place);

/// How far a point of the larger body may enter the smaller one between the contact points there [m]: a quarter of their
/// distance, several times what two touching arcs need. More would be a leak. Corners: 0, but next to nothing for those of lines:
/// where lines join, points on them hold the body, not the joint.
template <int Dim> double allowance(const Surface<Dim>& larger, int point, const Surface<Dim>& smaller);

/// Whether the boundary of a grain has folded over itself, or passed through itself: by more than is let pass where it may come to
/// meet itself.
template <int Dim> bool is_folded(const Surface<Dim>& surface, bool may_meet_itself);

/// How far the outline may reach out of the box of its points [m]. The middle of a segment of length s that turns by an angle is
/// s angle / 8 off its chord; the angle is taken as 1. Rigid polygons and lines are straight: 0.
template <int Dim> double bulge(const Surface<Dim>& surface);

/// Whose points stand for the boundary where two bodies touch: of the smaller one, but of the grain where the other is a rigid
/// polygon, which shows its faces, however thin it is, and of the larger of two grains where its points are denser by a third.
template <int Dim> bool points_are_of_second(const Surface<Dim>& first, const Surface<Dim>& second);

template <int Dim> class PairContacts {
public:
    /// Contact points with a gap below `reach`, in a fixed order; forces carry over from the last call.
    /// Points of the smaller body meet the larger one's faces; sharp corners of the larger meet the smaller's. Other
    /// points of the larger may enter by `allowance`, and no further: gaps count from there.
    /// A grain against itself, both being its surface: points meet the faces that they face, and those that come earlier along
    /// the boundary are in the place of the larger body.
    void update(const Surface<Dim>& first, const Surface<Dim>& second, double dt);
    /// The same for gaps below `near` [m].
    void look(const Surface<Dim>& first, const Surface<Dim>& second, double near);
    /// update() would find nothing: its memory tells without a look at positions.
    bool apart(const Surface<Dim>& first, const Surface<Dim>& second, double dt) const;

    std::vector<ContactPoint<Dim>> points;
    /// Points of the one are so near the other that the pair is worth keeping.
    bool near() const { return !memory.near[0].empty() || !memory.near[1].empty(); }

    struct Candidate {
        int point, face;
        double clear_until; ///< total travel of both bodies up to which the point is out of touch by its last gap [m]
    };
    /// What the next update starts from besides `points`: the points of the smaller body and of the larger that are near,
    /// and the travel of both bodies plus reach up to which that is complete [m].
    struct Memory {
        std::array<std::vector<Candidate>, 2> near;
        double valid_until = -1;
        /// The same up to which no point can be in touch.
        double apart_until = -1;
    };
    Memory memory;

private:
    void search(const Surface<Dim>& mine, const Surface<Dim>& other, bool of_larger, double margin,
                std::vector<Candidate>& found) const;
};

/// Largest depth of a surface point of either body inside of the other's outline, 0 if there is none [m]. Contact looks at
/// points of one of the two only: this is what it may have missed.
template <int Dim> double overlap(const Surface<Dim>& first, const Surface<Dim>& second);

template <int Dim> class PlaneContacts {
public:
    /// Contact points with the plane x[axis] = position, grains on the `side` (+1 or -1) of it.
    void update(const Surface<Dim>& grain, int axis, double position, int side, double plane_speed, double dt);
    /// update() would find nothing: the box tells without a look at positions.
    static bool apart(const Surface<Dim>& grain, int axis, double position, int side, double plane_speed, double dt);
    /// The same for gaps below `near` [m].
    void look(const Surface<Dim>& grain, int axis, double position, int side, double near);

    std::vector<ContactPoint<Dim>> points;
    bool near() const { return near_; }

private:
    bool near_ = false;
};

extern template Projection stand<2>(const Surface<2>&, int, const Surface<2>&, int);
extern template Bend bend_below<2>(const Surface<2>&, const Surface<2>&, int, double);
extern template double allowance<2>(const Surface<2>&, int, const Surface<2>&);
extern template bool points_are_of_second<2>(const Surface<2>&, const Surface<2>&);
extern template bool is_folded<2>(const Surface<2>&, bool);
extern template double bulge<2>(const Surface<2>&);
extern template double overlap<2>(const Surface<2>&, const Surface<2>&);
extern template class PairContacts<2>;
extern template class PlaneContacts<2>;

} // namespace softgrain
