# SPDX-License-Identifier: GPL-2.0-or-later
"""Random scenes, judged as the hard cases are. Each runs in a process of its own, with limits of time and memory.

    yade -n -x tests/stability/fuzz.py --count N --seed S     N random scenes
    yade -n -x tests/stability/fuzz.py --again FILE           those of a file, a line of json each
    more options: --only K, the K-th scene; --keep FILE, to which scenes that fail are added; --at-once N

A scene is a dict of plain numbers that follow from seed and number. It passes when it meets the LIMITS of stability.py; a run
that an engine ends with a sentence does not pass. Scenes that failed once are kept in CASES; one with an entry `known`, the
reason, is not mended yet: it has to end with a sentence or with finite values."""
import json
import math
import os
import random
import resource
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import block, disc, gel, perform, plate, polygon  # noqa: E402
from yade import O  # noqa: E402

CASES = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "fuzz_cases.jsonl")
METHODS = {"explicit": 5, "updated": 1, "implicit": 3, "quasistatic": 2}    # how often each of them
SECONDS, MEMORY = 60, 4 << 30   # CPU time [s] and memory [bytes] of a run
ENOUGH_STEPS = {"explicit": 3000, "updated": 1500, "implicit": 150, "quasistatic": 100}     # after which a run ends
LEGS = 5            # of a run, between which it may end
GAP = 0.02          # between bodies at the start [size]


def random_scene(seed, number):
    """Grains of one to three materials, of sizes within a factor of three, in one of five arrangements."""
    draw = random.Random(f"{seed} {number}")
    size, modulus, density = 10**draw.uniform(-4, -1), 10**draw.uniform(3, 8), 10**draw.uniform(2, 4)
    materials = [{"poisson": draw.choice((draw.uniform(0, 0.49), draw.uniform(0.4, 0.495))),
                  "mu": modulus * 10**(draw.uniform(0, 1.5) if k else 0), "density": density * 10**draw.uniform(-1, 0)}
                 for k in range(draw.randint(1, 3))]
    method = draw.choices(list(METHODS), METHODS.values())[0]
    arrange = draw.choice((press, pack, push) if method == "quasistatic" else (press, pack, push, collide, fall))
    scene = {"seed": seed, "number": number, "kind": arrange.__name__, "method": method, "size": size,
             "friction": draw.choice((0, 0, 0.3, draw.uniform(0, 1), 3)), "gravity": 0, "materials": materials,
             "grains": [], "walls": [], "boxes": []}
    wave = math.sqrt(modulus / density)     # of shear, in the softest [m/s]
    arrange(draw, scene, wave * 10**draw.uniform(-2, -0.7))
    scene["step"] = scene["duration"] / draw.choice((20, 40, 80))
    return rounded(scene)


def press(draw, scene, speed):
    """A column of grains between two plates, pressed by up to 40 %."""
    top = 0.0
    for _ in range(draw.randint(1, 3)):
        body = some_grain(draw, scene)
        top += body["reach"] + GAP * scene["size"]
        body["at"] = [draw.uniform(-0.2, 0.2) * scene["size"], top]
        top += body["reach"]
    top += GAP * scene["size"]
    scene["walls"] = [[1, 0, 1, 0], [1, top, -1, -speed]]
    if draw.random() < 0.5:
        width = 1.5 * scene["size"]
        scene["walls"] += [[0, -width, 1, 0], [0, width, -1, 0]]
    scene["duration"] = draw.uniform(0.05, 0.4) * top / speed


def pack(draw, scene, speed):
    """Grains in a box that one or four walls make smaller, up to solid fraction 0.95."""
    width = scatter(draw, scene, draw.randint(2, 7))
    solid = sum(area(body) for body in scene["grains"])
    target = draw.uniform(0.6, 0.95)
    four = draw.random() < 0.4
    if four:    # a corner that two such walls close on has no way out where friction is above 1
        scene["friction"] = min(scene["friction"], 0.9)
    scene["walls"] = [[0, 0, 1, speed * four], [0, width, -1, -speed * four], [1, 0, 1, speed * four], [1, width, -1, -speed]]
    scene["duration"] = (width - (math.sqrt(solid / target) if four else solid / target / width)) / (2 * speed if four else speed)


