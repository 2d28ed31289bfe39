// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

namespace yade {

/// Throws std::runtime_error, one sentence, when a scene with soft grains has no complete list of engines: a missing
/// one would leave them standing still or passing through each other; or when it is periodic. Scenes without soft grains pass.
void requireSoftEngines(const Scene& scene);

} // namespace yade
