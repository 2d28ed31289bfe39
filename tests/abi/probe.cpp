// SPDX-License-Identifier: GPL-2.0-or-later
// Python module _abi_probe: YADE's objects as the declarations of pkg/abi see them, for abi_selftest.py to compare.
#include "fields.hpp"

#include <core/Clump.hpp>
#include <core/InteractionLoop.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/MatchMaker.hpp>
#include <pkg/yade/plugin_classes.hpp>

namespace yade::probe {

const Field& find(const string& cls, const string& name) { return table().at(cls).fields.at(name); }

py::list classes()
{
    py::list names;
    for (const auto& entry : table())
        names.append(entry.first);
    return names;
}

py::list fields(const string& cls)
{
    py::list names;
    for (const auto& entry : table().at(cls).fields)
        names.append(entry.first);
    return names;
}

shared_ptr<Serializable> created(const string& cls)
{
    return boost::dynamic_pointer_cast<Serializable>(ClassFactory::instance().createShared(cls));
}

py::object distinct(const string& cls, const string& name, int seed) { return find(cls, name).distinct(seed); }
bool holds(py::object self, const string& cls, const string& name, py::object value)
{
    return find(cls, name).holds(self, value);
}
void write(py::object self, const string& cls, const string& name, py::object value) { find(cls, name).write(self, value); }
bool same(const string& cls, const string& name, py::object a, py::object b) { return find(cls, name).same(a, b); }
py::dict dictionary(const Serializable& self) { return self.pyDict(); }
void assign(Serializable& self, const string& name, py::object value) { self.pySetAttr(name, value); } // without postLoad

// Answers of virtual functions, called through the declared tables.
py::dict answers(const shared_ptr<Serializable>& self)
{
    py::dict said;
    said["class"] = self->getClassName();
    said["base"] = py::make_tuple(self->getBaseClassName(0), self->getBaseClassNumber());
    if (const auto* o = dynamic_cast<Indexable*>(self.get())) {
        said["index"] = o->getClassIndex();
        said["kin"] = o->getMaxCurrentlyUsedClassIndexOfKin();
        if (o->getClassIndex() >= 0) said["baseIndex"] = o->getBaseClassIndex(1);
    }
    if (auto* o = dynamic_cast<Engine*>(self.get())) said["activated"] = o->isActivated();
    if (const auto* o = dynamic_cast<Dispatcher*>(self.get());
        o && self->getClassName() != "Dispatcher") // that one terminates
        said["dispatch"] = py::make_tuple(o->getDimension(), o->getFunctorType());
    if (const auto* o = dynamic_cast<Material*>(self.get()))
        said["state"] = py::make_tuple(o->newAssocState()->getClassName(), o->stateTypeOk(o->newAssocState().get()));
    return said;
}

string renders(const GlShapeFunctor& f) { return f.renders(); }
vector<string> functorTypes(const Functor& f) { return f.getFunctorTypes(); }

template <class Functors> py::list names(const Functors& functors)
{
    py::list all;
    for (const auto& f : functors)
        all.append(f->getClassName());
    return all;
}

// The running scene, read through the declared members and functions.
py::dict live()
{
    Scene& scene = *Omega::instance().getScene();
    py::dict seen;
    py::list ids, pairs, forces, intrs, functors, caches;
    scene.forces.sync();
    for (const auto& b : *scene.bodies) {
        ids.append(b->getId());
        forces.append(py::make_tuple(scene.forces.getForce(b->id), scene.forces.getTorque(b->id)));
        intrs.append(b->intrs.size());
        functors.append(b->shape && b->shape->boundFunctor ? b->shape->boundFunctor->getClassName() : "");
    }
    for (const auto& i : *scene.interactions) {
        const bool found = scene.interactions->find(i->getId2(), i->getId1()) == i && (*scene.interactions)[i->linIx] == i;
        pairs.append(py::make_tuple(i->id1, i->id2, i->isReal(), found));
        if (i->isReal())
            caches.append(py::make_tuple(i->functorCache.geomExists, i->functorCache.geom->getClassName(),
                                         i->functorCache.phys->getClassName(), i->functorCache.constLaw->getClassName()));
    }
    for (const auto& e : scene.engines)
        if (const auto loop = boost::dynamic_pointer_cast<InteractionLoop>(e))
            seen["loop"] = py::make_tuple(names(loop->geomDispatcher->functors), names(loop->physDispatcher->functors),
                                          names(loop->lawDispatcher->functors));
    py::dict energies;
    for (const auto& name : scene.energy->names)
        energies[name.first] = scene.energy->energies.get(name.second);
    seen["ids"] = ids;
    seen["size"] = scene.bodies->size();
    seen["exists"] = py::make_tuple(scene.bodies->exists(0), scene.bodies->exists(100000));
    seen["forces"] = forces;
    seen["lastReset"] = scene.forces.lastReset;
    seen["synced"] = scene.forces.synced;
    seen["threads"] = scene.forces.getNumAllocatedThreads();
    seen["intrs"] = intrs;
    seen["pairs"] = pairs;
    seen["interactions"] = scene.interactions->size();
    seen["boundFunctors"] = functors;
    seen["caches"] = caches;
    seen["energies"] = energies;
    seen["energy"] = scene.energy->total();
    seen["cell"]
        = py::make_tuple(scene.cell->getSize(), scene.cell->getVolume(), scene.cell->getShearTrsf(), scene.cell->hasShear());
    seen["locks"] = py::make_tuple(scene.bodies->drawloopmutex.try_lock(), scene.interactions->drawloopmutex.try_lock());
    scene.bodies->drawloopmutex.unlock();
    scene.interactions->drawloopmutex.unlock();
    return seen;
}

py::dict members(Clump& clump)
{
    py::dict all;
    for (const auto& m : clump.members)
        all[m.first] = py::make_tuple(m.second.position, m.second.orientation);
    return all;
}

py::tuple facet(Facet& f) { return py::make_tuple(f.ne[0], f.icr, f.vl[2], f.vu[1]); }
Real match(const MatchMaker& m, int id1, int id2, Real v1, Real v2) { return m(id1, id2, v1, v2); }
void requestErase(int id1, int id2) { Omega::instance().getScene()->interactions->requestErase(id1, id2); }
bool stateLock(State& s)
{
    return s.updateMutex.try_lock() && (s.updateMutex.unlock(), &s.pos == &s.se3.position && &s.ori == &s.se3.orientation);
}

void expose()
{
    py::scope().attr("tinyClasses") = registerNewPluginClasses();
    py::def("classes", classes);
    py::def("fields", fields);
    py::def("created", created);
    py::def("distinct", distinct);
    py::def("holds", holds);
    py::def("write", write);
    py::def("same", same);
    py::def("dictionary", dictionary);
    py::def("assign", assign);
    py::def("answers", answers);
    py::def("functorTypes", functorTypes);
    py::def("renders", renders);
    py::def("live", live);
    py::def("members", members);
    py::def("facet", facet);
    py::def("match", match);
    py::def("requestErase", requestErase);
    py::def("stateLock", stateLock);
}

} // namespace yade::probe

BOOST_PYTHON_MODULE(_abi_probe) { yade::probe::expose(); }
