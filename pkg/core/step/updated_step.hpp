// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit step of one updated-Lagrangian grain, see assembly.hpp.
#pragma once

#include "step/grain.hpp"

#include <string>

namespace softgrain {

template <int Dim> void predict_updated(Grain<Dim>& grain, double dt, const Vec<Dim>& gravity);
/// Takes the impulses on the surface in and moves the nodes; what is wrong then, or nothing.
template <int Dim> std::string correct_updated(Grain<Dim>& grain, double dt);
/// Surface and motion of a grain whose nodes another scheme has moved; what is wrong with that.
template <int Dim> std::string take_updated(Grain<Dim>& grain, double dt);

} // namespace softgrain
