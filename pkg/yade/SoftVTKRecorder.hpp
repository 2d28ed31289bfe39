// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

class SoftVTKRecorder : public PeriodicEngine {
public:
    void action() override;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftVTKRecorder,
            PeriodicEngine,
            "Writes the scene for ParaView and other programs that use VTK, as :yref:`VTKRecorder` does for spheres: at every run one .vtp file a "
            "block, and fileName + 'scene.pvd', which lists them with their times and is what to open. That file is whole at every moment; it goes on "
            "where a simulation that was saved is loaded again, and begins anew with another simulation. initRun is True. Stands behind "
            ":yref:`SoftIntegrator`, as in softEngines(more=[...]). Numbers are of single precision, in SI units. Needs the Debian package python3-vtk9, "
            "which is loaded when the engine first runs. doc/paraview.md lists all arrays.",
            ((string,
              fileName,
              "",
              ,
              "What names of files begin with; grains.100.vtp and the like follow. May hold folders, which are made where they are missing."))(
                    (vector<string>,
                     recorders,
                     vector<string>(1, "all"),
                     ,
                     "Blocks and fields to write. Blocks: 'grains' (outlines of soft grains), 'points' (their material points), 'contacts' (points that bear a "
                     "force), 'rigid' (walls, boxes, discs, facets). Fields, on the blocks that have them: 'id' ('id1', 'id2' of contacts), 'materialId', 'mask', 'displacement' [m], "
                     "'velocity' [m/s], 'angVel' [rad/s], 'J' [-], 'stretches' [-], 'stress', 'pressure', 'vonMises' [Pa], 'plasticStrain' [-], "
                     "'normal', 'force', 'normalForce' [N/m], 'torque' [N]. 'all': all blocks with all fields."))(
                    (bool, ascii, false, , "Numbers as text that a person can read."))(
                    (bool, compress, false, , "Smaller files, by zlib; takes longer."))(
                    (int, mask, 0, , "Bodies whose mask shares a bit with this are written, and contacts of two such; 0: all [-].")),
            initRun = true);
};
REGISTER_SERIALIZABLE(SoftVTKRecorder);

} // namespace yade
