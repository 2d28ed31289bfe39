# SPDX-License-Identifier: GPL-2.0-or-later
"""Are the declarations of pkg/abi those of the YADE that runs?

    SOFTGRAIN_ABI_PROBE=<folder of _abi_probe.so> yade -n -j1 -x tests/abi/abi_selftest.py

Every declared member is written by YADE and read through its declaration, and the reverse; virtual functions are
called through the declared tables; and the classes of tiny_classes.cpp take part in a running, saved and loaded scene.
"""
import os
import sys
import tempfile
import time
import traceback

import yade
from yade import O

sys.path.insert(0, os.environ.get("SOFTGRAIN_ABI_PROBE", os.path.dirname(os.path.abspath(sys.argv[0]))))
import _abi_probe as probe  # noqa: E402

from yade.wrapper import *  # noqa: E402,F403  (the classes of YADE and of the probe)

try:
    from yade.minieigenHP import Matrix3, Quaternion, Vector3
except ImportError:
    from minieigen import Matrix3, Quaternion, Vector3

passed, failed = 0, 0


def check(ok, what):
    global passed, failed
    if ok:
        passed += 1
    else:
        failed += 1
        print("FAILED:", what)


def close(a, b, tolerance=1e-12):
    return abs(a - b) <= tolerance * max(1, abs(a), abs(b))


# ---------------------------------------------------------------------------------------- members

# Values that a class's own postLoad would refuse or change are written without it (pySetAttr).
WITHOUT_POSTLOAD = {"Cell", "MatchMaker", "Facet", "Scene", "BoundDispatcher", "IGeomDispatcher", "IPhysDispatcher", "LawDispatcher"}
# Python shows these otherwise than they are stored.
NOT_AS_STORED = {("State", "blockedDOFs")}
# Hidden from Python, so that nothing can be read back.
HIDDEN = {("Interaction", "iterLastSeen"), ("Interaction", "linIx"), ("BodyContainer", "dirty"), ("BodyContainer", "checkedByCollider"),
          ("Scene", "runInternalConsistencyChecks"), ("Scene", "engines"), ("Scene", "_nextEngines"), ("Scene", "energy"),
          ("Scene", "materials"), ("Scene", "bound"), ("Scene", "cell"), ("Scene", "miscParams")}
SPECIAL = {("Scene", "miscParams"): lambda seed: [Sphere(radius=seed)]}


def value_of(cls, name, seed):
    special = SPECIAL.get((cls, name))
    return special(seed) if special else probe.distinct(cls, name, seed)


def test_member(cls, name, seed):
    as_stored = (cls, name) not in NOT_AS_STORED
    written = read = 0

    # YADE writes, the declaration reads.
    self, value = probe.created(cls), value_of(cls, name, seed)
    try:
        probe.assign(self, name, value)
        written += 1
        check(probe.holds(self, cls, name, value), f"{cls}.{name} read through its declaration, after pySetAttr")
    except AttributeError:
        pass  # a property, not an attribute
    if as_stored and cls not in WITHOUT_POSTLOAD and hasattr(self, name):
        value = value_of(cls, name, seed + 1)
        try:
            setattr(self, name, value)
            written += 1
            check(probe.holds(self, cls, name, value), f"{cls}.{name} read through its declaration, after assignment in Python")
        except AttributeError:
            pass  # read-only
    check(written > 0, f"{cls}.{name} could be written by YADE")

    # The declaration writes, YADE reads.
    value = value_of(cls, name, seed + 2)
    probe.write(self, cls, name, value)
    attributes = probe.dictionary(self)
    if name in attributes:
        read += 1
        check(probe.same(cls, name, attributes[name], value), f"{cls}.{name} in pyDict, after writing through its declaration")
    if as_stored and hasattr(self, name):
        read += 1
        check(probe.same(cls, name, getattr(self, name), value), f"{cls}.{name} in Python, after writing through its declaration")
    check((read == 0) == ((cls, name) in HIDDEN), f"{cls}.{name} could be read by YADE")


def test_members():
    for seed in (10, 11):  # both values of a truth value
        for cls in probe.classes():
            for name in probe.fields(cls):
                try:
                    test_member(cls, name, seed)
                except Exception as error:  # noqa: BLE001
                    check(False, f"{cls}.{name}: {type(error).__name__}: {error}")
                seed += 6


