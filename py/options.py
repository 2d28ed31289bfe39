# SPDX-License-Identifier: GPL-2.0-or-later
"""Command-line options shared by the examples. A bad option or value is one sentence and exit code 2."""
import argparse
import math
import os
import re
import sys

import yade.wrapper as wrapper
from yade import O, utils

from . import measures, presets
from .checks import InputError

# Options that say how a run is managed, not what is computed: they may differ when a run is resumed.
MANAGEMENT = {"out", "force", "resume", "threads", "until", "checkpoint_seconds", "at_once", "figures", "movie"}

MOST_THREADS = 16    # a core
STEPS_OF_AN_IMPLICIT_ONE = 300    # explicit steps that cost as much as an implicit one, about

# What argparse takes for a value and not for an option; its own pattern leaves out -1e6.
NEGATIVE_NUMBER = re.compile(r"^-((\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|nan|inf)$")


class Parser(argparse.ArgumentParser):
    """An argument parser without abbreviations whose errors are InputErrors."""

    def __init__(self, name, description):
        super().__init__(prog=f"yade -n -x {name}.py", description=description, allow_abbrev=False,
                         formatter_class=argparse.ArgumentDefaultsHelpFormatter)
        self.name = name
        self._negative_number_matcher = NEGATIVE_NUMBER

    def error(self, message):
        """What argparse calls with its own sentence: an InputError of it."""
        raise InputError(f"{message}; --help lists the options.")

    def add_management(self):
        """The options of every example: folder, overwriting, resuming, threads, checkpoints."""
        group = self.add_argument_group("the run")
        group.add_argument("--out", default=self.name, metavar="DIR", help="folder for what is computed")
        group.add_argument("--force", action="store_true", help="overwrite a run in that folder")
        group.add_argument("--resume", action="store_true", help="continue the run in that folder from its checkpoint")
        group.add_argument("--threads", type=threads, default=O.numThreads, metavar="N", help="OpenMP threads")
        group.add_argument("--checkpoint-seconds", type=positive, default=20.0, metavar="S",
                           help="wall time between checkpoints [s]")

    def add_movie(self):
        """--movie, of an example whose rows are moments of one scene."""
        self.add_argument("--movie", type=frames, default=0, metavar="N", help="a movie with a frame every N rows; 0: none")

    def read(self):
        """The options, from the command line, or in yade-batch from a line of its table; with `given`, the set of names that are there,
        and `words`, what it takes to run it again, as further attributes."""
        words = self._of_batch() or sys.argv[1:]
        options = self.parse_args(words, Options())
        options.words = [word for word in words if word not in ("--force", "--resume")]
        defaults = [(action, action.default) for action in self._actions]
        for action, _ in defaults:
            action.default = argparse.SUPPRESS
        options.given = set(vars(self.parse_args(words)))
        for action, default in defaults:
            action.default = default
        return options


    def _of_batch(self):
        """The words of the line of a table that yade-batch has started this process for; None outside of a batch. A column is an option of
        its name; commas part several values, * is the default, 1 and 0 are with and without a switch. The folder is named NAME-DESCRIPTION."""
        if not utils.runningInBatch():
            return None
        file, _, line = os.environ["YADE_BATCH"].rpartition(":")
        row = utils.TableParamReader(file).paramDict()[int(line)]
        words = []
        for column, value in row.items():
            option = f"--{column.replace('_', '-')}"
            if column == "description" or column.startswith("!") or value == "*":
                continue
            if getattr(self._option_string_actions.get(option), "nargs", None) == 0:
                words += [option] if value != "0" else []
            else:
                words += [option, *value.split(",")]
        return words if "out" in row else [*words, "--out", f"{self.name}-{row['description'].replace('/', '_')}"]


class Options(argparse.Namespace):
    """What the command line says, whose words are `words`."""
    words = ()

    def set_quick(self, values):
        """With --quick, takes these values for options that the command line does not hold."""
        for name, value in values.items() if self.quick else ():
            if name not in self.given:
                setattr(self, name, value)


