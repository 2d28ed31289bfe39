// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python/detail/wrap_python.hpp>

#include <lib/factory/ClassFactory.hpp>

#include <map>
#include <set>

namespace yade {

class Scene;

struct DynlibDescriptor {
    std::set<string> baseClasses;
    bool isSerializable;
};
static_assert(sizeof(DynlibDescriptor) == 56, "YADE 2023.02a: size of DynlibDescriptor");

// The running YADE. Only functions are declared: nothing reads its members from here.
class Omega : public Singleton<Omega> {
    Omega() = delete;

public:
    const shared_ptr<Scene>& getScene() const;
    const std::map<string, DynlibDescriptor>& getDynlibsDescriptor() const;
    void loadPlugins(vector<string> files); // also registers every class of ClassFactory::pluginClasses in yade.wrapper
    bool isInheritingFrom(const string& className, const string& baseClassName);
    bool isInheritingFrom_recursive(const string& className, const string& baseClassName);
    bool isRunning();
    Real getRealTime() const;
    string tmpFilename();
};

} // namespace yade
