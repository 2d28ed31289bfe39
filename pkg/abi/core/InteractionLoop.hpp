// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <core/GlobalEngine.hpp>

#include <list>

namespace yade {

class IntrCallback;

class InteractionLoop : public GlobalEngine {
    bool alreadyWarnedNoCollider;
    vector<std::list<std::pair<Body::id_t, Body::id_t>>> eraseAfterLoopIds; // by thread

public:
    shared_ptr<IGeomDispatcher> geomDispatcher;
    shared_ptr<IPhysDispatcher> physDispatcher;
    shared_ptr<LawDispatcher> lawDispatcher;
    vector<shared_ptr<IntrCallback>> callbacks;
    bool loopOnSortedInteractions;

    InteractionLoop();
    YADE_ABI_STOCK(InteractionLoop)
    void pyHandleCustomCtorArgs(py::tuple&, py::dict&) override;
    void action() override;
};
YADE_ABI_STOCK_END(InteractionLoop, 216)

} // namespace yade
