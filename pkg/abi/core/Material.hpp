// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/State.hpp>

namespace yade {

// Derived: ElastMat, FrictMat.
class Material : public Serializable, public Indexable {
public:
    int id = -1; // in Scene::materials, -1 when not shared
    string label;
    Real density = 1000; // [kg/m3]

    Material() { }
    YADE_ABI_STOCK(Material)
    virtual shared_ptr<State> newAssocState() const;
    virtual bool stateTypeOk(State*) const;
    YADE_ABI_STOCK_INDEX_HEAD(Material)

    static const shared_ptr<Material> byId(int id, Scene* = nullptr);
    static const shared_ptr<Material> byLabel(const string& label, Scene* = nullptr);
};
YADE_ABI_STOCK_END(Material, 80)

} // namespace yade
