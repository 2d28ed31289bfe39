// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <pkg/common/MatchMaker.hpp>

#include "SoftMat.hpp"

namespace yade {

class Ip2_FrictMat_SoftMat_SoftPhys : public IPhysFunctor {
public:
    void go(const shared_ptr<Material>& material1, const shared_ptr<Material>& material2,
            const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(FrictMat, SoftMat);
    YADE_CLASS_BASE_DOC_ATTRS(
            Ip2_FrictMat_SoftMat_SoftPhys,
            IPhysFunctor,
            "Friction of a soft grain with a body of :yref:`FrictMat`: tan of the smaller friction angle, unless frictAngle says otherwise.",
            ((shared_ptr<MatchMaker>,
              frictAngle,
              ,
              ,
              "Friction angle of a pair of materials [rad], from their ids and angles; none: the smaller of the two.")));
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_SoftMat_SoftPhys);

class Ip2_SoftMat_SoftMat_SoftPhys : public Ip2_FrictMat_SoftMat_SoftPhys {
public:
    FUNCTOR2D(SoftMat, SoftMat);
    YADE_CLASS_BASE_DOC(
            Ip2_SoftMat_SoftMat_SoftPhys,
            Ip2_FrictMat_SoftMat_SoftPhys,
            "Friction of two soft grains, as :yref:`Ip2_FrictMat_SoftMat_SoftPhys`.");
};
REGISTER_SERIALIZABLE(Ip2_SoftMat_SoftMat_SoftPhys);

} // namespace yade
