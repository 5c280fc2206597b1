"""Damaged results, blocks of unfinished runs and reduced parts: each is refused, or still right.

Run with: python scripts/attack_files.py [--results N] [--blocks N] [--caches N] [--seed S]

Each input is a sound file with one damage. A fault is a value that differs from the sound file's
and was read without a word, another exception than the one of wrong input, or a read of more than
ten seconds; it is printed with its seed.
"""

import random
import sys
import time
import traceback
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np

import attacks
from attacks import Totals
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
    damage = bytearray(content)
    for _ in range(count):
        damage[draw.randrange(first, last)] ^= 1 << draw.randrange(8)
    return bytes(damage)


def damage(draw: random.Random, content: bytes) -> bytes:
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


def read_damaged(totals: Totals, seed: int, read: Callable[[], bool | None]) -> None:
    """Count what becomes of a damaged file.

    Args:
        totals: of its kind.
        seed: of its damage.
        read: returns whether the file is still right; None where it is refused.
    """
    begin = time.process_time()
    try:
        with warnings.catch_warnings(action="ignore"):
            is_right = read()
    except Exception:
        totals.fault(seed, traceback.format_exc())
        return
    if time.process_time() - begin > LONGEST:
        totals.fault(seed, f"longer than {LONGEST:g} s")
    elif is_right is False:
        totals.fault(seed, "other values, without a word")
    else:
        totals.count("still right" if is_right else "refused")


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
        Scene(bodies=flexible_press(modes=4, mesh_size=0.1), revolutions=0.002),
    )
    files = [folder / f"{number}.nc" for number in range(len(scenes))] if seeds else []
    for file, scene in zip(files, scenes, strict=False):
        simulate(scene).save(file)
    sound = [(Result.load(file), file.read_bytes()) for file in files]
    path = folder / "run.nc"
    totals = Totals("damaged results")
    for seed in seeds:
        original, content = sound[seed % len(sound)]
        path.write_bytes(damage(random.Random(seed), content))
        read_damaged(totals, seed, partial(read_run, path, original))
    return totals.close()


def attack_blocks(folder: Path, seeds: Sequence[int]) -> int:
    """Damage one of the files of an unfinished run."""
    blocks = folder / "blocks"
    runs.BLOCK = 0.3  # two blocks of a short run
    if seeds:
        scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.6)
        simulate(scene, unfinished=blocks)
    names = sorted(file.name for file in blocks.glob("*") if file.stat().st_size > PAGE)
    with warnings.catch_warnings(action="ignore"):
        sound = Result.load(blocks).map_values(lambda _, values: values) if seeds else None
        expected = {name: np.array(sound[name]) for name in sound} if sound else {}
    totals = Totals("damaged blocks")
    for seed in seeds:
        draw = random.Random(seed)
        file = blocks / draw.choice(names)
        whole = file.read_bytes()
        file.write_bytes(damage(draw, whole))
        read_damaged(totals, seed, partial(_same_blocks, blocks, expected))
        file.write_bytes(whole)
    return totals.close()


def _same_blocks(
    blocks: Path, expected: dict[str, "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"]
) -> bool | None:
    try:
        run = Result.load(blocks)
        return all(np.array_equal(run[name], values) for name, values in expected.items())
    except InputError:
        return None


def attack_caches(folder: Path, seeds: Sequence[int]) -> int:
    """Damage a reduced part; None is what makes it be reduced again."""
    if not seeds:
        return Totals("damaged caches").close()
    linkage, reduction = shipped_part("linkage", 0.06), Reduction(4)
    sound = reduced_part(linkage, reduction, folder=folder)
    file = cache.cache_file(linkage, reduction, folder)
    content = file.read_bytes()

    def read() -> bool | None:
        stored = cache.load(file)
        if stored is None:
            return None
        return all(
            np.array_equal(getattr(stored, name), getattr(sound, name)) for name in cache.PLAIN
        ) and (stored.name, stored.mass, stored.meta) == (sound.name, sound.mass, sound.meta)

    totals = Totals("damaged caches")
    for seed in seeds:
        file.write_bytes(damage(random.Random(seed), content))
        read_damaged(totals, seed, read)
    return totals.close()


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0 without a fault, else 1."""
    kinds = {
        "results": (attack_results, 400, "damaged run.nc"),
        "blocks": (attack_blocks, 200, "of unfinished runs"),
        "caches": (attack_caches, 1000, "reduced parts"),
    }
    return attacks.main(__doc__ or "", kinds, arguments)


if __name__ == "__main__":
    sys.exit(main())
