"""Do the stated errors cover the true ones? Random scenes, each against much finer runs.

    python scripts/calibrate_errors.py [--scenes 60] [--seed 1] [--minutes 25] [--out DIR]

Presses and slider-cranks, dry, lubricated and mixed, 0.2 to 3 revolutions, clearances of 20 to
200 um, 60 to 400 rpm, tolerances of 3e-4 to 3e-3, some flexible. Each scene's figures are held
against those of the same scene at the finest of REFERENCES that is affordable. Beyond the horizon
no tolerance gives a true value: there MEMBERS further runs at a tenth of the tolerance, which have
nothing in common with each other, stand for it. Prints the share of figures whose stated error
covers the true one, and, of figures whose true error the reference can tell, how many times as
large it is in the median. Called again, it goes on where it was stopped, or where its minutes were
over.
"""

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exu_press import Result, Scene, simulate
from exu_press.scene import flexible_press
from exu_press.verification import simulate_with_errors
from exu_press.verification.compared import compared

REFERENCES = (1e-7, 1e-6, 1e-5)
"""Tolerances, of which the finest is taken whose run is not expected to take longer than LONGEST.
"""
LONGEST = 12.0  # s

GROWTH = 0.3
"""Power of one over the tolerance with which a run's time goes, measured: 0.2 to 0.3."""

MEMBERS = 4
APART = 0.01
"""Of the tolerance: by how much those of the members differ."""


def random_scene(random: np.random.Generator, longest: float, flexible: float) -> Scene:
    """Return a random scene of at most `longest` revolutions; some presses are flexible."""
    press = random.random() < 0.5
    pin = random.choice(["dry", "lubricated", "mixed"])
    pin_joint = {
        "kind": "dry" if pin == "dry" else "lubricated",
        "clearance": float(10.0 ** random.uniform(-4.7, -3.7)),
    }
    given = {
        "mechanism": "press" if press else "slider_crank",
        "speed_rpm": float(random.uniform(60.0, 400.0)),
        "revolutions": float(0.2 * (longest / 0.2) ** random.random()),
        "start_angle_deg": float(random.uniform(0.0, 360.0)),
        "joints": {"crank_pin": pin_joint},
        "solver": {"tolerance": float(10.0 ** random.uniform(-3.5, -2.5))},
    }
    if pin == "mixed":
        given["film"] = {"at_contact": "mixed", "viscosity": float(10.0 ** random.uniform(-3, -1))}
    if press:
        balls = {"kind": "dry", "clearance": float(10.0 ** random.uniform(-4.7, -3.7))}
        given["joints"]["balls"] = balls
        if random.random() < flexible:
            given["bodies"] = flexible_press()
    return Scene.from_dict(given)


def references(run: Result, cost: float) -> tuple[str, list[Result]]:
    """Return what a run with errors is held against, in words and as runs.

    Args:
        run: with its errors.
        cost: processor time that it took, with its companions, s.
    """
    assert run.scene.solver is not None and run.scene.solver.tolerance is not None
    tolerance = run.scene.solver.tolerance
    if run.info["horizon"] is None:
        for finest in REFERENCES:
            if 0.5 * cost * (tolerance / finest) ** GROWTH < LONGEST:
                break
        return f"{finest:.0e}", [simulate(run.scene.replace("solver.tolerance", finest))]
    members = [
        simulate(run.scene.replace("solver.tolerance", 0.1 * tolerance * (1.0 + APART * number)))
        for number in range(MEMBERS)
    ]
    return f"{MEMBERS} runs", members


def judged(scene: Scene) -> dict[str, Any]:
    """Return a scene's row; of each figure name, share covered, ratio and whether determined."""
    begun = time.process_time()
    run = simulate_with_errors(scene, beside=False)
    words, others = references(run, time.process_time() - begun)
    every: dict[str, list[Any]] = {}
    for other in others:
        if other.completed:
            for one in compared(run, other):
                every.setdefault(one.name, []).append(one)
    rows = []
    for name, several in every.items():
        if several[0].value != 0.0:
            ratios = [one.ratio for one in several if one.ratio is not None]
            covered = float(np.mean([one.covered for one in several]))
            ratio = float(np.median(ratios)) if ratios else None
            rows.append([name, covered, ratio, several[0].told["determined"]])
    return {
        "scene": in_words(scene),
        "status": run.info["status"],
        "reference": words,
        "horizon": run.info["horizon"],
        "seconds": time.process_time() - begun,
        "figures": rows,
    }


def in_words(scene: Scene) -> str:
    """Return what kind of scene it is."""
    assert scene.solver is not None
    pin = scene.joints["crank_pin"].kind
    film = "mixed" if scene.film and scene.film.at_contact == "mixed" else pin
    bodies = ", flexible" if scene.bodies else ""
    return (
        f"{scene.mechanism}{bodies}, {film}, {scene.revolutions:.2f} revolutions, "
        f"tolerance {scene.solver.tolerance:.1e}"
    )


def summed(label: str, figures: Sequence[Sequence[Any]]) -> str:
    """Return a line on figures as rows have them."""
    if not figures:
        return f"{label}: none"
    ratios = [ratio for _, _, ratio, _ in figures if ratio is not None]
    ratio = f"{np.median(ratios):.1f}" if ratios else "-"
    covered = np.mean([covered for _, covered, _, _ in figures])
    return f"{label}: {covered:.1%} of {len(figures)} covered, stated over true error {ratio}"


def report_lines(rows: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Yield a line a scene, then what all of them say."""
    for number, row in enumerate(rows, 1):
        horizon = "" if row["horizon"] is None else f", horizon {row['horizon']:.3g} s"
        yield summed(f"{number:3d} {row['scene']}{horizon}; {row['reference']}", row["figures"])
    every = [(row, figure) for row in rows for figure in row["figures"]]
    yield ""
    for words in dict.fromkeys(row["reference"] for row in rows):
        count = sum(row["reference"] == words for row in rows)
        some = [figure for row, figure in every if row["reference"] == words]
        yield summed(f"against {words} ({count} scenes)", some)
    yield summed("determined", [figure for _, figure in every if figure[-1]])
    yield summed("not determined", [figure for _, figure in every if not figure[-1]])
    yield summed(f"all {len(rows)} scenes", [figure for _, figure in every])
    missed = Counter(figure[0].split(".")[-1] for _, figure in every if figure[1] < 0.5)
    most = ", ".join(f"{name} ({count})" for name, count in missed.most_common(5))
    yield f"not covered most often: {most or 'none'}"


def main(arguments: list[str]) -> None:
    """Judge random scenes and print what came out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=25.0, help="no scene is begun later")
    parser.add_argument("--longest", type=float, default=3.0, help="revolutions")
    parser.add_argument("--flexible", type=float, default=0.1, help="share of the presses")
    parser.add_argument("--out", default="out/calibration", help="where finished scenes are kept")
    options = parser.parse_args(arguments)
    file = Path(options.out) / f"seed_{options.seed}.jsonl"
    file.parent.mkdir(parents=True, exist_ok=True)
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    end = time.monotonic() + 60.0 * options.minutes
    while len(rows) < options.scenes and time.monotonic() < end:
        random = np.random.default_rng([options.seed, len(rows)])
        rows.append(judged(random_scene(random, options.longest, options.flexible)))
        with file.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(rows[-1]) + "\n")
        print(summed(f"{len(rows):3d} {rows[-1]['scene']}", rows[-1]["figures"]), file=sys.stderr)
    print("\n".join(report_lines(rows)))


if __name__ == "__main__":
    main(sys.argv[1:])
