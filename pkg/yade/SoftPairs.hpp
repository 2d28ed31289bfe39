// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "RigidPairs.hpp"
#include "SoftGeom.hpp"
#include "SoftPhys.hpp"
#include "SoftState.hpp"

#include "solver/contact_problem.hpp"

#include <core/Scene.hpp>

namespace yade {

/// A pair of bodies in touch, as the Law2 functor hands it to the integrator.
struct TouchingPair {
    Body::id_t id1, id2;
    shared_ptr<SoftGeom> geom;
    shared_ptr<SoftPhys> phys;
};

/// The soft grains of a scene, by ascending ids.
struct SoftBodies {
    std::vector<shared_ptr<Body>> bodies;
    std::vector<SoftState*> states;
    std::vector<int> place;             ///< of a body, by id; -1 for others
    std::vector<int> meetingThemselves; ///< places of those that may

    int of(Body::id_t id) const { return size_t(id) < place.size() ? place[id] : -1; }
};

/// The pairs in touch in a step, and the contact problem of all of them.
class SoftPairs {
public:
    explicit SoftPairs(const SoftBodies& soft)
        : soft_(soft)
    {
    }

    void clear()
    {
        problem = pulls = {};
        pairs_.clear();
        rigid.clear();
        free_.clear();
    }

    softgrain::ContactProblem<2> problem;
    RigidPairs rigid;                   ///< pairs without a soft grain
    softgrain::ContactProblem<2> pulls; ///< of adhesion: the same contacts, with impulses that are known
    Real deepest = 0;                   ///< penetration of a contact point [radius of the smaller grain]

    struct Pair : TouchingPair {
        SoftState* first; ///< null: a rigid body
        SoftState* second;
        const State* rigid;
        shared_ptr<Body> mover; ///< of the rigid body, if impulses move it
        int body1, body2;       ///< places in the contact problem; body1 -1: a plane that impulses do not move
        struct Sum {
            using Vec = softgrain::Vec<2>;
            Vec normal = Vec::Zero(), shear = Vec::Zero(); ///< forces on body id2 [N/m]
            Vec pull = Vec::Zero();                        ///< of adhesion on it, besides [N/m]
            Vec place = Vec::Zero();                       ///< of the contact points, weighted by normal forces [N]
            Real weight = 0, moment = 0;                   ///< sum of normal forces [N/m]; torque on the rigid body [N]
        } sum;
        /// Adds the force on a contact point to the sums, what is normal of it to `normal` among them.
        void count(const softgrain::Vec<2>& onPoint, const softgrain::Contact<2>& contact, const softgrain::Vec<2>& where,
                   softgrain::Vec<2>& normal);
        /// From body id1 to id2, mean over the contact points; 0 without force.
        Vector3r normal() const;
        /// Radius of the smaller grain.
        Real size() const { return first ? std::min(first->grain.radius, second->grain.radius) : second->grain.radius; }
        bool ofItself() const { return first == second; }
        /// The contact point is on body id2.
        bool onSecond(const softgrain::ContactPoint<2>& point) const { return geom->withPlane || point.on_second; }
        /// Fills in who meets whom where, of a softgrain::Contact or a softgrain::BarrierContact.
        template <class Contact> void describe(const softgrain::ContactPoint<2>& point, Contact& contact) const
        {
            contact.body = onSecond(point) ? body2 : body1;
            contact.other = onSecond(point) ? body1 : body2;
            contact.point = point.point;
            contact.face = point.face;
            contact.normal = point.normal;
            contact.friction = phys->tangensOfFrictionAngle;
        }
    };

    /// Takes the pairs, in any order, and the bodies of their problem; pairs that go on within a step keep their sums.
    void collect(const Scene& scene, std::vector<TouchingPair>&& touching, bool goOn = false);
    std::vector<Pair>& pairs() { return pairs_; }
    /// Steps are to renew the whole surfaces of the grains in pairs, and of no others.
    void wantSurfaces();
    /// Poses the problem of the contact points found at the start of a step. Shares of `recovery` of penetrations are taken back.
    /// NewtonIntegrator has taken a step of `moved`.
    void pose(const Scene& scene, double kick, Real recovery, Real moved);
    /// Impulses to the surfaces.
    void load();
    /// Adds the forces of a step of length dt, times its share of the time, to the pairs; start values of the next step.
    void add(double dt, double share);
    /// Forces of the pairs to the interactions and to the rigid bodies.
    void deliver(Scene& scene);
    /// Moves the free rigid bodies by a step of length dt, once the problem is solved.
    void moveFree(Scene& scene, Real dt) { free_.move(scene, dt); }
    /// Throws when bodies got past each other by `most` radii: at the contact points; anywhere, or a grain through itself.
    void refuseLeaksAtPoints(Real most) const;
    void refuseLeaks(Real most) const;
    /// Throws when grains that were just placed overlap: contact would throw them apart. A little, as in a dense packing, is let pass.
    void refuseOverlaps() const;
    /// Pairs of two bodies with a force: (id1, id2, point [m], normal from id1 to id2 [-], force on id2 [N/m]).
    boost::python::list withForce() const;
    /// All contact points of two bodies with a force, in rows: id1, id2, place [m] (2), normal from id1 to id2 (2), force on id2
    /// [N/m] (2). What adhesion pulls at a pair stands as one more.
    std::vector<Real> pointForces() const;

private:
    void take(const Scene& scene, TouchingPair&& touching);
    std::vector<double> pullsOf(const Pair& pair, double kick) const;
    void pull(Pair& pair, softgrain::Contact<2> contact, double impulse, double kick);
    void rebound(const Pair& pair, size_t first);
    void refuseLeak(const Pair& pair, Real depth, Real most) const;

    const SoftBodies& soft_;
    std::vector<Pair> pairs_;
    FreeBodies free_;
};

} // namespace yade
