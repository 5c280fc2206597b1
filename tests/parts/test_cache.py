import hashlib
import io
import os
import random
from pathlib import Path

import numpy as np
import pytest

from fe_models import Reduction, cache, reduced_part


def with_digest(data):
    return data + hashlib.sha256(data).digest()


def swapped(by, sound):
    first, second = sorted(by.sample(range(len(sound) // 512), 2))
    pieces = [sound[i : i + 512] for i in range(0, len(sound), 512)]
    pieces[first], pieces[second] = pieces[second], pieces[first] + b"\0"
    return b"".join(pieces)


def flipped(by, sound, count=1, last=0):
    data = bytearray(sound)
    for _ in range(count):
        data[by.randrange(len(data) - last if last else 0, len(data))] ^= 1 << by.randrange(8)
    return bytes(data)


DAMAGE = {
    "a bit": flipped,
    "the directory": lambda by, sound: flipped(by, sound, 2, last=2500),
    "the end": lambda by, sound: sound[: by.randrange(len(sound))],
    "a page": lambda by, sound: sound[:4096] + bytes(4096) + sound[8192:],
    "pieces": swapped,
    "twice": lambda by, sound: sound + sound,
    "another archive": lambda by, sound: with_digest(b"PK\5\6" + bytes(18)),
    "no archive": lambda by, sound: with_digest(by.randbytes(1000)),
    "a damaged archive": lambda by, sound: with_digest(flipped(by, sound[:-32], 20, last=2500)),
}


@pytest.fixture(scope="module")
def made(bar, tmp_path_factory):
    folder = tmp_path_factory.mktemp("cache")
    return folder, reduced_part(bar, Reduction(6), folder=folder)


def same(a, b):
    for key in cache.PLAIN:
        assert np.array_equal(getattr(a, key), getattr(b, key)), key
    for one, other in zip(a.interfaces, b.interfaces, strict=True):
        assert (one.face, one.arm, one.area) == (other.face, other.arm, other.area)
        assert np.array_equal(one.rotation, other.rotation)
    assert (a.name, a.mass, a.method, a.meta) == (b.name, b.mass, b.method, b.meta)
    assert all(np.array_equal(a.couplings[k], b.couplings[k]) for k in a.couplings)


def test_key_tells_apart_what_differs(bar, made):
    folder, _ = made
    files = {
        cache.cache_file(part, reduction, folder)
        for part in (bar, bar.replace(mesh_size=0.04))
        for reduction in (Reduction(6), Reduction(7), Reduction(6, "free"))
    }
    assert len(files) == 6


class Touch:
    """An object that creates a file when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return Path.touch, (self.path,)


def test_a_foreign_file_is_not_read_but_made_again(bar, made, tmp_path: Path):
    """One whose objects run code as they are unpickled; and a sound one of another reduction."""
    folder, part = made
    file = cache.cache_file(bar, Reduction(5), tmp_path)
    content = io.BytesIO()
    np.savez(content, text=np.array([Touch(tmp_path / "touched")], dtype=object))
    sound = cache.cache_file(bar, Reduction(6), folder).read_bytes()
    for foreign in (with_digest(content.getvalue()), sound):
        file.write_bytes(foreign)
        assert cache.load(file) is None
    assert not (tmp_path / "touched").exists()
    shares = []
    for _ in range(2):
        reduced = reduced_part(
            bar, Reduction(5), folder=str(tmp_path), report=lambda _, share: shares.append(share)
        )
        assert reduced.mode_count == 5 and reduced.mass == part.mass
        same(cache.load(file), reduced)
    assert shares == sorted(shares) and shares.count(0.0) == shares.count(1.0) == 1


@pytest.mark.parametrize("seed", range(2))
def test_any_damage_is_noticed(bar, made, tmp_path: Path, seed):
    """Bits, bytes, pages, ends, pieces that changed places, other archives and no files at all."""
    sound = cache.cache_file(bar, Reduction(6), made[0]).read_bytes()
    file, by = cache.cache_file(bar, Reduction(6), tmp_path), random.Random(seed)
    for how in (*DAMAGE, *DAMAGE, *DAMAGE):
        file.write_bytes(DAMAGE[how](by, sound))
        assert cache.load(file) is None, how
    file.unlink()
    file.mkdir()
    assert cache.load(file) is None
    file.rmdir()
    os.mkfifo(file)
    assert cache.load(file) is None


def test_folder_that_cannot_be_written(bar, made, tmp_path: Path):
    """A cache is a help, not a need; one warning says that it is missing."""
    blocked = tmp_path / "file"
    blocked.touch()
    with pytest.warns(UserWarning, match=r"bar.*npz: cannot be written \(.*\)") as warned:
        same(reduced_part(bar, Reduction(6), folder=blocked / "cache"), made[1])
    assert len(warned) == 1
