// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Shape.hpp>

#include "grid/discretisation.hpp"

#include <memory>

namespace yade {

class SoftGrain : public Shape {
public:
    /// The discretisation, shared with all grains of the same form and resolution. Throws softgrain::UserError.
    const std::shared_ptr<const softgrain::Discretisation<2>>& mesh()
    {
        if (!mesh_) discretise();
        return mesh_;
    }
    /// Radius of the disc of the same area [m].
    Real equivalentRadius()
    {
        mesh();
        return equivalentRadius_;
    }
    /// The formulation is the updated-Lagrangian one.
    bool updated()
    {
        mesh();
        return updated_;
    }
    int pointCount() { return mesh()->point_count(); }
    int surfaceCount() { return mesh()->surface_count(); }
    Real area();
    Real cellWidth() { return mesh()->cell_width * equivalentRadius(); }
    void postLoad(SoftGrain&);

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftGrain,
            Shape,
            "Soft grain in the xy-plane: a disc, or a simple closed polygon. Its continuum is discretised by material points on a background "
            "grid of quadratic B-splines, one grid a grain, fixed in the undeformed grain (total-Lagrangian MPM) or laid anew in every step "
            "(updated-Lagrangian MPM, see formulation). Belongs to a body with "
            ":yref:`SoftState` and a :yref:`SoftMat`; :yref:`softDisc` and :yref:`softPolygon` make one.",
            ((Real, radius, NaN, Attr::triggerPostLoad, "Radius of the undeformed disc [m]; not used with vertices."))(
                    (vector<Vector3r>,
                     vertices,
                     ,
                     Attr::triggerPostLoad,
                     "Corners of an undeformed polygon, in order, relative to its centroid, in the body's frame [m]; empty: a disc."))(
                    (int, points, 276, Attr::triggerPostLoad, "Number of material points wished for; pointCount says how many the grid gives [-]."))(
                    (Real, surfaceSpacing, 1.0, Attr::triggerPostLoad, "Largest distance between surface points [width of a grid cell]."))(
                    (Real,
                     nodeThreshold,
                     0,
                     Attr::triggerPostLoad,
                     "Grid nodes lighter than this follow their neighbours [mass of the heaviest node]; 0: 3 / points, but 0.03 to 0.05."))(
                    (std::string,
                     formulation,
                     "total",
                     Attr::triggerPostLoad,
                     "'total': Lagrangian in the undeformed grain; 'updated': in the grain as its grid was last laid, which is done anew once cells are out of shape."))(
                    (bool,
                     meanDilatation,
                     true,
                     Attr::triggerPostLoad,
                     "Whether the points of a cell share one volume change, which cures the locking of nearly incompressible grains; false is "
                     "for comparisons."))(
                    (Vector2r, gridOffset, Vector2r::Zero(), Attr::triggerPostLoad, "Shift of the grid under the grain [width of a grid cell].")),
            createIndex(),
            .def("pointCount", &SoftGrain::pointCount, "Number of material points [-].")
                    .def("surfaceCount", &SoftGrain::surfaceCount, "Number of surface points [-].")
                    .def("cellWidth", &SoftGrain::cellWidth, "Width of a grid cell [m].")
                    .def("area", &SoftGrain::area, "Area of the undeformed grain [m²]."));
    REGISTER_CLASS_INDEX(SoftGrain, Shape);

private:
    void discretise();
    std::shared_ptr<const softgrain::Discretisation<2>> mesh_;
    Real equivalentRadius_ = NaN;
    bool updated_ = false;
};
REGISTER_SERIALIZABLE(SoftGrain);

} // namespace yade
