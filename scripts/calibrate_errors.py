"""Do the stated errors cover the true ones? Random scenes, each against much finer runs.

    python scripts/calibrate_errors.py [--scenes 200] [--seed 1] [--minutes 25] [--out DIR]
    python scripts/calibrate_errors.py --chaotic 2 --scenes 40

All shipped mechanisms and random own ones, of which some are as small as in watches; ideal, dry,
lubricated and mixed joints, alone and in pairs; all friction laws; guides with clearance,
elasticity and friction; motors; pulses, tables of forces, sheets and springs; flexible bodies; 10
to 400 rpm; fixed steps, and tolerances of 3e-5 to 1e-2; 0.1 to 0.35 revolutions:
`calibration.scenes` draws them. Each scene's figures are held against those of the same scene at
the finest of REFERENCES that is affordable, with small largest steps. Beyond the horizon no
tolerance gives a true value: there MEMBERS further runs at a tenth of the tolerance, which have
nothing in common with each other, stand for it. With --chaotic the scenes are dry ones with large
clearances, of up to so many revolutions, against a run at a tenth of their tolerance and, beyond
the horizon, one at a thirtieth.

Prints, for each group of scenes and each quantity with ENOUGH figures, the share of figures whose
stated error covers the true one, what this is at most, and, of figures whose true error the
reference can tell, how many times as large the stated one is in the median. Called again, it goes
on where it was stopped, or where its minutes were over.
"""

import argparse
import contextlib
import json
import multiprocessing
import os
import resource
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from signal import SIGKILL, SIGXCPU
from typing import Any

import numpy as np

from calibration.scenes import chaotic_scene, groups_of, random_scene
from exu_press import InputError, Result, Scene, simulate
from exu_press.verification.run import with_errors
from exu_press.verification.stated_errors import compare_errors

REFERENCES = (1e-7, 1e-6, 1e-5)
"""Tolerances, of which the finest is taken whose run is not expected to take longer than LONGEST.
"""
LONGEST = 1.0  # s

FINER = 30.0
"""Times, at least, by which references are finer than the run, however long they take."""

LIKE_FIXED = 1e-4
"""Tolerance whose runs take about as long as those with fixed steps."""

FINE_STEP = 0.25
"""Largest step of references, degrees of the crank: none of the run's own."""

GROWTH = 0.3
"""Power of one over the tolerance with which a run's time goes, measured: 0.2 to 0.3."""

LIMIT = 25
"""s of processor time, after which a scene's process is ended."""

A_MINUTE = 60.0  # s

ENDED = SIGXCPU, SIGKILL
"""By what a process ends that has used up its processor time."""

RAN = "completed", "under-resolved"

CHAOTIC = (1.0 / 10.0, 1.0 / 30.0)
"""Tolerances over a chaotic scene's own of the runs that it is held against."""

ENOUGH = 100
"""Figures, of which a quantity has a line of its own and a share is compared with WANTED."""

WANTED, LEVEL, RESAMPLES = 0.95, 0.01, 2000
"""A share lies below WANTED where it does so in all but LEVEL of its resamples. Scenes are
resampled, as figures of one scene are not independent."""

MEMBERS = 4
APART = 0.01
"""Of the tolerance: by how much those of the members differ."""


def references(run: Result, cost: float, *, chaotic: bool) -> tuple[str, list[Result]]:
    """Return what a run with errors is held against, in words and as runs.

    Args:
        run: with its errors.
        cost: processor time that it took, with its refinements, s.
        chaotic: whether its scene is one of `chaotic_scene`.
    """
    solver = run.scene.solver
    if chaotic:
        assert solver.tolerance is not None
        parted = run.info["horizon"] is not None
        wanted = [
            run.scene.replace({"solver.tolerance": part * solver.tolerance})
            for part in (CHAOTIC if parted else CHAOTIC[:1])
        ]
        words = f"finer runs, {'with' if parted else 'without'} horizon"
        return words, [simulate(scene) for scene in wanted]
    tolerance = solver.tolerance or LIKE_FIXED
    as_tolerance = run.scene.replace({"solver.step": None, "solver.tolerance": tolerance})
    if run.info["horizon"] is None:
        for finest in (*REFERENCES, tolerance / FINER):
            if 0.5 * cost * (tolerance / finest) ** GROWTH < LONGEST:
                break
        finest = min(finest, tolerance / FINER)
        fine = {"solver.tolerance": finest, "solver.max_step_deg": FINE_STEP}
        return f"{finest:.0e}", [simulate(as_tolerance.replace(fine))]
    members = [
        simulate(
            as_tolerance.replace({"solver.tolerance": 0.1 * tolerance * (1.0 + APART * number)})
        )
        for number in range(MEMBERS)
    ]
    return f"{MEMBERS} runs", members


