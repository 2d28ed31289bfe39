# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes soft grains and the engines that move them. Lengths in m, all bodies in the xy-plane; materials as in YADE:
the number or label of a material in O.materials, or the material itself."""
import math

import numpy
import yade.wrapper as wrapper
from yade import O
from yade.minieigenHP import Quaternion, Vector3

from . import cloud, measures, presets
from .checks import InputError, in_plane, not_negative, number, position, positive, whole

POINTS, SAFETY, TOLERANCE = 276, 0.8, 1e-3      # unless given or chosen by an accuracy
LEAST_POINTS = 16
MOST_DISCS = 1000000    # of a cloud
TOUCHING = 1e-9         # distance below which a corner lies on another edge [extent of the polygon]
VERLET = 0.05       # distance that grains may move until the collider sorts again [radius of the smallest]
AHEAD = 0.1         # gap at which rigid spheres become pairs [sum of their radii]


def softDisc(center, radius, material=-1, points=None, angle=0.0, color=None, velocity=(0, 0, 0), spin=0.0, accuracy=None,
             **shape):
    """Body of one soft disc.

    center    centre [m]
    radius    radius of the undeformed disc [m]
    points    number of material points wished for (the grid decides the exact number); None: POINTS, or by accuracy
    angle     rotation of the grid of material points about the centre [rad]
    velocity  initial velocity [m/s]; spin: initial angular velocity about z [rad/s]
    accuracy  relative error in stress to expect, such as 0.01, or 'draft', 'standard', 'fine': chooses points and
              surfaceSpacing, which may not be given too (presets.py says how; give it to softEngines as well)
    shape     further attributes of SoftGrain
    Raises InputError, one sentence, on a value that makes no sense.
    """
    center = position("softDisc: center", center)
    radius = positive(f"softDisc at {_shown(center)}: radius", radius, "m")
    return _body(f"softDisc at {_shown(center)}", center, dict(shape, radius=radius), material, points, angle, color,
                 velocity, spin, accuracy)


def softPolygon(vertices, material=-1, points=None, color=None, velocity=(0, 0, 0), spin=0.0, accuracy=None, **shape):
    """Body of one soft polygon.

    vertices  corners in order, in world coordinates [m]; the edges must not cross; convex or not
    The other arguments are those of softDisc. The errors behind `accuracy` were measured with discs.
    Raises InputError, one sentence, on a value that makes no sense.
    """
    try:
        count = len(vertices)
    except TypeError:
        raise InputError(f"softPolygon: vertices is {vertices!r}: give a list of at least three corners.") from None
    if count < 3:
        raise InputError(f"softPolygon has {count} vertices: give at least three corners.")
    corners = [position(f"softPolygon: vertex {i}", vertex) for i, vertex in enumerate(vertices)]
    for i, corner in enumerate(corners):
        if corner[2] != corners[0][2]:
            raise InputError(f"softPolygon: z of vertex {i} is {corner[2]:g} m, that of vertex 0 is {corners[0][2]:g} m: "
                             "give corners that lie in one xy-plane.")
    plane = numpy.array(corners)[:, :2]
    area, centroid = _area_and_centroid(plane)
    if not abs(area) > 1e-9 * numpy.max(numpy.ptp(plane, axis=0))**2:
        raise InputError(f"softPolygon with {count} vertices has no area: give corners that do not lie on a line.")
    meeting = _meeting_edges(plane)
    if meeting:
        raise InputError("softPolygon: edges {} and {} (from the vertices of these numbers) cross or touch: give the "
                         "corners in order along the boundary, each once.".format(*meeting))
    center = (centroid[0], centroid[1], corners[0][2])
    relative = [Vector3(x - centroid[0], y - centroid[1], 0) for x, y in plane]
    return _body(f"softPolygon at {_shown(center)}", center, dict(shape, vertices=relative), material, points, 0.0,
                 color, velocity, spin, accuracy)


def rigidDisc(center, radius, material=-1, color=None, velocity=(0, 0, 0), spin=0.0):
    """Body of one rigid disc that moves freely in the xy-plane: a YADE Sphere with the mass [kg/m] and the moment of inertia
    [kg m] of a disc, per metre of thickness as those of soft grains (YADE's sphere() has those of a ball).

    center    centre [m], in the plane of the soft grains
    radius    radius [m]
    material  a FrictMat, that of YADE by default
    velocity  initial velocity [m/s]; spin: initial angular velocity about z [rad/s]
    Raises InputError, one sentence, on a value that makes no sense.
    """
    from yade.utils import sphere

    center = position("rigidDisc: center", center)
    name = f"rigidDisc at {_shown(center)}"
    radius, spin = positive(f"{name}: radius", radius, "m"), number(f"{name}: spin", spin, "rad/s")
    velocity = in_plane(f"{name}: velocity", velocity, "m/s")
    if material != -1 or len(O.materials):      # else YADE's default material
        material = _material(name, material, wrapper.FrictMat, "FrictMat")
    body = sphere(center, radius, material=material, color=None if color is None else _colour(name, color))
    state = body.state
    state.mass = math.pi * radius**2 * body.material.density
    state.inertia = Vector3(1, 1, 1) * (state.mass * radius**2 / 2)
    state.vel, state.angVel, state.blockedDOFs = Vector3(*velocity), Vector3(0, 0, spin), "zXY"
    return body


def softCloud(width, count, diameters=(1.4e-3, 2.4e-3), solidFraction=0.65, material=-1, points=None, seed=1, **shape):
    """Loose cloud of soft discs that do not touch, in the box [0, width] x [0, height].

    width          of the box [m]
    count          number of discs
    diameters      smallest and largest diameter [m]; those of the grains are uniform between them
    solidFraction  area of all grains / (width height); up to about 0.75
    seed           whole number: sizes, places and grid orientations follow from it
    shape          accuracy, and further attributes of SoftGrain, as of softDisc
    Returns the list of bodies and the height of the box [m].
    Raises InputError, one sentence, on a value that makes no sense or when there is no room.
    """
    radii, places, angles, height = discCloud(width, count, diameters, solidFraction, seed)
    bodies = [softDisc(place, radius, material, points, angle, **shape)
              for place, radius, angle in zip(places, radii, angles)]
    return bodies, height


def discCloud(width, count, diameters, solidFraction, seed):
    """The geometry of softCloud, also for rigid discs: radii [m], centres [m] (count, 2), angles [rad] and the
    height of the box [m]. Raises InputError."""
    width = positive("softCloud: width", width, "m")
    count = whole("softCloud: count", count, 1, MOST_DISCS)
    seed = whole("softCloud: seed", seed, 0)
    fraction = positive("softCloud: solidFraction", solidFraction)
    try:
        smallest, largest = diameters
    except (TypeError, ValueError):
        raise InputError(f"softCloud: diameters is {diameters!r}: give the smallest and the largest, in m.") from None
    smallest = positive("softCloud: smallest diameter", smallest, "m")
    largest = positive("softCloud: largest diameter", largest, "m")
    if smallest > largest:
        raise InputError(f"softCloud: diameters are ({smallest:g}, {largest:g}) m: give the smaller one first.")
    generator = numpy.random.default_rng(seed)
    radii = cloud.random_radii(count, (smallest, largest), generator)
    height = math.pi * float(numpy.sum(radii**2)) / (width * fraction)
    places = cloud.scatter(width, height, radii, generator)
    angles = generator.uniform(0, 2 * math.pi, count)
    return radii.tolist(), places.tolist(), angles.tolist(), height


def widthOfSquareCloud(count, diameters, solidFraction):
    """Width [m] that makes the box of softCloud about square; count, diameters [m] and solidFraction are those of it."""
    a, b = diameters
    mean_area = math.pi / 12 * (a * a + a * b + b * b)
    return math.sqrt(count * mean_area / solidFraction)


def softBox(width, height, material=-1):
    """The four YADE walls around [0, width] x [0, height] [m], all with zero velocity: bodies in the order left, right,
    bottom, top. The material is a FrictMat, that of YADE by default. Raises InputError, one sentence, on a value that makes
    no sense."""
    from yade.utils import wall

    width, height = positive("softBox: width", width, "m"), positive("softBox: height", height, "m")
    if material != -1 or len(O.materials):      # else YADE's default material
        _material("softBox", material, wrapper.FrictMat, "FrictMat")
    return [wall(0.0, axis=0, sense=1, material=material), wall(width, axis=0, sense=-1, material=material),
            wall(0.0, axis=1, sense=1, material=material), wall(height, axis=1, sense=-1, material=material)]


def softEngines(gravity=(0, 0, 0), dt=None, safety=None, tolerance=None, maxSweeps=1000, verletDist=None,
                friction=None, wallFriction=None, more=(), accuracy=None, integrator="explicit", theta=1.0,
                quasistatic=False, functors=(), restitution=None, adhesion=None, reversible=True, damping=0.0,
                rigidBelow=0.0):
    """The engine list of a scene with soft grains: O.engines = softEngines(). Append the bodies before.

    gravity       [m/s²]
    dt            time step [s]; None: chosen, and adapted, by a SoftTimeStepper (explicit; implicit ones need it)
    safety        time step of the SoftTimeStepper [stable limit]; None: SAFETY, or by accuracy
    tolerance     of the contact solver [-]; None: TOLERANCE, or by accuracy; maxSweeps: most sweeps of it in a step
    verletDist    of the InsertionSortCollider [m]; None: VERLET times the radius of the smallest soft grain, or else sphere
    friction      Coulomb's coefficient between grains [-]; None: from the materials' frictionAngle
    wallFriction  the same between grains and other bodies
    restitution   coefficient of Newton's law of impact, normal or (normal, tangential) [-]; None: 0 (explicit alone; what it
                  means for soft grains: doc/theory.md, section 5); of rigid bodies among each other too, by rigidContacts()
    adhesion      (tension [Pa], range [m]): surfaces nearer than the range attract each other; None: not (explicit alone); of
                  rigid bodies among each other too, by rigidContacts(): as a whole, up to a range of a tenth of the smaller radius
    reversible    of adhesion; False: surfaces that have come apart attract each other no more
                  Each number of restitution and adhesion may be a MatchMaker of materials, that says it pair by pair
    damping       numerical, of the grains, for relaxation: see SoftIntegrator.damping (explicit alone)
    rigidBelow    grains that nothing is near to move as rigid bodies once stresses are below this share of their shear modulus:
                  see SoftIntegrator.rigidBelow (explicit alone)
    more          engines to append (recorders, PyRunners)
    accuracy      as of softDisc: chooses safety and tolerance, which may not be given too, nor dt of explicit steps
    functors      of rigid bodies among each other: rigidContacts(), or Ig2, Ip2 and Law2 of YADE's laws, which the time step has
                  to suit too
    integrator    "explicit" or "implicit"; theta, quasistatic: see SoftImplicitIntegrator
    Raises InputError, one sentence, on a value that makes no sense.
    """
    if integrator not in ("explicit", "implicit"):
        raise InputError(f"softEngines: integrator is {integrator!r}: give 'explicit' or 'implicit'.")
    implicit = integrator == "implicit"
    if implicit and dt is None:
        raise InputError("softEngines: the implicit integrator has no time step of its own: give dt.")
    if quasistatic and not implicit:
        raise InputError("softEngines: quasistatic=True has no meaning for the explicit integrator: give "
                         "integrator='implicit'.")
    theta = positive("softEngines: theta", theta)
    if not 0.5 <= theta <= 1:
        raise InputError(f"softEngines: theta is {theta:g}: give 0.5 to 1.")
    effects = {**_restitution(restitution), **_adhesion(adhesion, reversible)}
    of_steps = {"damping": _below_one("damping", damping, 0.2), "rigidBelow": _below_one("rigidBelow", rigidBelow, 1e-3)}
    if implicit:
        for name, value in {"restitution": restitution is not None, "adhesion": adhesion is not None, **of_steps}.items():
            if value:
                raise InputError(f"softEngines: {name} is not known to implicit steps: leave it out, or give "
                                 "integrator='explicit'.")
    given = {"dt": None if implicit else dt, "safety": safety, "tolerance": tolerance}
    presets.refuse_both("softEngines", accuracy, [name for name, value in given.items() if value is not None])
    preset = presets.settings("softEngines", accuracy) if accuracy is not None else {}
    safety = preset.get("safety", SAFETY) if safety is None else safety
    tolerance = preset.get("tolerance", TOLERANCE) if tolerance is None else tolerance
    gravity = in_plane("softEngines: gravity", gravity, "m/s²")
    tolerance = positive("softEngines: tolerance", tolerance)
    safety = positive("softEngines: safety", safety)
    if safety >= 1:
        raise InputError(f"softEngines: safety is {safety:g}: give less than 1; 0.8 is sound.")
    maxSweeps = whole("softEngines: maxSweeps", maxSweeps, 1)
    if dt is None:
        steppers = [wrapper.SoftTimeStepper(safety=safety)]
    else:
        O.dt = positive("softEngines: dt", dt, "s")
        steppers = []
    if verletDist is None:
        radii = ([math.sqrt(body.shape.area() / math.pi) for body in measures.softBodies()]
                 or [body.shape.radius for body in O.bodies if isinstance(body.shape, wrapper.Sphere)])
        verletDist = VERLET * min(radii, default=0.0)
    else:
        verletDist = not_negative("softEngines: verletDist", verletDist, "m")
    if isinstance(more, wrapper.Engine) or not isinstance(more, (list, tuple)):
        raise InputError(f"softEngines: more is a {type(more).__name__}: give a list of engines.")
    geometries, physics, laws = _sorted(functors)
    for functor in physics:
        if isinstance(functor, wrapper.Ip2_FrictMat_FrictMat_SoftPhys):
            functor.updateAttrs(effects)
    ahead = any(isinstance(law, wrapper.Law2_ScGeom_FrictPhys_ContactDynamics) for law in laws)
    if implicit:
        mover = wrapper.SoftImplicitIntegrator(gravity=Vector3(*gravity), tolerance=tolerance, theta=theta,
                                               quasistatic=bool(quasistatic))
    else:
        mover = wrapper.SoftIntegrator(gravity=Vector3(*gravity), tolerance=tolerance, maxSweeps=maxSweeps,
                                       **of_steps)
    return [
        wrapper.ForceResetter(),
        # with targetInterv the bound of a body at rest has no margin, and each one that starts to move costs a sort
        wrapper.InsertionSortCollider(
            [wrapper.Bo1_SoftGrain_Aabb(), wrapper.Bo1_Wall_Aabb(), wrapper.Bo1_Box_Aabb(), wrapper.Bo1_Facet_Aabb(),
             wrapper.Bo1_Sphere_Aabb(**({"aabbEnlargeFactor": 1 + AHEAD} if ahead else {}))], verletDist=verletDist, targetInterv=-1),
        *steppers,  # InteractionLoop looks ahead by the time step
        wrapper.InteractionLoop(
            [wrapper.Ig2_SoftGrain_SoftGrain_SoftGeom(), wrapper.Ig2_Wall_SoftGrain_SoftGeom(),
             wrapper.Ig2_Box_SoftGrain_SoftGeom(), wrapper.Ig2_Sphere_SoftGrain_SoftGeom(),
             wrapper.Ig2_Facet_SoftGrain_SoftGeom(), *geometries],
            [wrapper.Ip2_SoftMat_SoftMat_SoftPhys(**_friction("friction", friction), **effects),
             wrapper.Ip2_FrictMat_SoftMat_SoftPhys(**_friction("wallFriction", wallFriction), **effects), *physics],
            [wrapper.Law2_SoftGeom_SoftPhys_ContactDynamics(), *laws]),
        wrapper.NewtonIntegrator(damping=0, gravity=Vector3(*gravity)),
        mover,
        *more,
    ]


def _below_one(name, value, usual):
    """A share from 0 to less than 1, or InputError."""
    value = not_negative(f"softEngines: {name}", value)
    if value >= 1:
        raise InputError(f"softEngines: {name} is {value:g}: give less than 1; {usual:g} is usual.")
    return value


def rigidContacts(friction=None):
    """Functors for contacts of rigid bodies among each other by Contact Dynamics: softEngines(functors=rigidContacts()), with
    soft grains or without any (give softEngines a dt then). Spheres, as discs in the xy-plane, meet spheres, walls, boxes
    and facets; clumps of spheres count as bodies. Facets are found when they are touched, all others before. Restitution and adhesion
