// SPDX-License-Identifier: GPL-2.0-or-later
// Creation of objects by class name, and the list of classes that plugins bring along.
#pragma once

#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>

// All archive types have to be known before export.hpp.
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>

#include <boost/serialization/export.hpp>

#include <boost/serialization/list.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <list>
#include <map>

namespace yade {

class Factorable;

class ClassFactory : public Singleton<ClassFactory> {
    using CreateShared = shared_ptr<Factorable> (*)();
    using CreatePure = Factorable* (*)();
    using CreateCustom = void* (*)();

    struct Creators {
        CreatePure pure;
        CreateShared shared;
        CreateCustom custom;
    };
    struct LibraryManager { // DynLibManager in YADE
        std::map<const string, void*> handles;
        bool autoUnload;
        string lastError;
    };
    LibraryManager dlm;
    std::map<string, Creators> map;

    ClassFactory() = delete;
    ClassFactory(const ClassFactory&) = delete;
    virtual ~ClassFactory();

public:
    std::list<string> pluginClasses; // every class name of every plugin loaded so far

    bool registerFactorable(string name, CreatePure, CreateShared, CreateCustom);
    void registerPluginClasses(const char* fileAndClasses[]);
    shared_ptr<Factorable> createShared(string name);

    virtual string getClassName() const;
    virtual string getBaseClassName(int) const;
};
static_assert(sizeof(ClassFactory) == 168, "YADE 2023.02a: size of ClassFactory");

} // namespace yade

// After a class: makes it known to the factory by its name.
#define REGISTER_FACTORABLE(K)                                                                                              \
    inline shared_ptr<Factorable> CreateShared##K() { return shared_ptr<K>(new K); }                                        \
    inline Factorable* Create##K() { return new K; }                                                                        \
    inline void* CreatePureCustom##K() { return new K; }                                                                    \
    [[maybe_unused]] const bool registered##K                                                                               \
        = ClassFactory::instance().registerFactorable(#K, Create##K, CreateShared##K, CreatePureCustom##K);

// In a source file, inside namespace yade: YADE_PLUGIN((A)(B)) lists the classes that this file brings to Python and to the archives.
#define YADE_PLUGIN(classes)                                                                                                \
    namespace {                                                                                                             \
        __attribute__((constructor)) void BOOST_PP_CAT(announcePlugin_, BOOST_PP_SEQ_HEAD(classes))()                       \
        {                                                                                                                   \
            const char* names[] = { __FILE__, BOOST_PP_SEQ_FOR_EACH(YADE_ABI_PLUGIN_NAME, ~, classes) nullptr };            \
            ClassFactory::instance().registerPluginClasses(names);                                                          \
        }                                                                                                                   \
    }                                                                                                                       \
    }                                                                                                                       \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_PLUGIN_EXPORT, ~, classes)                                                               \
    namespace yade {
#define YADE_ABI_PLUGIN_NAME(r, _, K) BOOST_PP_STRINGIZE(K),
#define YADE_ABI_PLUGIN_EXPORT(r, _, K) BOOST_CLASS_EXPORT_IMPLEMENT(yade::K)
