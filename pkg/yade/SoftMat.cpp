// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftMat.hpp"

#include "SceneCheck.hpp"
#include "SoftState.hpp"

#include <core/Omega.hpp>

namespace yade {

YADE_PLUGIN((SoftMat));

std::string SoftMat::lawName() const
{
    throw softgrain::UserError("SoftMat is no material of its own; take a class made from it, such as NeoHookeanMat.");
}

std::array<double, softgrain::max_parameters> SoftMat::lawParameters() const { return {}; }

const softgrain::LawKernels<2>& SoftMat::law() const
{
    const auto& kernels = softgrain::law_kernels<2>(lawName());
    const std::string name = getClassName() + (label.empty() ? "" : " '" + label + "'");
    if (!(density > 0) || !std::isfinite(density))
        throw softgrain::UserError(name + ": density = " + softgrain::shown(density)
                                   + " kg/m3 has to be positive and finite.");
    if (!(frictionAngle >= 0 && frictionAngle < M_PI / 2))
        throw softgrain::UserError(name + ": frictionAngle = " + softgrain::shown(frictionAngle)
                                   + " rad has to lie in [0, pi/2).");
    if (!(viscosity >= 0) || !std::isfinite(viscosity))
        throw softgrain::UserError(name + ": viscosity = " + softgrain::shown(viscosity)
                                   + " Pa s has to be 0 or more, and finite.");
    const std::string complaint = kernels.complaint(lawParameters().data());
    if (!complaint.empty()) throw softgrain::UserError(name + ": " + complaint + ", or its energy has no minimum at rest.");
    return kernels;
}

shared_ptr<State> SoftMat::newAssocState() const { return shared_ptr<State>(new SoftState); }
bool SoftMat::stateTypeOk(State* state) const
{
    // YADE asks before the first step, outside its parallel loops: the place to look at the whole scene
    const auto& scene = Omega::instance().getScene();
    try {
        requireSoftEngines(*scene);
    } catch (...) {
        scene->runInternalConsistencyChecks = true; // ask again before the next attempt
        throw;
    }
    return dynamic_cast<SoftState*>(state) != nullptr;
}

} // namespace yade
