// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Shape.hpp>

namespace yade {

// Triangle; vertices in the body's frame [m]. The rest follows from them in postLoad.
class Facet : public Shape {
public:
    Vector3r ne[3]; // outward normals of the edges, in the plane
    Real icr;       // radius of the inscribed circle
    Real vl[3];     // lengths of the vertices' vectors
    Vector3r vu[3]; // and their directions
    vector<Vector3r> vertices;
    Vector3r normal;
    Real area;

    Facet();
    YADE_ABI_STOCK(Facet)
    YADE_ABI_STOCK_INDEX(Facet)
    void postLoad(Facet&);
    void setVertices(const Vector3r&, const Vector3r&, const Vector3r&);
};
YADE_ABI_STOCK_END(Facet, 328)

} // namespace yade
