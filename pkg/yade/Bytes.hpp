// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python.hpp>

#include <vector>

namespace yade {

/// A copy for numpy.frombuffer.
template <class Number> boost::python::object asBytes(const Number* values, size_t count)
{
    return boost::python::object(boost::python::handle<>(
        PyBytes_FromStringAndSize(reinterpret_cast<const char*>(values), Py_ssize_t(count * sizeof(Number)))));
}
inline boost::python::object asBytes(const std::vector<double>& values) { return asBytes(values.data(), values.size()); }

} // namespace yade