def _checked(convert, word, holds, wish):
    """A type of argparse: the text converted, or one sentence, `TEXT has to WISH`, where the value does not hold."""
    def check(text):
        value = convert(text)
        if not holds(value):
            raise argparse.ArgumentTypeError(f"{text} has to {wish}")
        return value

    check.__name__ = word       # argparse says: invalid <name> value
    return check


positive = _checked(float, "number above zero", lambda value: 0 < value < math.inf, "be above zero and finite")
not_negative = _checked(float, "number", lambda value: 0 <= value < math.inf, "be zero or above, and finite")
finite = _checked(float, "number", math.isfinite, "be finite")
share = _checked(float, "number", lambda value: 0 <= value <= 1, "lie between 0 and 1")
theta = _checked(float, "number", lambda value: 0.5 <= value <= 1, "lie between 0.5 and 1")
count = _checked(int, "whole number", lambda value: value >= 1, "be 1 or more")
frames = _checked(int, "whole number", lambda value: value >= 0, "be 0 or more")
seed = _checked(int, "whole number", lambda value: value >= 0, "be 0 or more")
threads = _checked(count, "whole number", lambda value: value <= MOST_THREADS * os.cpu_count(),
                   f"be {MOST_THREADS * os.cpu_count()} or less on this machine of {os.cpu_count()} cores")


def accuracy(text):
    """A type of argparse: a number, or the name of one, which presets.settings judges."""
    try:
        return float(text)
    except ValueError:
        return text


def add_quick(group, what, values):
    """--quick, whose help is `what` and the values, a dict, that Options.set_quick then takes."""
    words = ", ".join(f"--{name} {value}" for name, value in values.items())
    group.add_argument("--quick", action="store_true", help=f"{what} {words} unless given")


def add_packing(parser, until):
    """The options of a box of discs whose top wall comes down; the group, for more of them."""
    group = parser.add_argument_group("the packing")
    group.add_argument("--grains", type=count, default=300, metavar="N", help="number of discs")
    group.add_argument("--diameters", type=positive, nargs=2, default=[1.4e-3, 2.4e-3], metavar=("MIN", "MAX"),
                       help="of the discs, uniform between these [m]")
    group.add_argument("--solid-fraction", type=positive, default=0.65, metavar="PHI", help="at the start")
    group.add_argument("--speed", type=positive, default=1.0, metavar="V", help="of the top wall [m/s]")
    group.add_argument("--friction", type=not_negative, default=0.0, metavar="MU", help="between grains")
    group.add_argument("--wall-friction", type=not_negative, default=0.0, metavar="MU", help="of grains and walls")
    group.add_argument("--until", type=positive, default=until, metavar="PHI", help="solid fraction at the end")
    group.add_argument("--seed", type=seed, default=1, metavar="N", help="of sizes, places and grid orientations")
    group.add_argument("--quick", action="store_true", help="a small, fast packing")
    group.add_argument("--no-figures", action="store_false", dest="figures", help="leave out the figures")
    return group


def refuse_nothing_to_press(options):
    """InputError for an end of the packing that its start is at or beyond."""
    if options.until <= options.solid_fraction:
        raise InputError(f"--until {options.until:g} is not above --solid-fraction {options.solid_fraction:g}: "
                         "give a larger one.")


def add_material(parser):
    """The options of which make_material makes a material."""
    group = parser.add_argument_group("the material of the grains")
    group.add_argument("--material", choices=("nh", "mr", "ogden", "plastic"), default="nh",
                       help="Neo-Hookean, Mooney-Rivlin, Ogden or elastoplastic")
    group.add_argument("--lambda", type=finite, default=61e6, dest="lambda_", metavar="PA",
                       help="all but Mooney-Rivlin, Pa")
    group.add_argument("--mu", type=positive, default=1.26e6, metavar="PA", help="all but Mooney-Rivlin: shear modulus, Pa")
    group.add_argument("--alpha", type=finite, default=6.0, metavar="ALPHA",
                       help="Ogden: exponent; the coefficient is 2 mu / alpha")
    group.add_argument("--yield-stress", type=positive, default=0.1e6, metavar="PA", help="elastoplastic, Pa")
    group.add_argument("--hardening", type=not_negative, default=0.0, metavar="PA", help="elastoplastic, Pa")
    group.add_argument("--c1", type=finite, default=0.63e6, metavar="PA", help="Mooney-Rivlin, Pa")
    group.add_argument("--c2", type=finite, default=-0.0012e6, metavar="PA", help="Mooney-Rivlin, Pa")
    group.add_argument("-c", "--c", type=positive, default=6e6, metavar="PA",
                       help="Mooney-Rivlin, Pa; write -c, since yade takes --c for an option of its own")
    group.add_argument("--density", type=positive, default=1000.0, metavar="KG/M3", help="of the undeformed grains")
    group.add_argument("--viscosity", type=not_negative, default=0.0, metavar="PAS", help="shear viscosity of the solid, Pa s")


