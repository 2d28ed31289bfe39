// SPDX-License-Identifier: GPL-2.0-or-later
// Second derivatives of the energy at one point, in the plane, for the stiffness of implicit steps and for stable steps.
#pragma once

#include "material/material.hpp"

#include <type_traits>

namespace softgrain {

template <class Law, class = void> struct gives_plane_tangent : std::false_type {
};
template <class Law>
struct gives_plane_tangent<Law, std::void_t<decltype(Law::plane_tangent((const double*)nullptr, 1.0, 1.0))>>
    : std::true_type {
};

/// A positive semi-definite second derivative of the energy at a point,
///     even 1 + odd d2J/dF2 + sum over r, s of outer[r][s] direction[r] (x) direction[s].
template <class T, int Ranks> struct PointTangent {
    static constexpr int ranks = Ranks;
    T even, odd;
    Tensor<2, T> direction[Ranks];
    T outer[Ranks][Ranks];

    /// From its eigenvalues on dilatation and rotation, and on the two shears, directions left out; negative ones are cut.
    SOFTGRAIN_INLINE void set(const T& alike, const T& opposite)
    {
        const T plus = larger(alike, T {}), minus = larger(opposite, T {});
        even = 0.5 * (plus + minus);
        odd = 0.5 * (plus - minus);
    }
    SOFTGRAIN_INLINE void scale(double by)
    {
        even *= by;
        odd *= by;
        for (auto& row : outer)
            for (T& entry : row)
                entry *= by;
    }
};

/// Derivatives of any isotropic w at F as a function of p = l1 + l2 and m = l1 - l2, sum and difference of the principal
/// stretches. The turned part of F has the size p, its mirrored part the size m:
///     2 F = (a0 -a1; a1 a0) + (b0 b1; b1 -b0),    |a| = p, |b| = m.
/// So w's second derivative is 2 pp, 2 pm, 2 mm on the unit tensors along a and b, `twist` across a and `flip` across b.
template <class T> struct StretchTangent {
    T p, m, pp, pm, mm, twist, flip;
    Tensor<2, T> along[2]; ///< unit tensors along a and b

    /// By central differences of the law's stresses at diagonal F, error of the order of their square, 1e-10.
    template <class Law> static SOFTGRAIN_INLINE StretchTangent of(const T* constants, const Tensor<2, T>& F)
    {
        StretchTangent s;
        const T a0 = F.at[0][0] + F.at[1][1], a1 = F.at[1][0] - F.at[0][1], b0 = F.at[0][0] - F.at[1][1],
                b1 = F.at[1][0] + F.at[0][1];
        s.p = square_root(a0 * a0 + a1 * a1);
        const T exact = square_root(b0 * b0 + b1 * b1), h = 1e-5 * 0.5 * (s.p - exact);
        s.m = larger(exact, h); // at m = 0 flip is the limit of its quotient
        const T a = 0.70710678118654752440 / s.p, b = 0.70710678118654752440 / s.m;
        s.along[0] = { { { a * a0, -a * a1 }, { a * a1, a * a0 } } };
        s.along[1] = { { { b * b0, b * b1 }, { b * b1, -b * b0 } } };
        T slope[5][2]; // dw/dp and dw/dm at p and m, at p + h, p - h, m + h, m - h
#pragma GCC unroll 5
        for (int k = 0; k < 5; ++k) {
            const T sum = s.p
                + (k == 1       ? 1.0
                       : k == 2 ? -1.0
                                : 0.0)
                    * h,
                    difference = s.m
                + (k == 3       ? 1.0
                       : k == 4 ? -1.0
                                : 0.0)
                    * h;
            const T l1 = 0.5 * (sum + difference), l2 = 0.5 * (sum - difference);
            const Tensor<2, T> diagonal { { { l1, T {} }, { T {}, l2 } } };
            Tensor<2, T> P;
            Law::template stress<2, T>(constants, diagonal, cofactor(diagonal), 1.0 / (l1 * l2), P);
            slope[k][0] = 0.5 * (P.at[0][0] + P.at[1][1]);
            slope[k][1] = 0.5 * (P.at[0][0] - P.at[1][1]);
        }
        const T half = 0.5 / h;
        s.pp = half * (slope[1][0] - slope[2][0]);
        s.pm = half * (slope[3][0] - slope[4][0]);
        s.mm = half * (slope[3][1] - slope[4][1]);
        s.twist = 2.0 * slope[0][0] / s.p;
        s.flip = 2.0 * slope[0][1] / s.m;
        return s;
    }
    /// An upper bound of the eigenvalues.
    SOFTGRAIN_INLINE T most() const
    {
        const T block = pp + mm + square_root((pp - mm) * (pp - mm) + 4.0 * pm * pm);
        return larger(block, larger(twist, flip));
    }
};

/// The law's w with what the mean dilatation adds at a point: (slope + stiff excess) d2J/dF2 + stiff cof F (x) cof F, excess that
/// of J over its mean. In the plane identity + bend and identity - bend are the eigenvalues of PlaneTangent without its
/// cofactor's part.
template <class Law, class T>
SOFTGRAIN_INLINE auto point_tangent(const T* p, const Tensor<2, T>& F, const T& J, const T& inverse_J, const T& slope,
                                    const T& stiff, const T& excess)
{
    if constexpr (gives_plane_tangent<Law>::value) {
        PointTangent<T, 1> point;
        const PlaneTangent<T> tangent = Law::plane_tangent(p, J, inverse_J);
        const T bend = tangent.bend + slope + stiff * excess;
        point.set(tangent.identity + bend, tangent.identity - bend);
        point.direction[0] = cofactor(F);
        point.outer[0][0] = tangent.cofactor + stiff;
        return point;
    } else {
        PointTangent<T, 2> point;
        const auto s = StretchTangent<T>::template of<Law>(p, F);
        const T more = slope + stiff * excess;
        point.set(s.twist + more, s.flip - more);
        // the block of a and b, its negative eigenvalue cut
        const T aa = 2.0 * s.pp + more + 0.5 * stiff * s.p * s.p, bb = 2.0 * s.mm - more + 0.5 * stiff * s.m * s.m,
                ab = 2.0 * s.pm - 0.5 * stiff * s.p * s.m;
        const T middle = 0.5 * (aa + bb), half = 0.5 * (aa - bb), radius = square_root(half * half + ab * ab);
        const T high = larger(middle + radius, T {}), low = larger(middle - radius, T {});
        const T kept = 0.5 * (high - low) / larger(radius, broadcast<T>(1e-300)), centre = 0.5 * (high + low);
        point.direction[0] = s.along[0];
        point.direction[1] = s.along[1];
        point.outer[0][0] = centre + kept * half - (point.even + point.odd);
        point.outer[1][1] = centre - kept * half - (point.even - point.odd);
        point.outer[0][1] = point.outer[1][0] = kept * ab;
        return point;
    }
}

/// The smallest principal stretch; less where a law has stiffened so that waves are faster than those of its undeformed solid
/// over that stretch: its inverse bounds the rise of frequencies.
template <class Law, int Dim, class T> SOFTGRAIN_INLINE T bounding_stretch(const T* p, const Tensor<Dim, T>& F)
{
    const T stretch = smallest_stretch(F);
    if constexpr (gives_plane_tangent<Law>::value)
        return stretch;
    else {
        const T volumetric = Law::volumetric_modulus(p), rest = volumetric + 2.0 * Law::shear_modulus(p);
        const T now = volumetric + StretchTangent<T>::template of<Law>(p, F).most() * stretch * stretch;
        return stretch * square_root(rest / larger(now, rest));
    }
}

} // namespace softgrain
