// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers, vectors and the short names that all headers of YADE rely on (interface of YADE 2023.02a).
#pragma once

#include <boost/python.hpp> // first: it brings Python.h

#include <boost/lexical_cast.hpp>
#include <boost/make_shared.hpp>
#include <boost/preprocessor.hpp>
#include <boost/shared_ptr.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#define YADE_CAST static_cast
#define YADE_PTR_CAST ::boost::static_pointer_cast
#define YADE_PTR_DYN_CAST ::boost::dynamic_pointer_cast

namespace yade {

namespace py = ::boost::python;

using boost::shared_ptr;
using std::cerr;
using std::cout;
using std::endl;
using std::invalid_argument;
using std::logic_error;
using std::make_pair;
using std::pair;
using std::runtime_error;
using std::string;
using std::swap;
using std::vector;

using Real = double;
using mask_t = int; // bits of Body::groupMask

template <typename Scalar> using Vector2 = Eigen::Matrix<Scalar, 2, 1>;
template <typename Scalar> using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar> using Vector6 = Eigen::Matrix<Scalar, 6, 1>;
template <typename Scalar> using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

using Vector2i = Vector2<int>;
using Vector2r = Vector2<Real>;
using Vector3i = Vector3<int>;
using Vector3r = Vector3<Real>;
using Vector6i = Vector6<int>;
using Vector6r = Vector6<Real>;
using VectorXr = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix3r = Matrix3<Real>;
using MatrixXr = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Quaternionr = Eigen::Quaternion<Real>;
using AngleAxisr = Eigen::AngleAxis<Real>;

// Rigid placement: position and orientation.
template <class Scalar> class Se3 {
public:
    Vector3<Scalar> position;
    Eigen::Quaternion<Scalar> orientation;

    Se3() { }
    Se3(Vector3<Scalar> where, Eigen::Quaternion<Scalar> turned)
        : position(where)
        , orientation(turned)
    {
    }
};
using Se3r = Se3<Real>;

const Real NaN = std::numeric_limits<Real>::quiet_NaN();

static_assert(sizeof(Vector3r) == 24 && sizeof(Matrix3r) == 72, "YADE 2023.02a: vectors are packed (EIGEN_DONT_ALIGN)");
static_assert(sizeof(Quaternionr) == 32 && alignof(Quaternionr) == 8, "YADE 2023.02a: quaternions are not over-aligned");
static_assert(sizeof(Se3r) == 56, "YADE 2023.02a: size of Se3r");

} // namespace yade

#include <lib/high-precision/MathSerialization.hpp>
