// SPDX-License-Identifier: GPL-2.0-or-later
// The compiled half of the Python package softgrain. Importing it adds the plugin's classes to yade.wrapper;
// _softgrain.classes lists their names. The package checks the running YADE before it imports this module.
#include "plugin_classes.hpp"

#include <pkg/common/OpenGLRenderer.hpp>

namespace {
/// The 3D view knows all classes that draw from now on.
void renewRenderer(yade::OpenGLRenderer& renderer) { renderer.init(); }
}

BOOST_PYTHON_MODULE(_softgrain)
{
    boost::python::import("softgrain._guard").attr("check")();
    boost::python::scope().attr("classes") = yade::registerNewPluginClasses();
    boost::python::def("renewRenderer", renewRenderer);
}
