// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python/make_constructor.hpp>
#include <boost/python/raw_function.hpp>

#include <limits>

namespace yade::abi {

// Python's K(*args, **keywords) handed to create(tuple, dict). make_constructor alone would refuse keywords,
// so the call passes through a raw function, whose keyword range is empty.
class KeywordConstructor {
    boost::python::object init;

public:
    explicit KeywordConstructor(boost::python::object made)
        : init(made)
    {
    }

    PyObject* operator()(PyObject* args, PyObject* keywords) const
    {
        namespace bp = boost::python;
        const bp::tuple all { bp::detail::borrowed_reference(args) };
        const bp::dict named = keywords ? bp::dict(bp::detail::borrowed_reference(keywords)) : bp::dict();
        return bp::incref(bp::object(init(bp::object(all[0]), bp::tuple(all.slice(1, bp::_)), named)).ptr());
    }

    template <class Create> static boost::python::object make(Create create)
    {
        namespace bp = boost::python;
        return bp::detail::make_raw_function(bp::objects::py_function(KeywordConstructor(bp::make_constructor(create)),
                                                                      boost::mpl::vector2<void, bp::object>(), 1,
                                                                      std::numeric_limits<unsigned>::max()));
    }
};

} // namespace yade::abi
