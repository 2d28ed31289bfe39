# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that were damaged: saved scenes, the checkpoints and tables of runs. Each damaged file is read by a process of its own,
which says what is wrong, in one sentence where the message is ours, and never crashes.

    yade -n -x tests/scenes/test_malformed_files.py [--seed S] [--count N damages of each kind] [--only K, the K-th of them]

Of scenes in YADE's binary form only the end is cut off and numbers of soft grains are overwritten: boost, which reads that form,
trusts what a file says of its own structure, and crashes on other damages. Checkpoints are in that form; they are read after
their digest has proved them whole."""
import bz2
import glob
import gzip
import math
import os
import random
import re
import resource
import runpy
import shutil
import signal
import struct
import sys

from yade import O
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, is_sentence, run_tests  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softBox, softCloud, softEngines, softPolygon  # noqa: E402


def option(name, default):
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else default


SEED, COUNT, ONLY = option("--seed", 1), option("--count", 30), option("--only", -1)
SECONDS, MEMORY = 60, 4 << 30   # that reading one file may take [s], [bytes]
EXTREMES = (b"nan", b"inf", b"-1", b"0", b"1e308", b"-1e-308", b"4294967296", b"18446744073709551615", b"x", b"", b"<", b"1.5.5")
NUMBER = re.compile(rb"-?\d+(\.\d+)?(e[-+]?\d+)?")


def damaged(data, generator):
    """The bytes of a file with one to four damages."""
    data = bytearray(data)
    for _ in range(generator.randint(1, 4)):
        if not data:
            break
        place = generator.randrange(len(data))
        length = generator.choice((1, 1, 2, 8, 100, 1000))
        kind = generator.choice("bit byte cut insert repeat end number number number".split())
        if kind == "bit":
            data[place] ^= 1 << generator.randrange(8)
        elif kind == "byte":
            data[place] = generator.randrange(256)
        elif kind == "cut":
            del data[place:place + length]
        elif kind == "insert":
            data[place:place] = bytes(generator.randrange(256) for _ in range(length))
        elif kind == "repeat":
            data[place:place] = data[place:place + length]
        elif kind == "end":
            del data[place:]
        elif numbers := list(NUMBER.finditer(data, place, place + 4000)):
            number = generator.choice(numbers)
            data[number.start():number.end()] = generator.choice(EXTREMES)
    return bytes(data)


def damaged_binary(data, generator, numbers):
    """The bytes of a scene in binary form, of which the end is cut off, or some of these arrays of numbers are overwritten."""
    if generator.random() < 0.3:
        return data[:generator.randrange(len(data))]
    data = bytearray(data)
    for _ in range(generator.randint(1, 4)):
        array = generator.choice(numbers)
        place = data.find(array) + 8 * generator.randrange(len(array) // 8)
        data[place:place + 8] = struct.pack("d", generator.choice((math.nan, math.inf, -1.0, 1e308, 1e-308, 1e9, 0.5)))
    return bytes(data)


def apart(work, said):
    """What `work` ends with in a process of its own, whose output goes to the file `said`: its exit code; 1 after an exception
    that is not one of bad input, which `said` then shows; a signal's negative number."""
    sys.stdout.flush()
    process = os.fork()
    if process == 0:
        code = 1
        try:
            out = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(out, 1)
            os.dup2(out, 2)
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            signal.alarm(SECONDS)
            code = work() or 0
        except SystemExit as end:
            code = end.code or 0
        except BaseException as error:
            print(f"{type(error).__name__}: {error}")
        finally:
            sys.stdout.flush()
            os._exit(code)
    _, status = os.waitpid(process, 0)
    return os.waitstatus_to_exitcode(status)


