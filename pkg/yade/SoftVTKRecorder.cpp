// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftVTKRecorder.hpp"

#include "SoftState.hpp"

#include <core/Scene.hpp>

#include <boost/python.hpp>

namespace yade {

YADE_PLUGIN((SoftVTKRecorder));

namespace {
    struct Interpreter {
        const PyGILState_STATE state = PyGILState_Ensure();
        ~Interpreter() { PyGILState_Release(state); }
    };

    /// What a person can mend, as the text of the raised InputError; else prints what happened.
    std::string raisedInPython(const std::string& who)
    {
        namespace py = boost::python;
        PyObject *type, *value, *trace;
        PyErr_Fetch(&type, &value, &trace);
        PyErr_NormalizeException(&type, &value, &trace);
        if (PyErr_GivenExceptionMatches(type, py::object(py::import("softgrain").attr("InputError")).ptr())) {
            const py::handle<> kind(type), error(value), where(py::allow_null(trace));
            return py::extract<std::string>(py::str(error));
        }
        PyErr_Restore(type, value, trace);
        PyErr_Print();
        return who + " failed as printed above.";
    }
} // namespace

void SoftVTKRecorder::action()
{
    namespace py = boost::python;
    for (const auto& body : *scene->bodies)
        if (const SoftState* state = body ? softStateOf(*body) : nullptr; state && !state->prepared())
            throw softgrain::UserError("SoftVTKRecorder: soft grain #" + std::to_string(body->id)
                                       + " has not been set up yet; put the recorder behind SoftIntegrator, as "
                                         "softEngines(more=[...]) does.");
    std::string problem;
    {
        const Interpreter interpreter;
        try {
            py::import("softgrain.vtk_recorder").attr("record")(py::ptr(this));
        } catch (const py::error_already_set&) {
            problem = raisedInPython(getClassName());
        }
    }
    if (!problem.empty()) throw std::runtime_error(problem);
}

} // namespace yade
