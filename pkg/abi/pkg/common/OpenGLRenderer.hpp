// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

namespace yade {

// What draws YADE's 3D view. Its members are not declared: the one there is, made by YADE's windows, is used through references.
class OpenGLRenderer : public Serializable {
public:
    OpenGLRenderer() = delete;
    YADE_ABI_STOCK(OpenGLRenderer)
    void init(); // makes a functor of every class that draws
};

} // namespace yade