def judged(
    number: int, scene: Scene, tell: Callable[[dict[str, Any]], None], *, chaotic: bool
) -> None:
    """Tell a scene's row as soon as it has run, and again with its figures.

    Of each figure the row has name, share covered, ratio and whether it is determined.
    """
    begun = time.process_time()
    row: dict[str, Any] = {
        "number": number,
        "groups": groups_of(scene),
        "status": "refused",
        "reference": "-",
        "horizon": None,
        "figures": [],
    }
    try:
        run = simulate(scene, quiet=False)
        alone = time.process_time() - begun
        run = with_errors(run, beside=False)
        row |= {"status": run.info["status"], "horizon": run.info["horizon"]}
        row["seconds_to_errors"] = time.process_time() - begun
        row["cost"] = row["seconds_to_errors"] / alone
        tell(row)
        if run.completed:
            row["reference"], others = references(run, time.process_time() - begun, chaotic=chaotic)
            row["figures"] = held_against(run, others)
    except InputError as error:
        row["reason"] = str(error)
    except Exception:  # the campaign is to find them
        row |= {"status": "traceback", "reason": traceback.format_exc()}
    tell(row)


def held_against(run: Result, others: Sequence[Result]) -> list[list[Any]]:
    """Return the figures of a run with its errors beside those of others."""
    every: dict[str, list[Any]] = {}
    for other in others:
        if other.completed:
            for one in compare_errors(run, other):
                every.setdefault(one.name, []).append(one)
    rows = []
    for name, several in every.items():
        if several[0].value != 0.0:
            ratios = [one.ratio for one in several if one.ratio is not None]
            covered = float(np.mean([one.is_covered for one in several]))
            ratio = float(np.median(ratios)) if ratios else None
            rows.append([name, covered, ratio, several[0].stated["determined"]])
    return rows


def summed(label: str, figures: Sequence[Sequence[Any]]) -> str:
    """Return a line on figures as rows have them."""
    if not figures:
        return f"{label}: none"
    ratios = [ratio for _, _, ratio, _ in figures if ratio is not None]
    ratio = f"{np.median(ratios):.1f}" if ratios else "-"
    covered = np.mean([covered for _, covered, _, _ in figures])
    return f"{label}: {covered:.1%} of {len(figures)} covered, stated over true error {ratio}"