def text_of(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def write(path, data):
    with open(path, "wb") as file:
        file.write(data)


def small_scene():
    """Five discs and a triangle under a moving wall, after a hundred steps."""
    O.reset()
    gel, stone = O.materials.append(NeoHookeanMat()), O.materials.append(FrictMat())
    grains, height = softCloud(5e-3, 5, (1.4e-3, 2.0e-3), 0.6, gel, points=40, seed=2)
    O.bodies.append(grains)
    O.bodies.append(softPolygon([(8e-3, 0.1e-3), (9e-3, 0.1e-3), (8.5e-3, 1e-3)], gel, points=40))
    top = O.bodies.append(softBox(5e-3, height, stone))[-1]
    O.bodies[top].state.vel = (0, -2, 0)
    O.engines = softEngines()
    for _ in range(100):
        O.step()


def soft_numbers(xml):
    """The arrays of soft grains in a saved scene, as a binary one holds them."""
    arrays_there = re.findall(r"<node(?:Displacement|Velocity).*?</node(?:Displacement|Velocity)>", xml, re.DOTALL)
    values = [[float(item) for item in re.findall(r"<item>(.*?)</item>", array)] for array in arrays_there]
    return [struct.pack(f"{len(array)}d", *array) for array in values if array]


def load_and_go_on(path):
    """Exit code 0 when the scene runs, 2 when it is refused in words."""
    try:
        O.load(path, quiet=True)
        for _ in range(3):
            O.step()
        [arrays.points(body) for body in measures.softBodies()]
        if measures.softBodies():
            measures.softIntegrator().elasticEnergy()
    except (RuntimeError, ValueError, MemoryError) as error:    # MemoryError: boost takes what it reads for a size
        print(f"{type(error).__name__}: {error}")
        return 2
    return 0


def saved_scenes(checks):
    packed = {"yade": (bytes, bytes), "xml": (bytes, bytes), "yade.gz": (gzip.decompress, gzip.compress),
              "xml.bz2": (bz2.decompress, bz2.compress)}
    with Folder() as folder:
        small_scene()
        whole, said = {}, os.path.join(folder, "said.txt")
        for ending in packed:
            path = os.path.join(folder, f"scene.{ending}")
            O.save(path, quiet=True)
            whole[ending] = bytes_of(path)
        numbers = soft_numbers(whole["xml"].decode())
        O.reset()
        for ending in whole:
            path = os.path.join(folder, f"scene.{ending}")
            checks.that(f"{ending}, whole", apart(lambda: load_and_go_on(path), said) == 0, text_of(said))
        for number in chosen():
            generator = random.Random(f"scenes {SEED} {number}")
            ending = generator.choice(list(packed))
            unpack, pack = packed[ending]
            data = unpack(whole[ending])
            path = os.path.join(folder, f"damaged.{ending}")
            write(path, pack(damaged(data, generator) if "xml" in ending else damaged_binary(data, generator, numbers)))
            code = apart(lambda: load_and_go_on(path), said)
            checks.that(f"seed {SEED}, scene {number} ({ending})", code in (0, 2), f"exit code {code}: {text_of(said)[-300:]}")


def run_script(example, *options):
    """Runs an example; ends the process."""
    sys.argv = [os.path.join(EXAMPLES, example), *options]
    runpy.run_path(sys.argv[0], init_globals=dict(globals()), run_name="__main__")


def whole_run(checks, folder, said):
    """The folder of a small compaction."""
    out = os.path.join(folder, "run")
    options = "--grains 6 --points 40 --until 0.66 --no-figures --out".split()
    code = apart(lambda: run_script("compaction.py", *options, out), said)
    checks.that("a small run", code == 0, text_of(said))
    return out


def refused_in_a_sentence(checks, what, code, said):
    text = text_of(said).strip()
    checks.that(what, code == 0 or code == 2 and is_sentence(text.splitlines()[-1]) and "Traceback" not in text,
                f"exit code {code}: {text[-600:]}")


def checkpoints(checks):
    with Folder() as folder:
        said = os.path.join(folder, "said.txt")
        out, copy = whole_run(checks, folder, said), os.path.join(folder, "copy")
        names = ["checkpoint.json", "compaction.csv", os.path.basename(glob.glob(os.path.join(out, "*.yade"))[0])]
        for number in chosen():
            generator = random.Random(f"checkpoints {SEED} {number}")
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(out, copy)
            name = generator.choice(names)
            data = bytes_of(os.path.join(out, name))
            changed = damaged(data, generator)
            write(os.path.join(copy, name), changed)
            code = apart(lambda: run_script("compaction.py", "--resume", "--until", "0.67", "--out", copy), said)
            what = f"seed {SEED}, checkpoint {number} ({name})"
            refused_in_a_sentence(checks, what, code, said)
            checks.that(f"{what} found", code == 2 or changed.startswith(data) or name.endswith("json"), text_of(said)[-300:])


def tables(checks):
    with Folder() as folder:
        said = os.path.join(folder, "said.txt")
        out = whole_run(checks, folder, said)
        csv = os.path.join(out, "compaction.csv")
        data = bytes_of(csv)
        for number in chosen():
            generator = random.Random(f"tables {SEED} {number}")
            write(csv, damaged(data, generator))
            code = apart(lambda: run_script("figures.py", out, "--out", os.path.join(folder, "figures")), said)
            refused_in_a_sentence(checks, f"seed {SEED}, table {number}", code, said)


def chosen():
    return range(COUNT) if ONLY < 0 else [ONLY]


print(f"seed {SEED}")
run_tests(saved_scenes, checkpoints, tables)