def make_material(options):
    """The material of the grains that the options describe."""
    common = {"density": options.density, "viscosity": options.viscosity, "label": "grains"}
    if options.material == "nh":
        return wrapper.NeoHookeanMat(lambda_=options.lambda_, mu=options.mu, **common)
    if options.material == "ogden":
        if options.alpha == 0:
            raise InputError("--alpha 0 gives no energy: give another exponent.")
        return wrapper.OgdenMat(lambda_=options.lambda_, mu=[2 * options.mu / options.alpha], alpha=[options.alpha], **common)
    if options.material == "plastic":
        return wrapper.PlasticMat(lambda_=options.lambda_, mu=options.mu, yieldStress=options.yield_stress,
                                  hardening=options.hardening, **common)
    return wrapper.MooneyRivlinMat(c1=options.c1, c2=options.c2, c=options.c, **common)


def add_gel(group, viscosity, friction, points):
    """The options of soft grains of gel, with their defaults."""
    group.add_argument("--shear-modulus", type=positive, default=2e4, metavar="PA", help="of the gel [Pa]")
    group.add_argument("--viscosity", type=not_negative, default=viscosity, metavar="PAS", help="of the gel [Pa s]")
    group.add_argument("--friction", type=not_negative, default=friction, metavar="MU", help="of all contacts")
    group.add_argument("--points", type=count, default=points, metavar="N", help="material points of a grain")


def make_gel(options):
    """The material that options of add_gel describe, labelled "gel"."""
    return wrapper.NeoHookeanMat(lambda_=50 * options.shear_modulus, mu=options.shear_modulus, density=1000,
                                 viscosity=options.viscosity, frictionAngle=math.atan(options.friction), label="gel")


def add_method(parser):
    """The options of time integration, resolution and solver."""
    group = parser.add_argument_group("the method")
    group.add_argument("--integrator", choices=("explicit", "implicit", "auto"), default="explicit",
                       help="time integration; auto picks by the speed, and says so")
    group.add_argument("--theta", type=theta, default=1.0, metavar="THETA", help="implicit: weight of a step's end, 0.5 to 1")
    group.add_argument("--quasistatic", action="store_true", help="implicit, without inertia")
    group.add_argument("--formulation", choices=("total", "updated"), default="total",
                       help="Lagrangian in the undeformed grain, or updated: a grid laid anew once cells are out of shape")
    group.add_argument("--dt", type=positive, default=None, metavar="S",
                       help="time step, the largest of implicit ones; None: chosen automatically")
    group.add_argument("--safety", type=positive, default=0.8, metavar="SHARE",
                       help="time step chosen automatically, over the estimated stable one")
    group.add_argument("--points", type=count, default=276, metavar="N", help="material points of a disc")
    group.add_argument("--surface-spacing", type=positive, default=1.0, metavar="H",
                       help="largest distance of surface points, over the width of a cell")
    group.add_argument("--tolerance", type=positive, default=1e-3, metavar="TAU",
                       help="the contact solver stops when a sweep changes the impulses by less, relative")
    group.add_argument("--accuracy", type=accuracy, default=None, metavar="ERROR",
                       help="relative error in stress to expect, such as 0.01, or draft, standard, fine: chooses --points, "
                            "--surface-spacing, --safety and --tolerance")
    group.add_argument("--locking-cure", choices=("on", "off"), default="on",
                       help="the points of a cell share one volume change; off is for comparisons")