def push(draw, scene, speed):
    """A box, or its corner, goes into a grain that lies on a plate or between others."""
    size = scene["size"]
    width = scatter(draw, scene, draw.randint(1, 3))
    scene["walls"] = [[1, 0, 1, 0], [0, 0, 1, 0], [0, width, -1, 0]]
    half = draw.uniform(0.2, 1) * size
    turn = draw.choice((0, math.pi / 4, draw.uniform(0, math.pi)))
    x, low = draw.uniform(0.2, 0.8) * width, max(body["at"][1] + body["reach"] for body in scene["grains"])
    scene["boxes"] = [[x, low + GAP * size + math.sqrt(2) * half, half, half, turn, 0, -speed]]
    scene["duration"] = (low - draw.uniform(0.5, 1.2) * size) / speed if low > 1.3 * size else draw.uniform(0.1, 0.6) * size / speed


def collide(draw, scene, speed):
    """Grains thrown at the middle, with or without walls around."""
    width = scatter(draw, scene, draw.randint(2, 5))
    for body in scene["grains"]:
        away = [width / 2 - place for place in body["at"]]
        body["velocity"] = [speed * draw.uniform(0.5, 1.5) * part / max(math.hypot(*away), 0.01 * width) for part in away]
        body["spin"] = draw.uniform(-0.3, 0.3) * speed / scene["size"]
    if draw.random() < 0.5:
        scene["walls"] = [[0, 0, 1, 0], [0, width, -1, 0], [1, 0, 1, 0], [1, width, -1, 0]]
    scene["duration"] = draw.uniform(1, 3) * width / speed


def fall(draw, scene, speed):
    """Grains fall on a plate, between walls, and on boxes that lie there."""
    size = scene["size"]
    width = scatter(draw, scene, draw.randint(1, 5))
    scene["gravity"] = speed**2 / width
    scene["walls"] = [[1, -1.5 * size, 1, 0], [0, 0, 1, 0], [0, width, -1, 0]]
    for _ in range(draw.randint(0, 2)):
        half = draw.uniform(0.1, 0.4) * size
        scene["boxes"].append([draw.uniform(0.1, 0.9) * width, -0.7 * size, half, half / draw.choice((1, 3)),
                               draw.uniform(0, math.pi), 0, 0])
    scene["duration"] = draw.uniform(2, 4) * width / speed


def scatter(draw, scene, count):
    """Adds grains at places of a square where they do not touch; its width."""
    bodies = [some_grain(draw, scene) for _ in range(count)]
    gap = GAP * scene["size"]
    width = max(2 * body["reach"] + 2 * gap for body in bodies)
    while True:
        placed = []
        for body in bodies:
            for _ in range(100):
                room = body["reach"] + gap
                place = [draw.uniform(room, width - room) for _ in range(2)]
                if all(math.dist(place, other["at"]) > body["reach"] + other["reach"] + gap for other in placed):
                    placed.append({**body, "at": place})
                    break
            else:
                break
        if len(placed) == count:
            scene["grains"] = placed
            return width
        width *= 1.1


def some_grain(draw, scene):
    """Adds a disc or a polygon at no place yet."""
    shape = draw.choice(("disc", "disc", "regular", "rectangle", "star", "hook"))
    if shape == "disc":
        corners = []
    elif shape == "regular":
        count = draw.randint(3, 8)
        corners = [(math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count)) for k in range(count)]
    elif shape == "rectangle":
        height = 1 / draw.uniform(1, 4)
        corners = [(-1, -height), (1, -height), (1, height), (-1, height)]
    elif shape == "star":
        tips, inner = draw.randint(3, 5), draw.uniform(0.5, 0.8)
        corners = [((1, inner)[k % 2] * math.cos(math.pi * k / tips), (1, inner)[k % 2] * math.sin(math.pi * k / tips))
                   for k in range(2 * tips)]
    else:
        thick = draw.uniform(0.5, 1)
        corners = [(-1, -1), (1, -1), (1, -1 + thick), (-1 + thick, -1 + thick), (-1 + thick, 1), (-1, 1)]
    reach = scene["size"] * draw.uniform(0.4, 1.2)
    scale = reach / max([math.hypot(*corner) for corner in corners], default=1)
    turn = draw.uniform(0, 2 * math.pi)
    c, s = scale * math.cos(turn), scale * math.sin(turn)
    scene["grains"].append({"corners": [[c * x - s * y, s * x + c * y] for x, y in corners], "reach": reach, "turn": turn,
                            "material": draw.randrange(len(scene["materials"])), "points": draw.choice((40, 60, 120)),
                            "velocity": [0, 0], "spin": 0})
    return scene["grains"][-1]


