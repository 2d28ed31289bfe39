// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>

#include <mutex>

namespace yade {

// O.interactions, potential ones included; the order is not that of ids.
class InteractionContainer : public Serializable {
    using ContainerT = vector<shared_ptr<Interaction>>;
    ContainerT linIntrs;
    ContainerT sortedIntrs;
    const BodyContainer::ContainerT* bodies;
    size_t currSize;
    shared_ptr<Interaction> empty;
    ContainerT interaction;

public:
    bool dirty;
    std::mutex drawloopmutex;
    bool serializeSorted;
    long iterColliderLastRun;

    using iterator = ContainerT::iterator;
    using const_iterator = ContainerT::const_iterator;

    InteractionContainer() = delete;
    YADE_ABI_STOCK(InteractionContainer)
    iterator begin() { return linIntrs.begin(); }
    iterator end() { return linIntrs.end(); }
    const_iterator begin() const { return linIntrs.begin(); }
    const_iterator end() const { return linIntrs.end(); }
    size_t size() { return currSize; }
    shared_ptr<Interaction>& operator[](size_t i) { return linIntrs[i]; }
    const shared_ptr<Interaction>& operator[](size_t i) const { return linIntrs[i]; }

    const shared_ptr<Interaction>& find(Body::id_t, Body::id_t); // null pointer when there is none
    bool insert(const shared_ptr<Interaction>&);
    bool erase(Body::id_t, Body::id_t, int place = -1);
    void requestErase(Body::id_t, Body::id_t);
    void requestErase(const shared_ptr<Interaction>&);
    void requestErase(Interaction*);
};
YADE_ABI_STOCK_END(InteractionContainer, 192)

} // namespace yade
