// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/narrow_phase.hpp"
#include "solver/contact_problem.hpp"

namespace softgrain {

/// Surface values of all bodies, [body][point][Dim].
using SurfaceField = std::vector<std::vector<double>>;

/// A contact of an implicit step: what the narrow phase found near, at the places that the step tries, and the unknowns of
/// the interior-point method. Forces act on the point along +normal and +tangent, against them on the face.
template <int Dim> struct BarrierContact {
    int body;  ///< that the point is on, place among the bodies
    int other; ///< that the face is on; -1: a rigid plane
    int point;
    int face = 0;
    double place = 0.5;                                    ///< of the foot on the face, 0 to 1
    std::array<int, face_vertices<Dim>> vertex {};         ///< that the face follows
    std::array<double, face_vertices<Dim>> weight {};      ///< of the vertices
    Vec<Dim> normal = Vec<Dim>::Zero();                    ///< from the face to the point
    double plane = 0;                                      ///< normal . x of the plane at the end of the step [m]
    Vec<Dim> drive = Vec<Dim>::Zero();                     ///< way of the plane during the step [m]
    double let = 0;                                        ///< how far the point may enter, see allowance() [m]
    double friction = 0;                                   ///< Coulomb's coefficient
    double size = 0;                                       ///< radius of the smaller body [m]
    double gap = 0;                                        ///< now [m]
    double creep = 0;                                      ///< that the step starts with: way since the point stuck [m]
    double slide = 0;                                      ///< way of the point along the face, creep included [m]
    double slack = 0;                                      ///< stands for the gap, above 0 [m]
    double force = 0, shear = 0;                           ///< normal and tangential [N] (N/m in 2D)
    double slack_step = 0, force_step = 0, shear_step = 0; ///< of an iteration
    bool aloof = false;    ///< stands off so far that its force counts for nothing in the linear system
    double compliance = 0; ///< of the two bodies along the normal [m/N]

    Vec<Dim> tangent() const
    {
        static_assert(Dim == 2, "one tangent, in the plane");
        return Vec<Dim>(-normal.y(), normal.x());
    }
    /// Foot, normal and gap of the point on the other body as both stand; the foot is sought from the last one on.
    void locate(const Surface<Dim>& point_body, const Surface<Dim>& face_body)
    {
        const Projection at = stand(point_body, point, face_body, face);
        face = at.segment;
        place = at.t;
        vertex = at.vertex;
        weight = at.weight;
        normal = at.normal;
        gap = at.gap + let;
    }
    Vec<Dim> total() const { return force * normal + shear * tangent(); }
    int size_of_problem() const { return aloof ? 0 : friction > 0 ? Dim : 1; }
};

template <int Dim> Eigen::Map<const Vec<Dim>> value_at(const SurfaceField& field, int body, int point)
{
    return Eigen::Map<const Vec<Dim>>(&field[size_t(body)][size_t(Dim) * point]);
}
template <int Dim> Eigen::Map<Vec<Dim>> value_at(SurfaceField& field, int body, int point)
{
    return Eigen::Map<Vec<Dim>>(&field[size_t(body)][size_t(Dim) * point]);
}

/// Value of a surface field at a contact: that of the point less that of the face.
template <int Dim> Vec<Dim> difference(const BarrierContact<Dim>& contact, const SurfaceField& field)
{
    Vec<Dim> value = value_at<Dim>(field, contact.body, contact.point);
    for (int k = 0; contact.other >= 0 && k < face_vertices<Dim>; ++k)
        value -= contact.weight[k] * value_at<Dim>(field, contact.other, contact.vertex[k]);
    return value;
}

/// Adds a force on the point, and against it on the face.
template <int Dim> void add_force(const BarrierContact<Dim>& contact, const Vec<Dim>& force, SurfaceField& field)
{
    value_at<Dim>(field, contact.body, contact.point) += force;
    for (int k = 0; contact.other >= 0 && k < face_vertices<Dim>; ++k)
        value_at<Dim>(field, contact.other, contact.vertex[k]) -= contact.weight[k] * force;
}

} // namespace softgrain
