// SPDX-License-Identifier: GPL-2.0-or-later
// How contact forces change with the surfaces, against differences of the forces themselves.
#include "contact/support.hpp"
#include "solver/contact_turning.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// A small bumpy body, points of which stand near a larger one.
struct Pair {
    Surface<2> point, face;
    std::vector<BarrierContact<2>> contacts;

    explicit Pair(Random& random)
    {
        face = surface_of(polar(24, [](double angle) { return 1 + 0.05 * std::cos(3 * angle); }));
        std::vector<Vec<2>> places;
        for (int k = 0; k < 8; ++k)
            places.push_back((1.02 + random.uniform(-0.05, 0.05)) * random.unit<2>());
        point = surface_of(places);
        for (int k = 0; k < 8; ++k) {
            BarrierContact<2> contact {};
            contact.body = 0;
            contact.other = 1;
            contact.point = k;
            contact.face = nearest_segment(face, places[size_t(k)]);
            contact.force = random.uniform(0.1, 1);
            contacts.push_back(contact);
        }
        locate();
    }
    void locate()
    {
        for (auto& contact : contacts)
            contact.locate(point, face);
    }
    void move(const SurfaceField& way, double share)
    {
        for (size_t i = 0; i < way[0].size(); ++i)
            point.position[i] += share * way[0][i];
        for (size_t i = 0; i < way[1].size(); ++i)
            face.position[i] += share * way[1][i];
        locate();
    }
    SurfaceField nothing() const
    {
        return { std::vector<double>(point.position.size(), 0), std::vector<double>(face.position.size(), 0) };
    }
    SurfaceField forces() const
    {
        SurfaceField field = nothing();
        for (const auto& contact : contacts)
            add_force<2>(contact, contact.force * contact.normal, field);
        return field;
    }
};

TEST(ContactTurning, IsTheChangeOfTheForces)
{
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        Pair pair(random);
        SurfaceField way = pair.nothing(), found = pair.nothing();
        for (auto& values : way)
            for (double& value : values)
                value = random.uniform(-1, 1);
        ContactTurning<2> turning;
        turning.look(pair.contacts, { &pair.point, &pair.face });
        turning.add(pair.contacts, way, found);
        const double h = 1e-5;
        pair.move(way, h);
        const SurfaceField after = pair.forces();
        pair.move(way, -2 * h);
        const SurfaceField before = pair.forces();
        double error = 0, size = 0;
        for (size_t b = 0; b < 2; ++b)
            for (size_t i = 0; i < way[b].size(); ++i) {
                const double expected = (after[b][i] - before[b][i]) / (2 * h);
                error += std::pow(found[b][i] - expected, 2);
                size += expected * expected;
            }
        EXPECT_LE(std::sqrt(error), 1e-5 * std::sqrt(size)); // h^2 and feet found to 1e-5 squared, over h
    }
}

} // namespace
