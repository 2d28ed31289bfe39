// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include "base/types.hpp"

#include <array>
#include <string>
#include <unordered_map>

namespace yade {

/// What the 3D view shows of a soft grain, in the frame of its body [m].
struct GrainPicture {
    using Place = softgrain::Vec<2>;
    std::vector<Place> outline, points;
    std::vector<std::array<Place, 4>>
        tiles;                ///< the part of the grain that each material point stands for, its corners in order
    std::vector<Real> values; ///< of the field at the material points; empty without a field
};

/// Pictures of all soft grains of a scene. The view asks for them one by one, frame after frame, while the simulation runs in
/// another thread: all are taken at once, between two steps, when a grain is asked for that was shown already.
class GrainPictures {
public:
    /// Why there is no such field; empty where there is, and for no field.
    static std::string objection(const std::string& field);
    /// Null when the grain with this state has none.
    const GrainPicture* of(const State& state, const Scene& scene, const std::string& field);
    /// Least and largest value in the pictures; zeros without values.
    Vector2r range() const { return range_; }

private:
    struct Kept {
        GrainPicture picture;
        bool shown = false;
    };
    void renew(const Scene& scene, const std::string& field);

    std::unordered_map<const State*, Kept> kept_;
    Vector2r range_ = Vector2r::Zero();
};

} // namespace yade