are those of softEngines.

    friction  Coulomb's coefficient [-]; None: from the materials' frictionAngle, the smaller of two, as YADE does
    Raises InputError, one sentence, on a value that makes no sense.
    """
    return [wrapper.Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1 + AHEAD),
            wrapper.Ig2_Wall_Sphere_ScGeomAhead(interactionDetectionFactor=1 + AHEAD),
            wrapper.Ig2_Box_Sphere_ScGeom(interactionDetectionFactor=1 + AHEAD), wrapper.Ig2_Facet_Sphere_ScGeom(),
            wrapper.Ip2_FrictMat_FrictMat_SoftPhys(**_friction("friction", friction, "rigidContacts")),
            wrapper.Law2_ScGeom_FrictPhys_ContactDynamics()]


def _friction(name, coefficient, function="softEngines"):
    """The attribute of an Ip2 functor that gives this coefficient whatever the materials say."""
    if coefficient is None:
        return {}
    angle = math.atan(not_negative(f"{function}: {name}", coefficient))
    return {"frictAngle": wrapper.MatchMaker(algo="val", val=angle)}


def _restitution(coefficients):
    """The attributes of an Ip2 functor for softEngines' restitution."""
    if coefficients is None:
        return {}
    both = coefficients if isinstance(coefficients, (list, tuple)) else (coefficients, 0.0)
    if len(both) != 2:
        raise InputError(f"softEngines: restitution has {len(both)} numbers: give that along the normal, or (normal, tangential).")
    names = "normal restitution", "tangential restitution"
    for name, value in zip(names, both):
        if not isinstance(value, wrapper.MatchMaker) and not_negative(f"softEngines: {name}", value) > 1:
            raise InputError(f"softEngines: {name} is {value:g}: give 0 to 1.")
    return dict(zip(("en", "et"), map(_matched, both)))


