"""Fit the dimensions of crank shaft and linkage to the published frequencies (about 10 minutes).

    OMP_NUM_THREADS=1 python scripts/fit_flexible_parts.py linkage --samples 60 --steps 6

Clamped at their bearings, modes 2, 5, 6, 10 and 16 are fitted; the mass is met exactly by the web's
radius (crank) or by a common factor on all widths (linkage). First a random search around the
start, then damped Gauss-Newton steps with bounds. Every evaluation runs in a process of its own,
because Netgen can abort the process on a shape it does not like.
"""

import argparse
import json
import subprocess
import sys
from dataclasses import asdict

import numpy as np

from exu_press.errors import InputError
from fe_models import CRANK_STEEL, LINKAGE_IRON, CrankShape, LinkageShape, Part
from fe_models.clamped import PUBLISHED_HZ, clamped_frequencies, relative_errors
from fe_models.part import CRANK_INTERFACES, LINKAGE_INTERFACES, shipped_part

MASS = {"crank": 217.6, "linkage": 184.5}  # Table 2 of the paper, kg
WALL = 0.032  # m, the thinnest wall around a bore
SIDE_PLAY = 0.002  # m on each side between the linkage's big end and the webs

# How much stiffer the fit's coarse mesh is than a converged one, measured on the first fits:
# the frequencies of modes 2, 5, 6, 10, 16 on 0.06 m over those on 0.015 m.
MESH_BIAS = {
    "crank": (0.013, 0.027, 0.012, 0.010, 0.006),
    "linkage": (0.010, 0.005, 0.006, 0.012, 0.006),
}

# lowest and highest value of what is fitted, m
BOUNDS = {
    "crank": {
        "seat_a_length": (0.12, 0.30),
        "seat_a_radius": (0.055, 0.075),
        "journal_length": (0.16, 0.26),
        "journal_radius": (0.074, 0.09),
        "web_thickness": (0.045, 0.08),
        "pin_length": (0.30, 0.38),
        "seat_b_length": (0.20, 0.36),
        "seat_b_radius": (0.06, 0.078),
        "flange_length": (0.08, 0.20),
        "flange_radius": (0.05, 0.075),
    },
    "linkage": {
        "big_outer_radius": (0.07 + WALL, 0.14),
        "big_width": (0.24, 0.338),
        "small_outer_radius": (0.085, 0.17),
        "small_bore_radius": (0.045, 0.09),
        "small_width": (0.22, 0.338),
        "shank_half_height_big": (0.05, 0.13),
        "shank_half_height_middle": (0.04, 0.15),
        "shank_half_height_small": (0.05, 0.17),
        "shank_width": (0.10, 0.338),
    },
}


def part_of(name, values):
    """The part with these dimensions and the exact mass."""
    if name == "crank":
        shape = CrankShape(**values, web_radius=0.2)
        web = shape.web_radius_for(MASS[name] / CRANK_STEEL.density)
        shape = CrankShape(**values, web_radius=float(web))
        return Part(name, shape, CRANK_STEEL, CRANK_INTERFACES, 0.06)
    shape = LinkageShape(**values)
    shape = shape.scale_widths(MASS[name] / LINKAGE_IRON.density / shape.build().mass)
    return Part(name, shape, LINKAGE_IRON, LINKAGE_INTERFACES, 0.06)


def penalties(name, shape):
    """How far the shape is from what one would make, in relative terms; zero where it is fine."""
    if name == "crank":
        excess = [shape.web_radius / 0.14 - 1.0, 0.338 / (shape.pin_length - 2 * SIDE_PLAY) - 1.0]
        return [10.0 * max(0.0, e) for e in excess]
    widest = min(shape.big_width, shape.small_width)
    heights = max(shape.shank_half_height_big, shape.shank_half_height_small)
    excess = [
        shape.big_width / 0.338 - 1.0,
        shape.small_width / 0.338 - 1.0,
        shape.shank_width / widest - 1.0,  # no wings in z
        shape.shank_half_height_big / shape.big_outer_radius - 1.0,  # none in y
        shape.shank_half_height_small / shape.small_outer_radius - 1.0,
        shape.shank_half_height_middle / heights - 1.0,  # no belly
        (shape.small_bore_radius + WALL) / shape.small_outer_radius - 1.0,
        (shape.big_bore_radius + WALL) / shape.big_outer_radius - 1.0,
    ]
    return [4.0 * max(0.0, e) for e in excess]


