# SPDX-License-Identifier: GPL-2.0-or-later
"""What summary.json says of a compaction."""
import os
import platform

import numpy
from yade import O, config

from . import jamming, measures
from .records import read_table


def versions():
    """Versions of what computed the run."""
    from . import __version__

    return {"softgrain": __version__, "yade": config.version, "python": platform.python_version(),
            "numpy": numpy.__version__, "machine": platform.machine(), "cores": os.cpu_count()}


def head(run):
    """How every summary begins: what was run with what."""
    return {"example": run.name, "command": run.command, "parameters": run.parameters(), "seed": getattr(run.options, "seed", None),
            "until": getattr(run.options, "until", None), "versions": versions()}


def stages():
    """Wall time of the SoftIntegrator by stage since the scene was made [s]."""
    names = ("forces and kick", "gathering contacts", "contact solver", "motion")
    return dict(zip(names, measures.softIntegrator().stageSeconds))


def costs(run, points, steps, stage_seconds):
    """CPU and wall time, and what a material point's step costs: dict. stage_seconds may be empty."""
    cpu, total = run.cpu_seconds(), sum(stage_seconds.values())
    per_point_step = 1e9 / max(points * steps, 1)
    bulk = sum(seconds for name, seconds in stage_seconds.items() if name in ("forces and kick", "motion"))
    result = {"cpu_s": round(cpu, 3), "wall_s": round(run.wall_seconds(), 3), "steps": steps, "threads": O.numThreads,
              "points": points, "ns_per_point_step": cpu * per_point_step}
    if total:
        result.update(bulk_ns_per_point_step=bulk * per_point_step,
                      stage_share={name: seconds / total for name, seconds in stage_seconds.items()},
                      stages_share_of_wall=total / run.wall_seconds())
    return result


def of_compaction(run, packing, press):
    """The whole summary: parameters, geometry, jamming, eq. 10, the end, costs."""
    table = read_table(run.path(f"{run.name}.csv"))
    last = {column: float(values[-1]) for column, values in table.items()}
    fits = [{key: value for key, value in fit.items() if key not in ("x", "y")} for fit in jamming.growth_fits(table)]
    balance = float(numpy.max(numpy.abs(table["energy_residual_J"])))
    return {**head(run), "box": {"width_m": press.box["width"], "height_m": press.box["height"],
                                 "grains": len(packing.ids)},
            "jamming": jamming.jamming_point(table), "equation_10": fits[0] if fits else None,
            "equation_10_other_phi0": fits[1:], "end": last,
            "deepest_penetration": float(numpy.nanmax(table["max_penetration_over_R"])),
            "energy_residual_over_work": balance / max(abs(last["external_work_J"]), 1e-300),
            "cost": costs(run, packing.points, press.memory["steps"], packing.stage_seconds())}