def area(body):
    corners = body["corners"]
    if not corners:
        return math.pi * body["reach"]**2
    return sum(x * v - u * y for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1])) / 2


def rounded(value):
    """With six digits, so that what is printed is what was run."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item) for item in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def work_of(scene):
    """As the hard cases have it."""
    def work(run):
        materials = [gel(**material) for material in scene["materials"]]
        for body in scene["grains"]:
            (x, y), material = body["at"], materials[body["material"]]
            more = {"points": body["points"], "velocity": (*body["velocity"], 0), "spin": body["spin"]}
            if body["corners"]:
                polygon([(x + a, y + b) for a, b in body["corners"]], material, **more)
            else:
                disc(x, y, body["reach"], material, angle=body["turn"], **more)
        for wall in scene["walls"]:
            plate(*wall)
        for x, y, half_width, half_height, turn, *velocity in scene["boxes"]:
            block(x, y, half_width, half_height, turn, velocity)
        enough = ENOUGH_STEPS[scene["method"]]
        run.most_steps = 20 * enough
        run.begin(scene["step"], friction=scene["friction"], gravity=(0, -scene["gravity"], 0))
        while O.time < (1 - 1e-6) * scene["duration"] and run.steps < enough:
            leg = scene["duration"] / LEGS if run.implicit else min(scene["duration"], enough * O.dt) / LEGS
            run.go(min(leg, scene["duration"] - O.time))
    return work


def name_of(scene):
    return (f"{scene['seed']} {scene['number']}  {scene['kind']} of {len(scene['grains'])}, friction {scene['friction']:.2g}, "
            f"{scene['method']}")


def start(scene):
    """Runs a scene in another process: its id, and where its row can be read."""
    read, write = os.pipe()
    sys.stdout.flush()
    process = os.fork()
    if process:
        os.close(write)
        return process, read
    try:
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        run = perform(work_of(scene), scene["method"], name_of(scene))
        with os.fdopen(write, "w") as file:
            json.dump(run.row(scene.get("known", "")), file)
        sys.stdout.flush()
    finally:
        os._exit(0)


def run_all(scenes, at_once, keep):
    """Prints a line for each; the numbers of those that pass, are known not to, and fail."""
    waiting, running, counts = list(scenes), {}, {"ok": 0, "known": 0, "FAILED": 0}
    while waiting or running:
        while waiting and len(running) < at_once:
            scene = waiting.pop(0)
            process, read = start(scene)
            running[process] = (scene, read)
        process, status = os.wait()
        scene, read = running.pop(process)
        with os.fdopen(read) as file:
            text = file.read()
        row, code = json.loads(text) if text else None, os.waitstatus_to_exitcode(status)
        complaint = row["note"] if row else f"ended by signal {-code}: a crash, or more than {SECONDS} s"
        silent = not row or "rror: " in complaint
        verdict = "ok" if not complaint else "known" if "known" in scene and not silent else "FAILED"
        counts[verdict] += 1
        print(f"{verdict:7}{name_of(scene)}  {row['steps'] if row else '-'} steps  {complaint}", flush=True)
        if verdict == "FAILED" and keep:
            with open(keep, "a", encoding="utf-8") as file:
                file.write(json.dumps({**scene, "found": complaint}) + "\n")
    return counts


def read(path):
    """Scenes of a file."""
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def option(name, default):
    return type(default)(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else default


if __name__ == "__main__":
    seed, count, only, again = option("--seed", 1), option("--count", 25), option("--only", -1), option("--again", "")
    if again:
        scenes = read(again)
    else:
        known = {(case["seed"], case["number"]): case for case in read(CASES)}
        scenes = [known.get((seed, number)) or random_scene(seed, number) for number in range(count)]
    if only >= 0:
        scenes = [scene for scene in scenes if scene["number"] == only]
    counts = run_all(scenes, option("--at-once", 1), option("--keep", ""))
    print(f"seed {seed}: {len(scenes)} scenes" if not again else f"{len(scenes)} scenes of {again}")
    print(f"{counts['ok']} passed, {counts['known']} known not to pass, {counts['FAILED']} failed")
    sys.stdout.flush()
    sys.exit(1 if counts["FAILED"] else 0)
