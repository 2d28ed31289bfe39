// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftGeom.hpp"

namespace yade {

YADE_PLUGIN((SoftGeom));

void SoftGeom::preSave(SoftGeom&)
{
    savedPoints.clear();
    savedForces.clear();
    savedCreep.clear();
    for (const auto& contact : points()) {
        savedPoints.insert(savedPoints.end(), { contact.point, int(contact.on_second) });
        savedForces.push_back(contact.force);
        savedCreep.push_back(contact.creep);
    }
    savedNear.clear();
    savedClear.clear();
    for (int list : { 0, 1 })
        for (const auto& candidate : pair.memory.near[list]) {
            savedNear.insert(savedNear.end(), { list, candidate.point, candidate.face });
            savedClear.push_back(candidate.clear_until);
        }
    savedValid = pair.memory.valid_until;
    savedTravel = rigid.travel;
}

void SoftGeom::postLoad(SoftGeom&)
{
    pair.memory = {};
    for (size_t i = 0; i < savedClear.size() && 3 * i + 2 < savedNear.size(); ++i)
        pair.memory.near[savedNear[3 * i] == 0 ? 0 : 1].push_back(
            { savedNear[3 * i + 1], savedNear[3 * i + 2], savedClear[i] });
    pair.memory.valid_until = savedValid;
    rigid.travel = savedTravel;
    // which of the two lists is used shows at the next update; both start from the saved forces
    std::vector<softgrain::ContactPoint<2>> saved(savedForces.size());
    for (size_t i = 0; i < saved.size() && 2 * i + 1 < savedPoints.size(); ++i) {
        saved[i].point = savedPoints[2 * i];
        saved[i].on_second = savedPoints[2 * i + 1] != 0;
        saved[i].force = savedForces[i];
        saved[i].creep = i < savedCreep.size() ? savedCreep[i] : 0;
    }
    pair.points = plane.points = saved;
}

} // namespace yade