# ---------------------------------------------------------------------------------------- virtual functions


def test_answers():
    own = list(probe.tinyClasses)
    check(len(own) == 15, f"15 classes of the probe are registered, not {len(own)}")
    for cls in list(probe.classes()) + own:
        said = probe.answers(probe.created(cls))
        check(said["class"] == cls, f"{cls}: getClassName")
        if cls != "BodyContainer":  # known to Python as a Serializable only
            self = getattr(yade.wrapper, cls)()
            check(type(self).__mro__[1].__name__ == said["base"][0] and said["base"][1] == 1, f"{cls}: getBaseClassName, getBaseClassNumber")
            if hasattr(self, "dispIndex"):
                chain = self.dispHierarchy(False)
                check(chain[0] == self.dispIndex == said["index"], f"{cls}: getClassIndex")
                check(said["kin"] >= said["index"], f"{cls}: getMaxCurrentlyUsedClassIndexOfKin")
                check(said.get("baseIndex") == (chain[1] if len(chain) > 1 else None), f"{cls}: getBaseClassIndex")
    check(probe.answers(PeriodicEngine())["activated"] is False, "PeriodicEngine.isActivated")
    check(probe.answers(BoundDispatcher(activated=False))["activated"] is False, "BoundDispatcher.isActivated")
    for dispatcher, dim, functor in ((BoundDispatcher, 1, "Bound"), (IGeomDispatcher, 2, "IGeom"), (IPhysDispatcher, 2, "IPhys"), (LawDispatcher, 2, "Law")):
        check(probe.answers(dispatcher())["dispatch"] == (dim, functor + "Functor"), f"{dispatcher.__name__}: getDimension, getFunctorType")
    for functor, types in ((Bo1_Sphere_Aabb, ["Sphere"]), (Ig2_Sphere_Sphere_ScGeom, ["Sphere", "Sphere"]), (Bo1_TinyShape_Aabb, ["TinyShape"]),
                           (Ip2_FrictMat_FrictMat_FrictPhys, ["FrictMat", "FrictMat"]), (Law2_ScGeom_FrictPhys_CundallStrack, ["ScGeom", "FrictPhys"])):
        check(list(probe.functorTypes(functor())) == types == list(functor().bases), f"{functor.__name__}: getFunctorTypes")
    for material, state in ((FrictMat, "State"), (CpmMat, "CpmState"), (TinyMat, "TinyState")):
        check(probe.answers(material())["state"] == (state, True), f"{material.__name__}: newAssocState, stateTypeOk")


def test_static_attributes():
    """YADE's own and the probe's: all objects share them, the class shows them, and they begin as they are declared."""
    check((Gl1_TinyShape.slices, Gl1_TinyShape.fixed, tuple(Gl1_TinyShape.range)) == (12, "text", (3, 4)), "static attributes: initial values")
    Gl1_TinyShape.slices = 7
    Gl1_TinyShape().range = (5, 6)
    check(Gl1_TinyShape().slices == 7 and tuple(Gl1_TinyShape.range) == (5, 6), "static attributes: shared")
    check(Gl1_TinyShape(slices=8).dict()["slices"] == 8 == Gl1_TinyShape.slices, "static attributes: keywords and dict")
    check(all(text in cls.__doc__ for cls, text in ((Gl1_TinyShape, "ystaticattr:: Gl1_TinyShape.slices(=12)"),
                                                    (Gl1_Sphere, "ystaticattr:: Gl1_Sphere.quality(=1.0)"))),
          "static attributes: in the text of the class")
    try:
        Gl1_TinyShape.fixed = "other"
        check(False, "static attributes: read-only")
    except AttributeError:
        pass
    for functor, shape in ((Gl1_Sphere, "Sphere"), (Gl1_Facet, "Facet"), (Gl1_TinyShape, "TinyShape")):
        check(probe.renders(functor()) == shape and list(probe.functorTypes(functor())) == [shape], f"{functor.__name__}: renders, getFunctorTypes")
    check(O.isChildClassOf("Gl1_TinyShape", "GlShapeFunctor"), "the 3D view finds the probe's functor")


