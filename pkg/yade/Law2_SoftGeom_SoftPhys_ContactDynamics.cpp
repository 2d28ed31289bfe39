// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law2_SoftGeom_SoftPhys_ContactDynamics.hpp"

#include <iterator>

namespace yade {

YADE_PLUGIN((Law2_SoftGeom_SoftPhys_ContactDynamics));

bool Law2_SoftGeom_SoftPhys_ContactDynamics::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction)
{
    static const softgrain::SignoriniCoulomb<2> law;
    if (!static_cast<SoftGeom&>(*geom).near()) return false;
    static_cast<SoftPhys&>(*phys).law = &law;
    Handed& mine = byThread_[omp_get_thread_num()];
    if (mine.step != scene->iter) mine.pairs.clear();
    mine.step = scene->iter;
    mine.pairs.push_back({ interaction->id1, interaction->id2, boost::static_pointer_cast<SoftGeom>(geom),
                           boost::static_pointer_cast<SoftPhys>(phys) });
    return true;
}

void Law2_SoftGeom_SoftPhys_ContactDynamics::handOver(long step, std::vector<TouchingPair>& pairs)
{
    for (Handed& handed : byThread_) {
        if (handed.step != step) continue;
        std::move(handed.pairs.begin(), handed.pairs.end(), std::back_inserter(pairs));
        handed.pairs.clear();
    }
}

} // namespace yade
