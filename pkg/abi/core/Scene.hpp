// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Cell.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Engine.hpp>
#include <core/ForceContainer.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Material.hpp>

#include <boost/date_time/posix_time/posix_time_types.hpp>

namespace yade {

class DisplayParameters;
class OpenGLRenderer;

// The whole simulation.
class Scene : public Serializable {
    const unsigned int hostNameMax = 255;

public:
    ForceContainer forces;
    static const int nSpeedIter = 10;
    Eigen::Matrix<Real, nSpeedIter, 1> SpeedElements;
    shared_ptr<OpenGLRenderer> renderer;
    boost::posix_time::ptime prevTime;
    Real dt; // [s]
    long iter;
    bool subStepping;
    int subStep;
    Real time; // [s]
    Real speed;
    long stopAtIter;
    Real stopAtTime;
    bool isPeriodic;
    bool trackEnergy;
    bool doSort;
    bool runInternalConsistencyChecks;
    Body::id_t selectedBody;
    int subdomain;
    shared_ptr<Shape> subD;
    vector<string> tags; // "key=value"
    vector<shared_ptr<Engine>> engines;
    vector<shared_ptr<Engine>> _nextEngines;
    shared_ptr<BodyContainer> bodies;
    shared_ptr<InteractionContainer> interactions;
    shared_ptr<EnergyTracker> energy;
    vector<shared_ptr<Material>> materials;
    shared_ptr<Bound> bound;
    shared_ptr<Cell> cell;
    vector<shared_ptr<Serializable>> miscParams;
    vector<shared_ptr<DisplayParameters>> dispParams;

    Scene();
    YADE_ABI_STOCK(Scene)
    bool timeStepperPresent();
    bool timeStepperActive();
    bool timeStepperActivate(bool);
    shared_ptr<Engine> engineByName(const string& className);
    int addMaterial(shared_ptr<Material> m)
    {
        materials.push_back(m);
        return m->id = int(materials.size()) - 1;
    }
};
YADE_ABI_STOCK_END(Scene, 752)

} // namespace yade