def test_objects():
    check(probe.stateLock(State()), "State: pos and ori lie in se3, updateMutex works")
    facet = Facet(vertices=[(0, 0, 0), (3, 0, 0), (0, 4, 0)])
    edge, inscribed, length, direction = probe.facet(facet)
    check((edge - Vector3(0, -1, 0)).norm() < 1e-12 and length == 4 and direction == Vector3(1, 0, 0), "Facet: ne, vl, vu")
    check(inscribed > 0 and close(facet.area, 6), "Facet: icr, area")
    for matcher in (MatchMaker(algo="val", val=5), MatchMaker(algo="harmAvg", matches=[(1, 2, 9)]), MatchMaker(algo="max")):
        for pair in ((1, 2), (2, 3)):
            check(probe.match(matcher, *pair, 3., 7.) == matcher(*pair, 3., 7.), f"MatchMaker {matcher.algo} of {pair}")

    shape = TinyShape(radius=2, points=[(1, 2, 3)], secret=8, fixed=6)
    check(shape.loads >= 1 and shape.hiddenSecret == 8 and shape.fixed == 6, "keyword construction, hidden and read-only attributes")
    loads = shape.loads
    shape.radius = 3
    check(shape.radius == 3 and shape.loads == loads + 1, "triggerPostLoad")
    shape.color[1] = shape.pair[1] = shape.matrix[0, 1] = .5
    check(shape.color[1] == shape.pair[1] == shape.matrix[0, 1] == .5, "vectors are shown by reference")
    check("secret" not in shape.dict() and shape.dict()["numbers"] == [], "dict()")
    doc = TinyShape.radius.__doc__
    check(all(part in doc for part in ("Radius [m]", ":ydefault:`NaN`", ":yattrtype:`Real`", ":yattrflags:`4`")), "docstring of an attribute")
    for broken in (lambda: TinyShape(nonsense=1), lambda: setattr(shape, "fixed", 1), lambda: TinyShape(1), lambda: TinyShape(radius="x")):
        try:
            broken()
            check(False, "an unknown, read-only, positional or unsuitable argument is refused")
        except (AttributeError, RuntimeError, TypeError):
            check(True, "")


# ---------------------------------------------------------------------------------------- a running scene

STIFFNESS, SPEED, DT = 1000., .5, 1e-4


def ball(x, y, speed, material):
    body = Body()
    body.shape, body.material, body.state = TinyShape(radius=1, color=(.1, .2, .3)), material, material.newAssocState()
    body.state.mass, body.state.inertia = 1, (1, 1, 1)
    body.state.pos, body.state.vel = (x, y, 0), (speed, 0, 0)
    return O.bodies.append(body)


def wall(x, material):
    body = Body()
    body.shape, body.material, body.state = Wall(axis=0), material, material.newAssocState()
    body.state.pos, body.dynamic = (x, 0, 0), False
    return O.bodies.append(body)


def build():
    """Two balls that meet, and two that meet a wall, of which one has a smaller, one a larger id than the wall."""
    O.reset()
    material = TinyMat(stiffness=STIFFNESS, label="tinyMat")
    O.materials.append(material)
    ids = [ball(-1.05, 0, SPEED, material), ball(1.05, 0, -SPEED, material), ball(9, 10, SPEED, material), wall(10.05, material),
           ball(11.1, 20, -SPEED, material)]
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_TinyShape_Aabb(), Bo1_Wall_Aabb()], verletDist=.05),
        InteractionLoop([Ig2_TinyShape_TinyShape_TinyGeom(), Ig2_Wall_TinyShape_TinyGeom()], [Ip2_TinyMat_TinyMat_TinyPhys()],
                        [Law2_TinyGeom_TinyPhys_Spring()]),
        TinyEngine(label="tinyEngine"),
        TinyPeriodic(iterPeriod=10, initRun=True, label="tinyPeriodic"),
        TinyPartial(ids=[ids[3]], push=(7, 8, 9), label="tinyPartial"),
        TinyStepper(wanted=DT, timeStepUpdateInterval=1, label="tinyStepper"),
        NewtonIntegrator(damping=0),
    ]
    O.dt = 1e-7
    O.trackEnergy = True
    return ids


