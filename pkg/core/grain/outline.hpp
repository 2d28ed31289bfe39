// SPDX-License-Identifier: GPL-2.0-or-later
// The shape of a grain in its reference configuration: what it holds of a box, and its boundary.
//
//   Outline<Dim>
//     DiscOutline       the unit disc, exact arcs
//     PolygonOutline    a simple closed polygon, convex or not
#pragma once

#include "base/types.hpp"

#include <vector>

namespace softgrain {

template <int Dim> struct Box {
    Vec<Dim> min, max;
};

/// Integrals over a region, raw (about the origin): volume [L^Dim], first [L^(Dim+1)], second [L^(Dim+2)].
template <int Dim> struct Moments {
    double volume = 0;
    Vec<Dim> first = Vec<Dim>::Zero();
    Mat<Dim> second = Mat<Dim>::Zero();

    Moments& operator+=(const Moments& other)
    {
        volume += other.volume;
        first += other.first;
        second += other.second;
        return *this;
    }
    Vec<Dim> centroid() const { return first / volume; }
    /// Second moments about the centroid, per volume [L^2].
    Mat<Dim> covariance() const { return second / volume - centroid() * centroid().transpose(); }
};

/// A point of the boundary, in reference coordinates. Points follow each other counter-clockwise in 2D.
template <int Dim> struct BoundaryPoint {
    Vec<Dim> position;
    double weight; ///< boundary length (area in 3D) that belongs to the point
    bool corner;   ///< a sharp, convex corner: it can indent another grain between that grain's own points
};

template <int Dim> class Outline {
public:
    virtual ~Outline() = default;
    virtual Box<Dim> bounds() const = 0;
    /// Moments of the part of the grain inside the box.
    virtual Moments<Dim> moments(const Box<Dim>& box) const = 0;
    /// Moments of the whole grain, in closed form.
    virtual Moments<Dim> moments() const = 0;
    /// Boundary points no further apart than the spacing.
    virtual std::vector<BoundaryPoint<Dim>> sample(double spacing) const = 0;
};

/// The disc of radius 1 about the origin.
class DiscOutline final : public Outline<2> {
public:
    Box<2> bounds() const override;
    Moments<2> moments(const Box<2>& box) const override;
    Moments<2> moments() const override;
    std::vector<BoundaryPoint<2>> sample(double spacing) const override;
};

/// A simple closed polygon; the constructor turns it counter-clockwise, moves its centroid to the origin and
/// scales it to the area of the unit disc.
class PolygonOutline final : public Outline<2> {
public:
    /// Throws UserError on fewer than three vertices, a value that is not finite, no area, or crossing edges.
    explicit PolygonOutline(std::vector<Vec<2>> vertices);
    Box<2> bounds() const override;
    Moments<2> moments(const Box<2>& box) const override;
    Moments<2> moments() const override;
    std::vector<BoundaryPoint<2>> sample(double spacing) const override;

    const std::vector<Vec<2>>& vertices() const { return vertices_; }
    /// Length of the given polygon that became 1 [length unit of the given vertices].
    double scale() const { return scale_; }
    /// Centroid of the given polygon [length unit of the given vertices].
    const Vec<2>& centroid() const { return centroid_; }

private:
    std::vector<Vec<2>> vertices_;
    double scale_;
    Vec<2> centroid_;
};

} // namespace softgrain
