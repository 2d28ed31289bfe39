// SPDX-License-Identifier: GPL-2.0-or-later
#include "Gl1_SoftGrain.hpp"

#include "GrainPictures.hpp"

#include <GL/gl.h>
#include <GL/glu.h>

#include <deque>
#include <iostream>
#include <numeric>

namespace yade {

YADE_PLUGIN((Gl1_SoftGrain));

string Gl1_SoftGrain::field;
Vector2r Gl1_SoftGrain::range, Gl1_SoftGrain::shownRange;
bool Gl1_SoftGrain::outline, Gl1_SoftGrain::points;

namespace {
    using Place = GrainPicture::Place;
    const Vector3r line(0.08, 0.08, 0.08), dots(0, 0, 0);
    constexpr float lineWidth = 1.5, dotSize = 2; // [pixels]

    /// The colours of viridis (Nathaniel Smith and Stefan van der Walt 2015) along a range of values.
    Vector3r coloured(Real value, const Vector2r& range)
    {
        static const Vector3r steps[] { { 0.267, 0.005, 0.329 }, { 0.278, 0.176, 0.481 }, { 0.230, 0.318, 0.546 },
                                        { 0.173, 0.448, 0.558 }, { 0.128, 0.567, 0.551 }, { 0.158, 0.684, 0.502 },
                                        { 0.369, 0.789, 0.383 }, { 0.678, 0.864, 0.190 }, { 0.993, 0.906, 0.144 } };
        constexpr int last = sizeof(steps) / sizeof(*steps) - 1;
        const Real place = (value - range[0]) / (range[1] - range[0]);
        if (!(place > 0)) return steps[0];
        const int from = std::min(int(std::min(place, 1.0) * last), last - 1);
        const Real share = std::min(place, 1.0) * last - from;
        return (1 - share) * steps[from] + share * steps[from + 1];
    }

    /// What the renderer adds to the light of a selected body; drawing without lights, colours take it over.
    Real highlight()
    {
        float emission[4];
        glGetMaterialfv(GL_FRONT, GL_EMISSION, emission);
        constexpr float usual = 0.2f;
        return emission[0] - usual;
    }

    struct Brush {
        const Real added = highlight();
        void colour(const Vector3r& colour) const
        {
            const Vector3r shown = (colour.array() + added).max(0).min(1);
            glColor3dv(shown.data());
        }
        static void place(const Place& place) { glVertex2d(place[0], place[1]); }
    };

    /// A polygon that may be concave, by the triangulation of GLU.
    void fill(const std::vector<Place>& corners)
    {
        static GLUtesselator* const triangles = [] {
            using Call = void (*)();
            GLUtesselator* made = gluNewTess();
            gluTessCallback(made, GLU_TESS_BEGIN, reinterpret_cast<Call>(glBegin));
            gluTessCallback(made, GLU_TESS_VERTEX, reinterpret_cast<Call>(glVertex3dv));
            gluTessCallback(made, GLU_TESS_END, reinterpret_cast<Call>(glEnd));
            return made;
        }();
        std::deque<Vector3r> kept; // until the end, at their places
        gluTessBeginPolygon(triangles, nullptr);
        gluTessBeginContour(triangles);
        for (const Place& corner : corners) {
            kept.emplace_back(corner[0], corner[1], 0);
            gluTessVertex(triangles, kept.back().data(), kept.back().data());
        }
        gluTessEndContour(triangles);
        gluTessEndPolygon(triangles);
    }

    /// Tiles, each so many times its size.
    void drawTiles(const GrainPicture& picture, const Vector2r& range, const Brush& brush, Real size)
    {
        glBegin(GL_QUADS);
        for (size_t p = 0; p < picture.tiles.size(); ++p) {
            brush.colour(coloured(picture.values[p], range));
            for (const Place& corner : picture.tiles[p])
                Brush::place(picture.points[p] + size * (corner - picture.points[p]));
        }
        glEnd();
    }

    /// Tiles, cut off at the outline, which was filled with marks in the stencil; the marks are taken away.
    void drawField(const GrainPicture& picture, const Vector2r& range, const Brush& brush)
    {
        glStencilFunc(GL_EQUAL, 1, 1);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        glPolygonOffset(1.5, 1.5);
        drawTiles(picture, range, brush, 1.5); // below, where tiles leave gaps
        glPolygonOffset(1, 1);
        drawTiles(picture, range, brush, 1);
        glColorMask(false, false, false, false);
        glStencilOp(GL_ZERO, GL_ZERO, GL_ZERO);
        fill(picture.outline);
        glColorMask(true, true, true, true);
    }

    void drawInside(const GrainPicture& picture, const Vector3r& ofShape, const Vector2r& range, const Brush& brush)
    {
        glEnable(GL_POLYGON_OFFSET_FILL); // lines and dots lie on the tiles, tiles on the rest
        glPolygonOffset(2, 2);
        if (picture.values.empty()) {
            brush.colour(ofShape);
            return fill(picture.outline);
        }
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_ALWAYS, 1, 1);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
        const Real sum = std::accumulate(picture.values.begin(), picture.values.end(), 0.0);
        brush.colour(coloured(sum / Real(picture.values.size()), range));
        fill(picture.outline);
        drawField(picture, range, brush);
        glDisable(GL_STENCIL_TEST);
    }

    void draw(GLenum kind, const std::vector<Place>& places)
    {
        glBegin(kind);
        for (const Place& place : places)
            Brush::place(place);
        glEnd();
    }

    /// Says once of each bad field why; an exception here would end the process.
    void objectOnce(const string& field)
    {
        static string last;
        if (field == std::exchange(last, field)) return;
        const string objection = GrainPictures::objection(field);
        if (!objection.empty()) std::cerr << "Gl1_SoftGrain: " << objection << std::endl;
    }
} // namespace

void Gl1_SoftGrain::go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&)
{
    static GrainPictures pictures;
    objectOnce(field);
    const GrainPicture* picture = pictures.of(*state, *scene, field);
    if (!picture) return;
    shownRange = range[0] != range[1] ? range : pictures.range();

    glPushAttrib(GL_ENABLE_BIT | GL_CURRENT_BIT | GL_LINE_BIT | GL_POINT_BIT | GL_POLYGON_BIT | GL_STENCIL_BUFFER_BIT
                 | GL_COLOR_BUFFER_BIT);
    glDisable(GL_LIGHTING); // lamps in the plane of the grains leave them dark
    glDisable(GL_CULL_FACE);
    const Brush brush;
    if (!wire) drawInside(*picture, shape->color, shownRange, brush);
    if (outline || wire) {
        glLineWidth(lineWidth);
        brush.colour(wire ? shape->color : line);
        draw(GL_LINE_LOOP, picture->outline);
    }
    if (points) {
        glPointSize(dotSize);
        brush.colour(wire ? shape->color : dots);
        draw(GL_POINTS, picture->points);
    }
    glPopAttrib();
}

} // namespace yade
