// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Omega.hpp>

#include <algorithm>
#include <iterator>

namespace yade {

// Registers in yade.wrapper the classes that loaded libraries have announced (YADE_PLUGIN) since YADE started,
// and returns their names. Omega registers everything in ClassFactory::pluginClasses, and YADE's own classes
// must not be registered twice; so only the new names are there while it works.
inline boost::python::list registerNewPluginClasses()
{
    struct Announced {
        std::list<std::string>& names = ClassFactory::instance().pluginClasses;
        const std::list<std::string> all { names };
        ~Announced() { names = all; }
    } announced;

    const auto& known = Omega::instance().getDynlibsDescriptor();
    announced.names.remove_if([&](const std::string& name) { return known.count(name) > 0; });
    const std::list<std::string> fresh = announced.names;
    Omega::instance().loadPlugins({});

    boost::python::list registered;
    const boost::python::object wrapper = boost::python::import("yade.wrapper");
    for (const auto& name : fresh)
        if (PyObject_HasAttrString(wrapper.ptr(), name.c_str())) registered.append(name);
    return registered;
}

} // namespace yade