def report_lines(rows: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Yield a line a group, then what all of them say."""
    judged_rows = [row for row in rows if row["figures"]]
    every = [(row, figure) for row in judged_rows for figure in row["figures"]]
    yield (
        f"{'group':41s} {'scenes':>6s} {'figures':>7s} {'covered':>8s} {'at most':>8s} "
        f"{'stated/true':>11s}"
    )
    groups = sorted({group for row in judged_rows for group in row["groups"]})
    for group in groups:
        yield in_a_row(group, [(row, one) for row, one in every if group in row["groups"]])
    named: dict[str, list[tuple[dict[str, Any], Sequence[Any]]]] = {}
    for row, one in every:
        named.setdefault(quantity_in(one[0]), []).append((row, one))
    for name in sorted(named):
        if len(named[name]) >= ENOUGH:
            yield in_a_row(name, named[name])
    finest = [(row, one) for row, one in every if row["reference"] == f"{REFERENCES[0]:.0e}"]
    yield in_a_row(f"against {REFERENCES[0]:.0e}", finest)
    members = [(row, one) for row, one in every if row["reference"] == f"{MEMBERS} runs"]
    yield in_a_row(f"against {MEMBERS} runs", members)
    yield in_a_row("determined", [(row, one) for row, one in every if one[-1]])
    yield in_a_row("not determined", [(row, one) for row, one in every if not one[-1]])
    yield in_a_row("all", every)
    costs = [row["cost"] for row in judged_rows if "cost" in row]
    if costs:
        most = np.percentile(costs, 95.0)
        yield f"processor time with errors over a run's: {np.median(costs):.2f}, 95 % {most:.2f}"
    missed = Counter(quantity_in(one[0]) for _, one in every if one[1] < 0.5)
    most_often = ", ".join(f"{name} ({count})" for name, count in missed.most_common(8))
    yield f"not covered most often: {most_often or 'none'}"
    ends = Counter(row["status"] for row in rows)
    yield "how they ended: " + ", ".join(f"{end} ({count})" for end, count in ends.most_common())
    unjudged = sum(not row["figures"] and row["status"] in RAN for row in rows)
    if unjudged:
        yield f"without a reference within {LIMIT} s: {unjudged}"
    long = [row for row in rows if row.get("seconds_to_errors", row["seconds"]) > A_MINUTE]
    silent = sum(not row["said"] for row in long)
    yield f"longer than a minute: {len(long)}, of which {silent} had not said so"


def quantity_in(name: str) -> str:
    """Return a figure's name without the joint, guide, load or body that it belongs to."""
    place, _, rest = name.partition(".")
    owners = {"joints", "guides", "loads", "bodies"}
    return f"{place}: {rest.partition('.')[2]}" if place in owners else name


def in_a_row(label: str, figures: Sequence[tuple[dict[str, Any], Sequence[Any]]]) -> str:
    """Return a line of the table on figures as rows have them."""
    if not figures:
        return f"{label:41s} {0:6d}"
    scenes: dict[Any, list[float]] = {}
    for row, one in figures:
        scenes.setdefault(row["number"], []).append(one[1])
    ratios = [one[2] for _, one in figures if one[2] is not None]
    ratio = f"{np.median(ratios):.1f}" if ratios else "-"
    covered = np.mean([one[1] for _, one in figures])
    most = upper_share(list(scenes.values()))
    below = "  below" if most < WANTED and len(figures) >= ENOUGH else ""
    return (
        f"{label:41s} {len(scenes):6d} {len(figures):7d} {covered:8.1%} {most:8.1%} {ratio:>11s}"
        f"{below}"
    )


def upper_share(scenes: Sequence[Sequence[float]]) -> float:
    """Return the share of covered figures that all but LEVEL of resampled scenes are below."""
    sums = np.array([[sum(covered), len(covered)] for covered in scenes])
    drawn = np.random.default_rng(1).integers(len(sums), size=(RESAMPLES, len(sums)))
    covered, figures = sums[drawn].sum(axis=1).T
    return float(np.percentile(covered / figures, 100.0 * (1.0 - LEVEL)))


def in_a_process(number: int, scene: Scene, *, chaotic: bool) -> dict[str, Any]:
    """Return a scene's row from a process of its own, which may die or take too long."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    row: dict[str, Any] = {"status": f"longer than {LIMIT} s"}
    with tempfile.TemporaryFile("w+", encoding="utf-8") as terminal:

        def work() -> None:
            os.dup2(terminal.fileno(), 2)
            resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
            judged(number, scene, there.send, chaotic=chaotic)

        process = context.Process(target=work)
        begun = time.monotonic()
        process.start()
        there.close()
        with contextlib.suppress(EOFError):
            while True:
                row = here.recv()
        process.join()
        if process.exitcode not in (0, *(-signal for signal in ENDED)):
            row = {"status": "process died"}
        terminal.seek(0)
        said = [line for line in terminal.read().splitlines() if " left" in line]
    empty = {"number": number, "groups": groups_of(scene), "figures": [], "reference": "-"}
    took = {"seconds": time.monotonic() - begun, "said": said[0] if said else ""}
    return {**empty, **took, **row, "scene": scene.to_dict()}


def main(arguments: list[str]) -> None:
    """Judge random scenes and print what came out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=25.0, help="no scene is begun later")
    parser.add_argument("--longest", type=float, default=0.35, help="revolutions")
    parser.add_argument("--chaotic", type=float, help="most revolutions of dry scenes")
    parser.add_argument("--beside", nargs="*", default=[], help="files of rows to print, too")
    parser.add_argument("--out", default="out/calibration", help="where finished scenes are kept")
    options = parser.parse_args(arguments)
    kind = "" if options.chaotic is None else f"chaotic_{options.chaotic:g}_"
    file = Path(options.out) / f"{kind}seed_{options.seed}.jsonl"
    file.parent.mkdir(parents=True, exist_ok=True)
    rows = read_rows(file)
    end = time.monotonic() + 60.0 * options.minutes
    while len(rows) < options.scenes and time.monotonic() < end:
        random = np.random.default_rng([options.seed, len(rows)])
        chaotic = options.chaotic is not None
        scene = (
            chaotic_scene(random, options.chaotic)
            if chaotic
            else random_scene(random, options.longest)
        )
        rows.append(in_a_process(len(rows), scene, chaotic=chaotic))
        with file.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(rows[-1]) + "\n")
        label = f"{len(rows):3d} {rows[-1]['status']} {rows[-1]['seconds']:.0f} s"
        words = summed(f"{label} {', '.join(rows[-1]['groups'])}", rows[-1]["figures"])
        print(words, file=sys.stderr, flush=True)
    for path in map(Path, options.beside):
        others = read_rows(path)
        rows += [{**row, "number": f"{path} {row['number']}"} for row in others]
    print("\n".join(report_lines(rows)))


def read_rows(file: Path) -> list[dict[str, Any]]:
    """Return the rows of finished scenes, none where there is no file."""
    return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []


if __name__ == "__main__":
    main(sys.argv[1:])
