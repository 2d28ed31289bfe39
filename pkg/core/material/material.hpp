// SPDX-License-Identifier: GPL-2.0-or-later
// A hyperelastic law gives its energy density per reference volume as
//
//     W = U(J) + w(F),        P = U'(J) cof F + dw/dF
//
// U is the part that makes a nearly incompressible grain stiff. The grid evaluates it with the mean J of a
// region (mean dilatation), w at every material point: that is the cure of volumetric locking. A law is a
// struct like NeoHookean; all its functions are pure and work on lanes. doc/add_a_law.md shows how to add one.
//
//     name              what messages and files call it
//     parameters        names of its constants, in the order of the array p [Pa]
//     volumetric_energy U(J) [J/m3]
//     volumetric_slope  U'(J) [Pa], given 1/J too: divisions are shared between points
//     volumetric_modulus U''(1) [Pa]
//     shear_modulus     mu of the small-strain limit [Pa]
//     energy            w(F) [J/m3]
//     stress            dw/dF [Pa], given cof F and 1/J
//     volumetric_curvature  U''(J) [Pa], given 1/J too
//     plane_tangent     d2w/dF2 in the plane [Pa], where it has the form of PlaneTangent; left out, differences of the stress
//                       stand in (step/point_tangent.hpp)
//     wave_modulus      lambda + 2 mu of the small-strain limit [Pa]
//     complaint         why the constants give an unstable energy, or ""
//     memory            first values of what a point remembers; the functions above find it behind the constants in p. Its
//                       last number is the plastic strain that has gathered. None: what follows is not there
//     advance           makes a point remember the end of a step at F, in p; returns what was dissipated [J/m3]
//     elastic           constants with which nothing of that happens
#pragma once

#include "base/tensor.hpp"
#include "base/types.hpp"

#include <array>
#include <cmath>
#include <string>

namespace softgrain {

/// Second derivative of an isotropic energy in the plane:
///     d2w/dF2 = identity 1 + cofactor cof F (x) cof F + bend d2J/dF2.
/// All three depend on J alone where w is linear in tr C besides a function of J. d2J/dF2 is constant, with eigenvalues +1
/// (dilatation and rotation) and -1 (the two shears).
template <class T> struct PlaneTangent {
    T identity, cofactor, bend;
};

/// U = lambda/2 (ln J)^2, lambda the first of a law's constants.
struct LogarithmicVolume {
    template <class T> static SOFTGRAIN_INLINE T volumetric_energy(const T* p, const T& J)
    {
        const T log_J = logarithm(J);
        return 0.5 * p[0] * log_J * log_J;
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_modulus(const T* p) { return p[0]; }
    template <class T> static SOFTGRAIN_INLINE T volumetric_slope(const T* p, const T& J, const T& inverse_J)
    {
        return p[0] * logarithm(J) * inverse_J;
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_curvature(const T* p, const T& J, const T& inverse_J)
    {
        return p[0] * (1.0 - logarithm(J)) * inverse_J * inverse_J;
    }
    static std::string volumetric_complaint(const double* p)
    {
        if (!(p[0] >= 0) || !std::isfinite(p[0])) return "lambda = " + shown(p[0]) + " Pa has to be 0 or more, and finite";
        return "";
    }
};

} // namespace softgrain