def engine(label):
    return next(e for e in O.engines if e.label == label)


def test_scene():
    threads = yade.runtime.opts.threads or 1
    ids = build()
    O.run(1400, True)  # 0.14 s: first touch at 0.1 s, for 0.0702 (balls) and 0.0993 s (walls)
    check(close(O.dt, DT) and close(O.time, 1400 * DT, 1e-3), "TimeStepper sets dt")
    check(engine("tinyEngine").runs == 1400, "every step ran the engine")
    check(engine("tinyPeriodic").runs == engine("tinyPeriodic").nDone == 140, f"PeriodicEngine: {engine('tinyPeriodic').runs} runs of 140")
    check(close(O.energy["tiny"], 1400 * 1.5 * threads), f"EnergyTracker.add from {threads} threads: {O.energy['tiny']} J")

    seen = probe.live()
    check(list(seen["ids"]) == ids and seen["size"] == len(O.bodies) and seen["exists"] == (True, False), "bodies")
    check(list(seen["intrs"]) == [sum(b in (i.id1, i.id2) for i in O.interactions.all()) for b in ids], f"Body.intrs: {seen['intrs']}")
    real = {(i.id1, i.id2): i for i in O.interactions}
    check(len(real) == 3 and {p[:2] for p in seen["pairs"] if p[2]} == set(real), f"interactions: {seen['pairs']}")
    check(all(p[3] for p in seen["pairs"]) and seen["interactions"] == len(seen["pairs"]), "InteractionContainer: find, linIx, size")
    check((ids[3], ids[2]) in real and (ids[3], ids[4]) in real, "the wall comes first, as Ig2_Wall_TinyShape_TinyGeom wants it")
    check(set(seen["caches"]) == {(True, geom, "Ip2_TinyMat_TinyMat_TinyPhys", "Law2_TinyGeom_TinyPhys_Spring")
                                  for geom in ("Ig2_TinyShape_TinyShape_TinyGeom", "Ig2_Wall_TinyShape_TinyGeom")}, "Interaction.functorCache")
    check(list(seen["boundFunctors"]) == ["Bo1_TinyShape_Aabb"] * 3 + ["Bo1_Wall_Aabb", "Bo1_TinyShape_Aabb"], "Shape.boundFunctor")
    check([list(f) for f in seen["loop"]] == [["Ig2_TinyShape_TinyShape_TinyGeom", "Ig2_Wall_TinyShape_TinyGeom"], ["Ip2_TinyMat_TinyMat_TinyPhys"],
                                              ["Law2_TinyGeom_TinyPhys_Spring"]], "InteractionLoop and its dispatchers")
    check(all(f == O.forces.f(b) and t == O.forces.t(b) for b, (f, t) in zip(ids, seen["forces"])), "ForceContainer: getForce, getTorque")
    check(seen["synced"] and seen["lastReset"] >= 1399 and seen["threads"] == threads, "ForceContainer: synced, lastReset, threads")
    contact = real[ids[0], ids[1]]
    check(close(O.forces.f(ids[1])[0], STIFFNESS * contact.geom.overlap) and contact.phys.k == STIFFNESS, "force of the tiny law")
    check((O.forces.f(ids[3]) - Vector3(7, 8, 9) + O.forces.f(ids[2]) + O.forces.f(ids[4])).norm() < 1e-9, "PartialEngine pushes the wall")
    check(seen["energies"] == dict(O.energy.items()) and close(seen["energy"], O.energy.total()), "EnergyTracker")
    check(seen["locks"] == (True, True), "mutexes of the containers are free")
    check(isinstance(O.bodies[0].state, TinyState) and O.bodies[0].shape.dispHierarchy() == ["TinyShape", "Shape"], "classes of a body")
    check(O.engines[2].geomDispatcher.dispMatrix()["Wall", "TinyShape"] == "Ig2_Wall_TinyShape_TinyGeom", "dispatch matrix")

    O.run(1100, True)  # long after the contacts
    for b, expected in zip(ids, (-SPEED, SPEED, -SPEED, 0, SPEED)):
        check(close(O.bodies[b].state.vel[0], expected, .01), f"elastic rebound of body {b}: {O.bodies[b].state.vel[0]}")
    check(len(list(O.interactions)) == 0, "interactions ended")
    return [O.bodies[b].state.pos for b in ids]