def _adhesion(adhesion, reversible):
    """The attributes of an Ip2 functor for softEngines' adhesion."""
    if adhesion is None:
        return {}
    if not isinstance(adhesion, (list, tuple)) or len(adhesion) != 2:
        raise InputError(f"softEngines: adhesion is {adhesion!r}: give (tension in Pa, range in m).")
    for name, value, unit in zip(("tension", "range"), adhesion, ("Pa", "m")):
        if not isinstance(value, wrapper.MatchMaker):
            positive(f"softEngines: {name} of adhesion", value, unit)
    tension, reach = map(_matched, adhesion)
    return {"adhesion": tension, "adhesionRange": reach, "adhesionReversible": bool(reversible)}


def _matched(value):
    """A MatchMaker that gives this number for all pairs, or the one that is given."""
    return value if isinstance(value, wrapper.MatchMaker) else wrapper.MatchMaker(algo="val", val=float(value))


def _sorted(functors):
    """The lists of Ig2, Ip2 and Law2 functors among these."""
    kinds = wrapper.IGeomFunctor, wrapper.IPhysFunctor, wrapper.LawFunctor
    if not isinstance(functors, (list, tuple)):
        raise InputError(f"softEngines: functors is a {type(functors).__name__}: give a list of Ig2, Ip2 and Law2 functors.")
    for functor in functors:
        if not isinstance(functor, kinds):
            raise InputError(f"softEngines: functors holds a {type(functor).__name__}: give Ig2, Ip2 and Law2 functors.")
    return [[functor for functor in functors if isinstance(functor, kind)] for kind in kinds]


