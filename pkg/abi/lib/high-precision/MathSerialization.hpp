// SPDX-License-Identifier: GPL-2.0-or-later
// How YADE 2023.02a archives vectors, matrices and placements: component tags, no tracking, no version number.
#pragma once

#include <lib/base/Math.hpp>

#include <boost/serialization/is_bitwise_serializable.hpp>
#include <boost/serialization/nvp.hpp>

BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector6i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector6r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Matrix3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Quaternionr)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Se3r)

namespace yade::abi {

template <class Archive, class Indexed, int N> void archiveComponents(Archive& ar, Indexed& v, const char* const (&tags)[N])
{
    for (int i = 0; i < N; i++)
        ar& boost::serialization::make_nvp(tags[i], v[i]);
}

} // namespace yade::abi

namespace boost::serialization {

#define YADE_ABI_ARCHIVE_VECTOR(Type, ...)                                                                                  \
    template <class Archive> void serialize(Archive& ar, Type& v, const unsigned int)                                       \
    {                                                                                                                       \
        yade::abi::archiveComponents(ar, v, { __VA_ARGS__ });                                                               \
    }
YADE_ABI_ARCHIVE_VECTOR(yade::Vector2i, "x", "y")
YADE_ABI_ARCHIVE_VECTOR(yade::Vector2r, "x", "y")
YADE_ABI_ARCHIVE_VECTOR(yade::Vector3i, "x", "y", "z")
YADE_ABI_ARCHIVE_VECTOR(yade::Vector3r, "x", "y", "z")
YADE_ABI_ARCHIVE_VECTOR(yade::Vector6i, "v0", "v1", "v2", "v3", "v4", "v5")
YADE_ABI_ARCHIVE_VECTOR(yade::Vector6r, "v0", "v1", "v2", "v3", "v4", "v5")
#undef YADE_ABI_ARCHIVE_VECTOR

template <class Archive> void serialize(Archive& ar, yade::Matrix3r& m, const unsigned int)
{
    static const char* const tags[] = { "m00", "m01", "m02", "m10", "m11", "m12", "m20", "m21", "m22" };
    for (int i = 0; i < 9; i++)
        ar& make_nvp(tags[i], m(i / 3, i % 3));
}

template <class Archive> void serialize(Archive& ar, yade::Quaternionr& q, const unsigned int)
{
    ar& make_nvp("w", q.w());
    ar& make_nvp("x", q.x());
    ar& make_nvp("y", q.y());
    ar& make_nvp("z", q.z());
}

template <class Archive> void serialize(Archive& ar, yade::Se3r& s, const unsigned int)
{
    ar& make_nvp("position", s.position);
    ar& make_nvp("orientation", s.orientation);
}

} // namespace boost::serialization
