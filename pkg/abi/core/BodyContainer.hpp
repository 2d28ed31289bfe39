// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>

#include <boost/iterator/filter_iterator.hpp>

#include <mutex>

namespace yade {

// O.bodies: iteration skips erased bodies, operator[] returns a null pointer for them.
class BodyContainer : public Serializable {
    using ContainerT = std::vector<shared_ptr<Body>>;
    ContainerT body;
    friend class InteractionContainer;

public:
    bool dirty;
    bool checkedByCollider;
    vector<Body::id_t> insertedBodies;
    vector<Body::id_t> erasedBodies;
    vector<Body::id_t> realBodies;
    bool useRedirection;
    bool enableRedirection;
    vector<Body::id_t> subdomainBodies;
    std::mutex drawloopmutex;

    struct isNonEmptySharedPtr {
        bool operator()(const shared_ptr<Body>& b) const { return bool(b); }
    };
    using iterator = boost::filter_iterator<isNonEmptySharedPtr, ContainerT::iterator>;

    BodyContainer() = delete;
    YADE_ABI_STOCK(BodyContainer)
    iterator begin();
    iterator end();
    size_t size() const;
    bool exists(Body::id_t) const;
    shared_ptr<Body>& operator[](unsigned int id);
    const shared_ptr<Body>& operator[](unsigned int id) const;
    Body::id_t insert(shared_ptr<Body>);
    bool erase(Body::id_t, bool alsoClumpMembers);
};
YADE_ABI_STOCK_END(BodyContainer, 200)

} // namespace yade