def choose_by_accuracy(options):
    """With --accuracy, takes the settings that deliver it. InputError when one of them is given too."""
    if options.accuracy is not None:
        given = [f"--{name.replace('_', '-')}" for name in ("dt", *presets.CHOSEN) if name in options.given]
        presets.refuse_both("--accuracy", options.accuracy, given)
        chosen = presets.settings("--accuracy", options.accuracy)
        for name in presets.CHOSEN:
            setattr(options, name, chosen[name])


def grain_settings(options):
    """What the options say of every grain: further arguments of softDisc and softCloud."""
    return {"points": options.points, "surfaceSpacing": options.surface_spacing,
            "meanDilatation": options.locking_cure == "on", "formulation": options.formulation}


def engine_settings(options):
    """What the options say of time step and solver: arguments of softEngines."""
    return {"dt": options.dt, "safety": options.safety, "tolerance": options.tolerance}


def make_quasistatic_implicit(options):
    """--quasistatic takes implicit steps; InputError when explicit ones were asked for."""
    if options.quasistatic and options.integrator == "explicit":
        if "integrator" in options.given:
            raise InputError("--quasistatic goes without inertia, which --integrator explicit cannot: use implicit.")
        options.integrator = "implicit"


def choose_method(options, step):
    """The arguments of softEngines for the time integration. `step`: length of an implicit step that follows the loading
    well [s]. Resolves --integrator auto: prints what it picked and why."""
    if options.integrator == "auto":
        ratio = step / _explicit_step()
        options.integrator = "implicit" if options.quasistatic or ratio > STEPS_OF_AN_IMPLICIT_ONE else "explicit"
        print(f"--integrator auto: {options.integrator}, since an implicit step of {step:.2g} s stands for {ratio:.0f} "
              f"explicit ones and costs about as much as {STEPS_OF_AN_IMPLICIT_ONE}"
              f"{'; --quasistatic asks for it' if options.quasistatic else ''}")
    if options.integrator == "explicit":
        return {"dt": options.dt}
    return {"dt": options.dt or step, "integrator": "implicit", "theta": options.theta, "quasistatic": options.quasistatic}


def _explicit_step():
    """About the stable step of the soft grains of the scene, from cell widths and speeds of sound [s]."""
    return min((0.6 * body.shape.cellWidth() / math.sqrt(_wave_modulus(body.mat) / body.mat.density)
                for body in measures.softBodies()), default=math.inf)


def _wave_modulus(material):
    """lambda + 2 mu at small strains [Pa]."""
    if isinstance(material, wrapper.MooneyRivlinMat):
        return 2 * material.c + 4 * material.c2 + 4 * (material.c1 + material.c2)
    return material.lambda_ + 2 * material.mu


def command_line():
    """The words by which this process was started: python, yade, options and script of yade, options of the script."""
    with open("/proc/self/cmdline", "rb") as file:
        return [os.fsdecode(word) for word in file.read().split(b"\0")[:-1]]


def use_threads(wanted):
    """Starts yade anew with -j when the number of threads asked for is not the one that runs: OpenMP and YADE fix it
    when they start. Returns when the numbers agree."""
    if wanted == O.numThreads:
        return
    mark = "SOFTGRAIN_RESTARTED_FOR_THREADS"
    if os.environ.get(mark):
        raise InputError(f"--threads {wanted} could not be had, yade runs {O.numThreads}: "
                         f"start it with yade -j{wanted}.")
    os.environ[mark] = str(wanted)
    words = command_line()
    script = words.index(sys.argv[0], 2)
    before, skip = [], False
    for word in words[2:script]:
        if not skip and not word.startswith(("-j", "--threads", "--cores")):
            before.append(word)
        skip = not skip and word in ("-j", "--threads", "--cores")
    sys.stdout.flush()
    sys.stderr.flush()
    os.execv(words[0], words[:2] + [f"-j{wanted}"] + before + words[script:])
