// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftGrain.hpp"

#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

class Gl1_SoftGrain : public GlShapeFunctor {
public:
    void go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&) override;

    RENDERS(SoftGrain);
    YADE_CLASS_BASE_DOC_STATICATTRS(
            Gl1_SoftGrain,
            GlShapeFunctor,
            "Draws a :yref:`SoftGrain` as it is deformed, in the colour of its shape or in those of a field. In wire mode the outline alone. "
            "Grains lie in the xy-plane: look along z, as with yade.qt.View().viewDir = (0, 0, -1). While a step that takes long runs, the view "
            "shows grains as they were.",
            ((string,
              field,
              "",
              ,
              "What colours show: 'pressure', 'vonMises' [Pa], 'J', 'stretch' (the largest) [-], 'displacement' [m], 'velocity' [m/s] "
              "(their magnitudes), 'plasticStrain' [-], each at every material point; empty: the colour of the shape."))(
                    (Vector2r,
                     range,
                     Vector2r::Zero(),
                     ,
                     "Values of the field with the first and the last colour (dark blue and yellow) [its unit]; both equal: the least and the largest of all grains."))(
                    (Vector2r, shownRange, Vector2r::Zero(), Attr::readonly, "What range the last picture has [unit of the field]."))(
                    (bool, outline, true, , "Draw the boundary as a line."))(
                    (bool, points, false, , "Draw a dot at every material point.")));
};
REGISTER_SERIALIZABLE(Gl1_SoftGrain);

} // namespace yade