def _body(name, center, shape, material, points, angle, color, velocity, spin, accuracy):
    """The body of the arguments of softDisc; `shape`: attributes of SoftGrain, `name`: of the grain in messages."""
    if accuracy is not None:
        given = ["points"] * (points is not None) + ["surfaceSpacing"] * ("surfaceSpacing" in shape)
        presets.refuse_both(name, accuracy, given)
        preset = presets.settings(name, accuracy)
        points, shape = preset["points"], dict(shape, surfaceSpacing=preset["surface_spacing"])
    elif points is None:
        points = POINTS
    points = whole(f"{name}: points", points, LEAST_POINTS)
    angle, spin = number(f"{name}: angle", angle, "rad"), number(f"{name}: spin", spin, "rad/s")
    velocity = in_plane(f"{name}: velocity", velocity, "m/s")
    body = wrapper.Body()
    body.shape = _shape(name, dict(shape, points=points))
    if color is not None:
        body.shape.color = _colour(name, color)
    body.material = _material(name, material, wrapper.SoftMat, "NeoHookeanMat or another SoftMat")
    state = wrapper.SoftState()
    state.pos = state.refPos = Vector3(*center)
    state.ori = state.refOri = Quaternion(Vector3(0, 0, 1), angle)
    state.vel, state.angVel = Vector3(*velocity), Vector3(0, 0, spin)
    body.state = state
    _set_mass(name, body)
    body.bounded, body.aspherical = True, False
    return body