def test_archives(expected):
    """A scene saved in the middle of contact and loaded ends like the one that ran through."""
    for suffix in ("xml", "xml.bz2", "yade.gz", "memory"):
        build()
        O.run(1400, True)
        O.bodies[0].shape.points, O.bodies[0].shape.turn, O.bodies[0].shape.pair = [(1, 2, 3), (4, 5, 6)], Quaternion((0, 0, 1), 1), (8, 9)
        O.bodies[0].shape.place, O.bodies[0].shape.numbers, O.bodies[0].shape.unsaved = ((1, 2, 3), Quaternion((1, 0, 0), 2)), [1.5, 2.5], 77
        O.bodies[0].shape.matrix, O.bodies[0].shape.other = Matrix3(1, 2, 3, 4, 5, 6, 7, 8, 9), Sphere(radius=4)
        O.bodies[0].state.heat = 12
        before = O.bodies[0].shape.dict()
        if suffix == "memory":
            O.saveTmp("abi", True)
            O.reset()
            O.loadTmp("abi", True)
        else:
            with tempfile.TemporaryDirectory() as folder:
                O.save(f"{folder}/scene.{suffix}", True)
                O.reset()
                O.load(f"{folder}/scene.{suffix}", True)
        after = O.bodies[0].shape.dict()
        check(after["unsaved"] == 3 and after["other"].radius == 4, f"{suffix}: noSave, pointer")
        for name in set(before) - {"unsaved", "other"}:
            check(str(before[name]) == str(after[name]), f"{suffix}: {name} is {after[name]}, was {before[name]}")
        check(O.bodies[0].shape.loads == 1 and O.bodies[0].state.heat == 12, f"{suffix}: postLoad, state")
        check(O.bodies[0].material.label == "tinyMat" and O.materials["tinyMat"].stiffness == STIFFNESS, f"{suffix}: material")
        O.run(1100, True)
        check(all((b.state.pos - p).norm() < 1e-9 for b, p in zip(O.bodies, expected)), f"{suffix}: the loaded scene goes on alike")


def test_control():
    build()
    engine("tinyEngine").fail = True
    try:
        O.run(1, True)
        check(False, "an engine's exception reaches Python")
    except RuntimeError as error:
        check("told to fail" in str(error), f"the exception's text: {error}")
    engine("tinyEngine").fail = False
    runs = engine("tinyEngine").runs
    O.run(200)  # in the background
    while O.running:
        time.sleep(.01)
    check(engine("tinyEngine").runs == runs + 200, "running in the background")
    O.run(1200, True)
    probe.requestErase(0, 1)
    O.step()
    check(not [i for i in O.interactions if {i.id1, i.id2} == {0, 1} and i.iterMadeReal < O.iter - 1], "InteractionContainer.requestErase")
    O.bodies.erase(1)
    check(list(probe.live()["ids"]) == [0, 2, 3, 4], "iteration skips erased bodies")

    O.reset()
    balls = [yade.utils.sphere((x, 0, 0), 1) for x in (0, 1.5)]
    clump, _ = O.bodies.appendClumped(balls)
    mine, theirs = probe.members(O.bodies[clump].shape), O.bodies[clump].shape.members
    check(set(mine) == set(theirs) and all(mine[m][0] == theirs[m][0] and mine[m][1] == theirs[m][1] for m in mine), "Clump.members")

    O.reset()
    O.periodic = True
    O.cell.setBox((2, 3, 4))
    O.cell.hSize = Matrix3(2, .5, 0, 0, 3, 0, 0, 0, 4)
    size, volume, shear, sheared = probe.live()["cell"]
    check(size == O.cell.size and close(volume, 24) and shear == O.cell.shearTrsf and sheared, "Cell: size, volume, shear")
    O.reset()


def test_running_scene():
    test_archives(test_scene())


for test in (test_members, test_answers, test_static_attributes, test_objects, test_running_scene, test_control):
    try:
        test()
    except Exception:  # noqa: BLE001
        traceback.print_exc()
        check(False, f"{test.__name__} came to its end")
print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
