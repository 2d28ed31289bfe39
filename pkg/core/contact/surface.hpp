// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/rigid_body.hpp"
#include "grid/surface_operator.hpp"

#include <algorithm>
#include <vector>

namespace softgrain {

/// The boundary of a body as contact sees it, in world coordinates. A soft grain fills it every step from its
/// grid; a rigid polygon from its motion.
template <int Dim> struct Surface {
    /// What a rigid body shows: a polygon its faces, and its corners to grains; a round one is like a grain, its points meet
    /// larger grains; a line its first segment and its corners.
    enum class Kind { polygon, round, line };

    int count = 0;
    std::vector<double> position;        ///< [point][Dim] [m], counter-clockwise in 2D
    std::vector<double> velocity;        ///< [point][Dim] [m/s]; the contact solver works on it
    std::vector<double> velocity_before; ///< [point][Dim] [m/s], at the start of the step
    std::vector<double> impulse;         ///< [point][Dim] [N s], what contact gave in this step
    bool struck = false;      ///< in this step: its impulses are not zero, or its nodes were given other velocities
    bool wanted = true;       ///< by contact, in every step; else steps renew box, speed and travel alone
    bool near = true;         ///< contact points of it with others may touch in this step
    bool stale = false;       ///< positions are of an earlier step, Grain::renew_positions() brings them
    std::vector<char> corner; ///< [point], see BoundaryPoint
    Vec<Dim> min = Vec<Dim>::Zero(), max = Vec<Dim>::Zero(); ///< bounding box [m]
    double speed = 0;                                        ///< largest speed of a point [m/s]
    double travel = 0;                                       ///< bound on the path of any point since the start [m]
    double ahead = 0;                                        ///< further look for contacts, of long steps [m]
    double size = 0;                                         ///< radius, or half the least width [m]
    double mobility = 0;                                     ///< 1 / (density radius^Dim) [1/kg]; 0: not moved by impulses
    Kind kind = Kind::polygon;                               ///< of a rigid body
    const SurfaceOperator<Dim>* response = nullptr;          ///< its Delassus operator; none for rigid bodies
    RigidBody<Dim>* rigid = nullptr;                         ///< that shows it, if impulses move that body; mobility 0

    void resize(int points)
    {
        count = points;
        for (auto* field : { &position, &velocity, &velocity_before, &impulse })
            field->assign(size_t(Dim) * points, 0);
        corner.assign(points, 0);
    }
    Eigen::Map<const Vec<Dim>> x(int point) const { return Eigen::Map<const Vec<Dim>>(&position[size_t(Dim) * point]); }
    Eigen::Map<Vec<Dim>> v(int point) { return Eigen::Map<Vec<Dim>>(&velocity[size_t(Dim) * point]); }

    /// Moves so far in a step that it could get past other bodies.
    bool leaps(double dt) const { return speed * dt > 0.5 * size; }
    /// Of the fastest point.
    void measure_speed()
    {
        speed = 0;
        for (int p = 0; p < count; ++p)
            speed = std::max(speed, v(p).norm());
    }

    /// Adds a point that moves with the rigid body; its number.
    int add(const Vec<Dim>& place)
    {
        const auto lever = rigid->lever(place);
        const auto append = [](std::vector<double>& field, const Vec<Dim>& value) {
            field.insert(field.end(), value.data(), value.data() + Dim);
        };
        append(position, place);
        append(velocity, lever * rigid->twist);
        append(velocity_before, lever * rigid->before);
        append(impulse, Vec<Dim>::Zero());
        corner.push_back(false);
        return count++;
    }

    void strike(int point, const Vec<Dim>& by)
    {
        Eigen::Map<Vec<Dim>>(&impulse[size_t(Dim) * point]) += by;
        struck = true;
    }

    /// Bounding box of the points as they are.
    void bound()
    {
        if (count == 0) return;
        min = max = x(0);
        for (int p = 1; p < count; ++p) {
            min = min.cwiseMin(x(p));
            max = max.cwiseMax(x(p));
        }
    }
};

} // namespace softgrain