def _set_mass(name, body):
    """Mass [kg/m] and moment of inertia [kg m] of the undeformed grain (that of the disc of the same area: the
    integrator replaces it by the exact one)."""
    try:
        area = body.shape.area()
    except (RuntimeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    body.state.mass = mass = area * body.material.density
    body.state.inertia = Vector3(1, 1, 1) * (mass * area / (2 * math.pi))


def _shape(name, attributes):
    """A SoftGrain, or InputError."""
    try:
        return wrapper.SoftGrain(**attributes)
    except (AttributeError, TypeError) as error:
        raise InputError(f"{name}: {error}") from None


def _colour(name, color):
    """Red, green and blue as YADE takes them, or InputError."""
    try:
        red, green, blue = (number(f"{name}: color", part) for part in color)
    except (TypeError, ValueError):
        raise InputError(f"{name}: color is {color!r}: give three numbers from 0 to 1.") from None
    return Vector3(red, green, blue)


def _material(name, material, kind, wanted):
    """The material itself, also for a number or label in O.materials; InputError when there is none or it is not of this
    kind. `wanted` says in messages which classes are."""
    if isinstance(material, (int, str)) and not isinstance(material, bool):
        try:
            material = O.materials[material]
        except (IndexError, KeyError, RuntimeError, ValueError):
            raise InputError(f"{name}: material {material!r} is not in O.materials: append a {wanted} first.") from None
    if not isinstance(material, kind):
        raise InputError(f"{name}: material is a {type(material).__name__}: give a {wanted}.")
    return material


def _area_and_centroid(plane):
    """Signed area [m²] and centroid [m] of a polygon, shape (corners, 2)."""
    origin = plane.mean(axis=0)
    here = plane - origin
    ahead = numpy.roll(here, -1, axis=0)
    cross = here[:, 0] * ahead[:, 1] - ahead[:, 0] * here[:, 1]
    area = cross.sum() / 2
    if area == 0:
        return 0.0, origin
    return area, origin + ((here + ahead) * cross[:, None]).sum(axis=0) / (6 * area)


def _meeting_edges(plane):
    """The numbers of two edges that cross or touch each other elsewhere than in the corner that neighbours share, or
    None. Edge i goes from corner i to the next one."""
    count, near = len(plane), TOUCHING * numpy.max(numpy.ptp(plane, axis=0))
    ends = numpy.roll(plane, -1, axis=0)
    for i in range(count):
        a, b = plane[i], ends[i]
        after, before = (i + 1) % count, (i - 1) % count
        # a corner given twice, or a boundary that turns back on itself
        if _distances(a, b, plane[before]) <= near:
            return before, i
        if _distances(a, b, ends[after]) <= near:
            return i, after
        others = numpy.arange(i + 2, count if i > 0 else count - 1)
        c, d = plane[others], ends[others]
        crossing = (_side(a, b, c) * _side(a, b, d) < 0) & (_side(c, d, a) * _side(c, d, b) < 0)
        gaps = numpy.minimum.reduce([_distances(a, b, c), _distances(a, b, d), _distances(c, d, a), _distances(c, d, b)])
        meeting = others[crossing | (gaps <= near)]
        if len(meeting):
            return i, int(meeting[0])
    return None


def _side(a, b, c):
    """Twice the area of the triangles a b c, shape (..., 2) each; its sign says on which side of a b point c lies."""
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])


def _distances(a, b, c):
    """Distances of the points c from the edges a b, shape (..., 2) each."""
    along = b - a
    length2 = numpy.sum(along**2, axis=-1)
    share = numpy.clip(numpy.sum(along * (c - a), axis=-1) / numpy.where(length2 > 0, length2, 1), 0, 1)
    return numpy.hypot(*numpy.moveaxis(a + share[..., None] * along - c, -1, 0))


def _shown(center):
    return f"({center[0]:g}, {center[1]:g})"
