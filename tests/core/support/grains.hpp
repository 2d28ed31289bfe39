// SPDX-License-Identifier: GPL-2.0-or-later
// Materials of the reference solutions, and grains made of them.
#pragma once

#include "step/grain.hpp"

#include <Eigen/Geometry>

#include <deque>

namespace softgrain::testing_support {

struct Material {
    const char* law;
    std::array<double, max_parameters> parameters; ///< [Pa]
};

inline Material neo_hookean() { return { "Neo-Hookean", { 61e6, 1.26e6 } }; }
inline Material soft_neo_hookean() { return { "Neo-Hookean", { 1e6, 1e6 } }; }
inline Material mooney_rivlin() { return { "Mooney-Rivlin", { 0.63e6, -0.0012e6, 6e6 } }; }
inline Material ogden() { return { "Ogden of two terms", { 61e6, 0.3e6, 6, -0.4e6, -1.8 } }; }

using Mesh = std::shared_ptr<const Discretisation<2>>;

/// The offset of the grid is in cells.
inline Mesh mesh_of(const Outline<2>& outline, int points, double offset_x = 0, double offset_y = 0)
{
    Resolution resolution;
    resolution.points = points;
    resolution.offset = { offset_x, offset_y, 0 };
    return std::make_shared<Discretisation<2>>(outline, resolution);
}

inline Mesh disc_mesh(int points, double offset_x = 0, double offset_y = 0)
{
    return mesh_of(DiscOutline(), points, offset_x, offset_y);
}

inline Mat<2> turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }
/// Velocity gradient of a rigid spin [1/s].
inline Mat<2> spin(double rate) { return (Mat<2>() << 0, -rate, rate, 0).finished(); }

struct GrainStart {
    Vec<2> centre = Vec<2>::Zero();
    double angle = 0;
    Vec<2> velocity = Vec<2>::Zero();
    Mat<2> velocity_gradient = Mat<2>::Zero();
    bool updated = false; ///< in the updated-Lagrangian form
};

inline Grain<2> make_grain(Mesh mesh, const Material& material, const GrainStart& start = {}, double radius = 1e-3,
                           double density = 1000)
{
    Grain<2> grain;
    grain.id = 0;
    grain.mesh = std::move(mesh);
    grain.law = &law_kernels<2>(material.law);
    grain.parameters = material.parameters;
    grain.density = density;
    grain.radius = radius;
    if (start.updated) grain.updated.emplace();
    grain.place(start.centre, turn(start.angle), start.velocity, start.velocity_gradient);
    return grain;
}

inline std::vector<Grain<2>*> pointers(std::deque<Grain<2>>& grains)
{
    std::vector<Grain<2>*> all;
    for (auto& grain : grains)
        all.push_back(&grain);
    return all;
}

} // namespace softgrain::testing_support
