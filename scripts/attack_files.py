"""Damaged results, blocks of unfinished runs and reduced parts: each is refused, or still right.

Run with: python scripts/attack_files.py [--results N] [--blocks N] [--caches N] [--seed S]

Each input is a sound file with one damage. A fault is a value that differs from the sound file's
and was read without a word, another exception than the one of wrong input, or a read of more than
ten seconds; it is printed with its seed.
"""

import argparse
import random
import shutil
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from exu_press import InputError, Result, Scene, simulate
from exu_press.result import run as runs
from exu_press.scene import flexible_press
from fe_models import Reduction, cache, reduced_part, shipped_part

LONGEST = 10.0
"""s, for one file."""

SMALL = 512
"""Bytes of the pieces that are exchanged."""

PAGE = 4096

HEADER = 6000
"""Bytes at the begin of a file in which half of the single bits are flipped."""


def flip_bits(draw: random.Random, content: bytes, count: int, first: int, last: int) -> bytes:
    """Return bytes with some bits flipped between two places."""
    damaged = bytearray(content)
    for _ in range(count):
        damaged[draw.randrange(first, last)] ^= 1 << draw.randrange(8)
    return bytes(damaged)


def damaged(draw: random.Random, content: bytes) -> bytes:
    """Return bytes with one damage of many kinds, as of a disk, a transfer or a hand."""
    size, how = len(content), draw.randrange(10)
    place, end = draw.randrange(size), min(size, HEADER)
    if how < 2:
        return flip_bits(draw, content, 1, 0, end if how else size)
    if how == 2:
        return flip_bits(draw, content, 20, 0, size)
    if how == 3:
        return flip_bits(draw, content, 2, max(0, size - PAGE), size)
    if how == 4:
        return content[:place]
    if how == 5:
        return content[:place] + bytes(len(content[place : place + PAGE])) + content[place + PAGE :]
    if how == 6:
        first, second = sorted((draw.randrange(size), place))
        middle = content[first + SMALL : second]
        pieces = content[second : second + SMALL], content[first : first + SMALL]
        return content[:first] + pieces[0] + middle + pieces[1] + content[second + SMALL :]
    if how == 7:
        return content[:place] + draw.randbytes(draw.randint(1, 8)) + content[place:]
    if how == 8:
        return content[:place] + content[place + draw.randint(1, 8) :]
    return content[:place] + draw.randbytes(8) + content[place + 8 :]


def same_runs(first: Result, second: Result) -> bool:
    """Return whether all that two results hold is equal."""
    return (
        first.scene == second.scene
        and first.info == second.info
        and first.bodies == second.bodies
        and first.units == second.units
        and all(np.array_equal(first[name], second[name]) for name in first)
        and first.surfaces.keys() == second.surfaces.keys()
        and all(
            np.array_equal(vars(surface)[name], vars(second.surfaces[body])[name])
            for body, surface in first.surfaces.items()
            for name in vars(surface)
        )
    )


class Campaign:
    """Reads damaged files, counts what becomes of them, and prints faults."""

    def __init__(self, name: str, read: Callable[[], bool | None]) -> None:
        """Take a function that says whether a file is still right; None where it is refused."""
        self.name, self.read = name, read
        self.counts, self.faults = Counter[str](), 0

    def attack(self, seed: int) -> None:
        """Read what a seed has made."""
        begin = time.process_time()
        try:
            with warnings.catch_warnings(action="ignore"):
                right = self.read()
        except Exception:
            self.fault(seed, traceback.format_exc())
            return
        if time.process_time() - begin > LONGEST:
            self.fault(seed, f"longer than {LONGEST:g} s")
        elif right is False:
            self.fault(seed, "other values, without a word")
        else:
            self.counts["still right" if right else "refused"] += 1

    def fault(self, seed: int, what: str) -> None:
        """Count and print a fault."""
        self.faults += 1
        self.counts["FAULT"] += 1
        print(f"FAULT, seed {seed}, {self.name}: {what}", flush=True)

    def close(self) -> int:
        """Print the totals, and return the number of faults."""
        ends = ", ".join(f"{count} {how}" for how, count in self.counts.most_common())
        print(f"{self.counts.total()} {self.name}: {ends or 'none'}", flush=True)
        return self.faults


