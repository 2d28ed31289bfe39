// SPDX-License-Identifier: GPL-2.0-or-later
// Objects with attributes that Python and the archives can see.
//
//   Factorable
//     Serializable
//       Engine        GlobalEngine, PartialEngine, Dispatcher ...
//       Functor       BoundFunctor, IGeomFunctor, IPhysFunctor, LawFunctor
//       Shape, Bound, Material, State, IGeom, IPhys            (all Indexable too)
//       Body, Interaction, Cell, EnergyTracker, MatchMaker, Scene
//
// A class of YADE is declared with YADE_ABI_STOCK (Stock.hpp): its code is in the loaded YADE.
// A class of a plugin is defined with YADE_CLASS_BASE_DOC... (Attributes.hpp).
#pragma once

#include <lib/factory/Factorable.hpp>

namespace yade {

// Hooks around loading and saving; a class may have its own as a member, void postLoad(K&).
template <typename T> void preLoad(T&) { }
template <typename T> void postLoad(T&) { }
template <typename T> void preSave(T&) { }
template <typename T> void postSave(T&) { }

namespace Attr {
    enum flags { noSave = 1, readonly = 2, triggerPostLoad = 4, hidden = 8, noResize = 16 };
}

class Serializable : public Factorable {
public:
    Serializable() { }
    ~Serializable() override;

    string getBaseClassName(unsigned int = 0) const override;
    int getBaseClassNumber() const override;
    string getClassName() const override;

    virtual void pySetAttr(const string& key, const py::object& value);
    virtual py::dict pyDict() const;
    virtual py::dict pyDictCustom() const; // further entries of pyDict
    virtual void callPostLoad();
    virtual void checkPyClassRegistersItself(const string& name) const;
    virtual void pyRegisterClass(py::object scope);
    virtual void pyHandleCustomCtorArgs(py::tuple& args, py::dict& keywords); // may consume positional arguments

    void pyUpdateAttrs(const py::dict& values); // sets each, then callPostLoad
    template <class ArchiveT> void serialize(ArchiveT&, unsigned int) { }
};
static_assert(sizeof(Serializable) == 24, "YADE 2023.02a: size of Serializable");

} // namespace yade

#include <lib/serialization/Attributes.hpp>
#include <lib/serialization/Stock.hpp>
