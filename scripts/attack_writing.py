"""Commands that are killed, and disks that are full: what is left of what was computed.

Run with: python scripts/attack_writing.py [--kills N] [--disks N] [--seed S]

A command is killed at an instant by chance, in the last two thirds of its usual time, and is
then given again, twice at most: its results must be those of one that nobody disturbed, and none of
its processes may live on. A disk is a file system in memory of 16 kB to 4 MB, which the system lets
root alone make. A command on it must end with 0, or with 3 and one message that names a file on it;
what it then leaves must be readable. Faults are printed with their seed.
"""

import csv
import os
import random
import signal
import subprocess
import sys
import time
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

import attacks
from attacks import Totals
from exu_press import InputError, Result
from exu_press.result.checkpoint import HEAD, has_blocks

COMMAND = [sys.executable, "-m", "exu_press"]

LONGEST = 300.0
"""s, for one command."""

SCENE = """
mechanism = "slider_crank"
revolutions = {revolutions}
[joints.crank_pin]
kind = "dry"
clearance = 1e-4
"""

LONG = """
mechanism = "slider_crank"
revolutions = 21.0
[joints]
[solver]
tolerance = 1e-2
"""

FLEXIBLE = """
mechanism = "slider_crank"
revolutions = 0.001
[bodies.rod]
flexible = "linkage"
modes = 2
mesh_size = 0.06
"""

STUDY = """
save_runs = true
scene = "short.toml"
[keys]
joints.crank_pin.clearance = [5e-5, 1e-4]
speed_rpm = [100.0, 200.0, 300.0]
"""

QUIET = ("--no-pictures", "--quiet", "--out", "o")

COMMANDS = {
    "run": ("run", "long.toml", "--no-error", *QUIET),
    "sweep": ("sweep", "study.toml", "--workers", "2", *QUIET),
    "compare": ("compare", "short.toml", "other.toml", "third.toml", "--no-error", *QUIET),
}


def prepare(folder: Path) -> None:
    """Write the inputs of all commands."""
    folder.mkdir(parents=True)
    for name, revolutions in (("short", 0.1), ("other", 0.15), ("third", 0.2)):
        (folder / f"{name}.toml").write_text(SCENE.format(revolutions=revolutions))
    (folder / "long.toml").write_text(LONG)
    (folder / "flexible.toml").write_text(FLEXIBLE)
    (folder / "study.toml").write_text(STUDY)