def evaluate(name, values, mesh_size):
    """The relative errors (5,) and penalties, by a process of its own; None if it fails."""
    request = json.dumps({"name": name, "values": values, "mesh_size": mesh_size})
    try:
        done = subprocess.run(
            [sys.executable, __file__, "--evaluate", request],
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        return np.array(json.loads(done.stdout.splitlines()[-1]))
    except (subprocess.TimeoutExpired, IndexError, json.JSONDecodeError):
        return None


def answer(request):
    """What a process of its own computes and prints."""
    name, values = request["name"], request["values"]
    try:
        part = part_of(name, values).replace(mesh_size=request["mesh_size"])
        errors = relative_errors(clamped_frequencies(part, 16), PUBLISHED_HZ[name])
        if part.mesh_size >= 0.04:
            errors = errors - np.array(MESH_BIAS[name])
    except InputError as error:
        print(error, file=sys.stderr)
        return
    print(json.dumps([*errors, *penalties(name, part.geometry)]))


def size(residual):
    """The rms of the five errors, penalties added."""
    return np.inf if residual is None else float(np.sqrt((residual**2).sum() / 5.0))


def fit(name, start, samples, steps, mesh_size, seed, spread):
    """The best dimensions found."""
    bounds = BOUNDS[name]
    keys = list(bounds)
    low, high = np.array(list(bounds.values())).T
    best = np.clip([start[key] for key in keys], low, high)

    def residual(x):
        return evaluate(name, dict(zip(keys, map(float, x), strict=True)), mesh_size)

    best_residual = residual(best)
    print(f"{name}: start {100 * size(best_residual):.2f} %", flush=True)
    generator = np.random.default_rng(seed)
    for i in range(samples):
        centre = best if i % 2 else 0.5 * (low + high)
        trial = np.clip(
            centre + spread * (high - low) * generator.uniform(-1, 1, len(keys)), low, high
        )
        found = residual(trial)
        if size(found) < size(best_residual):
            best, best_residual = trial, found
            print(f"  sample {i}: {100 * size(found):.2f} % {100 * found[:5]}", flush=True)
    for step in range(steps):
        columns = []
        for j in range(len(keys)):
            there = best.copy()
            width = 0.03 * (high[j] - low[j])
            there[j] += width if there[j] + width <= high[j] else -width
            found = residual(there)
            if found is None:
                found = best_residual
            columns.append((found - best_residual) / (there[j] - best[j]) * (high[j] - low[j]))
        jacobian = np.column_stack(columns)
        improved = False
        for damping in (0.003, 0.02, 0.1, 0.5):
            normal = jacobian.T @ jacobian + damping**2 * np.eye(len(keys))
            move = -np.linalg.solve(normal, jacobian.T @ best_residual) * (high - low)
            trial = np.clip(best + move, low, high)
            found = residual(trial)
            if size(found) < size(best_residual) * 0.999:
                best, best_residual, improved = trial, found, True
        print(
            f"  step {step}: {100 * size(best_residual):.2f} % {(100 * best_residual).round(2)}",
            flush=True,
        )
        if not improved:
            break
    return dict(zip(keys, map(float, best), strict=True))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="?", default="linkage", help="a name in parts.toml")
    parser.add_argument("--samples", type=int, default=0)
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--mesh-size", type=float, default=0.06)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--spread", type=float, default=0.3, help="of a sample, share of the range")
    parser.add_argument("--start", help="JSON of dimensions to start from")
    parser.add_argument("--evaluate", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.evaluate:
        answer(json.loads(options.evaluate))
        return
    name = options.part.split("_")[0]
    start = asdict(shipped_part(options.part).geometry)
    start |= json.loads(options.start or "{}")
    found = fit(
        name, start, options.samples, options.steps, options.mesh_size, options.seed, options.spread
    )
    shape = part_of(name, found).geometry
    for key, value in asdict(shape).items():
        print(f"{key} = {value:.7g}")


if __name__ == "__main__":
    main()
