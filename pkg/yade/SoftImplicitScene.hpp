// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftPairs.hpp"

#include "step/implicit_step.hpp"

#include <functional>
#include <map>

namespace yade {

/// The running scene as an implicit step sees it, between the begin and the end of a step of YADE.
class SoftImplicitScene : public softgrain::ImplicitScene<2> {
public:
    /// What brings the pairs up to date, by the collider and the interaction loop.
    using Search = std::function<void()>;
    SoftImplicitScene(const SoftBodies& soft, SoftPairs& pairs)
        : soft_(soft)
        , pairs_(pairs)
    {
    }

    /// Begins a step; `ahead`: walls and boxes stand already where they will be at its end.
    void begin(const Scene& scene, double dt, bool ahead, const Search& search);
    /// A substep has been taken.
    void pass(double dt) { elapsed_ += dt; }

    std::vector<softgrain::BarrierContact<2>> contacts(double ahead, double dt) override;
    softgrain::Vec<2> prediction(const softgrain::Vec<2>& place, double dt) const override;

private:
    struct Side {
        double position, velocity;
    };
    bool boxesHold(double ahead, double dt) const;
    softgrain::Surface<2>& first(const SoftPairs::Pair& pair, double dt);

    const SoftBodies& soft_;
    SoftPairs& pairs_;
    const Scene* scene_ = nullptr;
    Search search_;
    double length_ = 0, elapsed_ = 0, fastest_ = 0; ///< of the step, of it so far [s]; speed of a rigid body [m/s]
    bool ahead_ = false, searched_ = false;
    std::array<std::vector<Side>, 2> walls_;               ///< by axis, ascending, at the start of the step
    std::map<const SoftGeom*, std::vector<double>> boxes_; ///< outlines at the start of the step [m]
};

} // namespace yade