def read_run(path: Path, sound: Result) -> bool | None:
    """Return whether a result is still right; None where it is refused."""
    try:
        return same_runs(sound, Result.load(path))
    except InputError:
        return None


def attack_results(folder: Path, seeds: Sequence[int]) -> int:
    """Damage a rigid and a flexible run's file in turn."""
    scenes = (
        Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02),
        Scene(bodies=flexible_press(modes=4), revolutions=0.002),
    )
    files = [folder / f"{number}.nc" for number in range(len(scenes))] if seeds else []
    for file, scene in zip(files, scenes, strict=False):
        simulate(scene).save(file)
    sound = [(Result.load(file), file.read_bytes()) for file in files]
    path = folder / "run.nc"
    whole = Campaign("damaged results", lambda: read_run(path, sound[seed % len(sound)][0]))
    for seed in seeds:
        path.write_bytes(damaged(random.Random(seed), sound[seed % len(sound)][1]))
        whole.attack(seed)
    return whole.close()


def attack_blocks(folder: Path, seeds: Sequence[int]) -> int:
    """Damage one of the files of an unfinished run."""
    left = folder / "left"
    runs.BLOCK = 0.3  # two blocks of a short run
    if seeds:
        scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.6)
        simulate(scene, unfinished=left)
    names = sorted(file.name for file in left.glob("*") if file.stat().st_size > PAGE)
    with warnings.catch_warnings(action="ignore"):
        sound = Result.load(left).map_values(lambda _, values: values) if seeds else None
        kept = {name: np.array(sound[name]) for name in sound} if sound else {}
    campaign = Campaign("damaged blocks", lambda: _same_blocks(left, kept))
    for seed in seeds:
        draw = random.Random(seed)
        file = left / draw.choice(names)
        whole = file.read_bytes()
        file.write_bytes(damaged(draw, whole))
        campaign.attack(seed)
        file.write_bytes(whole)
    return campaign.close()


def _same_blocks(
    left: Path, kept: dict[str, "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"]
) -> bool | None:
    try:
        run = Result.load(left)
        return all(np.array_equal(run[name], values) for name, values in kept.items())
    except InputError:
        return None


def attack_caches(folder: Path, seeds: Sequence[int]) -> int:
    """Damage a reduced part; None is what makes it be reduced again."""
    if not seeds:
        return Campaign("damaged caches", lambda: None).close()
    part, reduction = shipped_part("linkage", 0.06), Reduction(4)
    sound = reduced_part(part, reduction, folder=folder)
    file = cache.cache_file(part, reduction, folder)
    content = file.read_bytes()

    def read() -> bool | None:
        stored = cache.load(file)
        if stored is None:
            return None
        return all(
            np.array_equal(getattr(stored, name), getattr(sound, name)) for name in cache.PLAIN
        ) and (stored.name, stored.mass, stored.meta) == (sound.name, sound.mass, sound.meta)

    campaign = Campaign("damaged caches", read)
    for seed in seeds:
        file.write_bytes(damaged(random.Random(seed), content))
        campaign.attack(seed)
    return campaign.close()


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0 without a fault, else 1."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--results", type=int, default=400, metavar="N", help="damaged run.nc")
    parser.add_argument("--blocks", type=int, default=200, metavar="N", help="of unfinished runs")
    parser.add_argument("--caches", type=int, default=1000, metavar="N", help="reduced parts")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first input")
    options = parser.parse_args(arguments)
    faults = 0
    for attack, count in (
        (attack_results, options.results),
        (attack_blocks, options.blocks),
        (attack_caches, options.caches),
    ):
        folder = Path(tempfile.mkdtemp())
        try:
            faults += attack(folder, range(options.seed, options.seed + count))
        finally:
            shutil.rmtree(folder)
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