def start(folder: Path, *arguments: str, **environment: str) -> "subprocess.Popen[str]":
    """Return a command that runs in a folder."""
    return subprocess.Popen(
        [*COMMAND, *arguments],
        cwd=folder,
        env={**os.environ, "OMP_NUM_THREADS": "1", "PYTHONSAFEPATH": "1", **environment},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def perform(folder: Path, *arguments: str, **environment: str) -> tuple[int, str]:
    """Return exit status and messages of a command."""
    process = start(folder, *arguments, **environment)
    try:
        _, messages = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return -1, f"longer than {LONGEST:g} s"
    return process.returncode, messages


def results_in(folder: Path) -> dict[str, Result]:
    """Return all results below a folder by their paths; raise InputError for one that is none."""
    with warnings.catch_warnings(action="ignore"):
        return {
            str(file.relative_to(folder)): Result.load(file)
            for file in sorted([*folder.rglob("*.nc"), *folder.rglob("*.unfinished")])
            if file.name not in ("table.nc", HEAD) and (file.suffix == ".nc" or has_blocks(file))
        }


def table_in(folder: Path) -> list[dict[str, str]]:
    """Return the rows of a study's table, but for the times they took."""
    files = [*folder.rglob("table.csv")]
    rows = [*csv.DictReader(files[0].open(encoding="utf-8"))] if files else []
    return [{name: value for name, value in row.items() if "time" not in name} for row in rows]


def same(first: Path, second: Path) -> bool:
    """Return whether results and tables in two folders are equal."""
    ours, others = results_in(first), results_in(second)
    return (
        ours.keys() == others.keys()
        and table_in(first) == table_in(second)
        and all(np.array_equal(run[n], others[path][n]) for path, run in ours.items() for n in run)
    )


def descendants(process: int) -> set[int]:
    """Return the numbers of a process's children, and of theirs."""
    files = Path(f"/proc/{process}/task").glob("*/children")
    children: set[int] = set()
    for file in files:
        try:
            children |= {int(word) for word in file.read_text().split()}
        except OSError:
            continue  # its thread has ended
    return children.union(*map(descendants, children))


def alive(process: int) -> bool:
    """Return whether a process runs, and is no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def attack_by_kills(base: Path, seeds: Sequence[int]) -> int:
    """Kill commands, give them again, and compare with what is undisturbed."""
    totals, usual = Totals("kills"), base / "undisturbed"
    lasts: dict[str, float] = {}
    for name, arguments in COMMANDS.items() if seeds else ():
        prepare(usual / name)
        begin = time.monotonic()
        status, messages = perform(usual / name, *arguments)
        lasts[name] = time.monotonic() - begin
        if status != 0:
            totals.fault(-1, f"undisturbed {name}: {status}, {messages}")
    for seed in seeds:
        draw, name = random.Random(seed), [*COMMANDS][seed % len(COMMANDS)]
        folder = base / f"{seed}"
        prepare(folder)
        process = start(folder, *COMMANDS[name])
        time.sleep(draw.uniform(0.3, 1.0) * lasts[name])  # before, it loads packages
        children = descendants(process.pid)
        process.send_signal(draw.choice((signal.SIGKILL, signal.SIGKILL, signal.SIGTERM)))
        process.communicate()
        ended = process.returncode == 0
        time.sleep(1.0)
        if any(map(alive, children)):
            totals.fault(seed, f"{name}: processes live on")
            continue
        try:
            has_results = bool(results_in(folder))
        except InputError as error:
            totals.fault(seed, f"{name}: half a file ({error})")
            continue
        status, messages = perform(folder, *COMMANDS[name])
        if status == 2 and name == "run" and "finished blocks" in messages:
            status, messages = perform(folder, *COMMANDS[name], "--overwrite")
        if status != 0 or not same(usual / name, folder):
            totals.fault(seed, f"{name} again: {status}, {messages}")
            continue
        how = (
            "had ended"
            if ended
            else "with results kept"
            if has_results
            else "with nothing there yet"
        )
        totals.count(f"{name} {how}, equal when given again")
    return totals.close()


@contextmanager
def small_disk(folder: Path, size: int) -> Iterator[bool]:
    """Make a file system of so many bytes; yield False where the rights do not allow it."""
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    if subprocess.run(mount, check=False, capture_output=True).returncode:
        yield False
        return
    try:
        yield True
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


OF_DISKS = {
    "output of run": ("run", "long.toml", "--no-error", "--no-pictures"),
    "output of run with pictures": ("run", "short.toml", "--no-error"),
    "output of sweep": ("sweep", "study.toml", "--workers", "2", "--no-pictures"),
    "output of compare": ("compare", "short.toml", "other.toml", "--no-error", "--no-pictures"),
    "temporary folder": ("run", "long.toml", "--once", "--no-pictures"),
    "cache": ("run", "flexible.toml", "--no-error", "--no-pictures"),
}
"""What lies on the disk -> command."""

VARIABLES = {"temporary folder": "TMPDIR", "cache": "EXU_PRESS_CACHE"}


def attack_by_full_disks(base: Path, seeds: Sequence[int]) -> int:
    """Let output, temporary folder or cache of commands lie on a small disk."""
    totals, inputs = Totals("full disks"), base / "inputs"
    prepare(inputs)
    for seed in seeds:
        disk, name = base / f"disk {seed}", [*OF_DISKS][seed % len(OF_DISKS)]
        with small_disk(disk, 1 << random.Random(seed).randrange(14, 23)) as exists:
            if not exists:
                print("full disks: this user may make no file systems", flush=True)
                return 0
            out = base / f"o{seed}" if name in VARIABLES else disk / "o"
            environment = {VARIABLES[name]: str(disk)} if name in VARIABLES else {}
            arguments = (*OF_DISKS[name], "--quiet", "--out", str(out))
            status, messages = perform(inputs, *arguments, **environment)
            if what := wrong_end(status, messages, str(disk)):
                totals.fault(seed, f"{name}: {what}: {status}, {messages!r}")
                continue
            try:
                results_in(base)
            except InputError as error:
                totals.fault(seed, f"{name}: half a file ({error})")
                continue
            warned = ", with a warning" if messages and status == 0 else ""
            how = f"full: status {status}{warned}" if messages else "large enough"
            totals.count(f"{name} {how}")
    return totals.close()


def wrong_end(status: int, messages: str, disk: str) -> str:
    """Return what is wrong with a command's end on a disk that may be full, or nothing."""
    lines = [line for line in messages.splitlines() if line.startswith("exu-press: ")]
    if "Traceback" in messages:
        return "traceback"
    if status not in (0, 3):
        return "exit status"
    if (status == 3 or messages) and (len(lines) != 1 or disk not in messages):
        return "not one message with a file on the disk"
    return "" if status == 3 or not messages or "warning: " in lines[0] else "no warning"


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0 without a fault, else 1."""
    kinds = {
        "kills": (attack_by_kills, 32, "commands to kill"),
        "disks": (attack_by_full_disks, 36, "small disks"),
    }
    return attacks.main(__doc__ or "", kinds, arguments)


if __name__ == "__main__":
    sys.exit(main())
