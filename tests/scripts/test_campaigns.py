"""Campaigns: a few attacks of each kind, the stiff and extreme cases, fits of synthetic data."""

import random
import re

import pytest

import attack_files
import attack_scenes
from fit_recovers import main


def options(counts):
    return [word for name, count in counts.items() for word in (f"--{name}", str(count))]


@pytest.mark.parametrize("kind", ["results", "blocks", "caches"])
def test_a_few_damages_are_refused_or_nothing(kind, capsys, monkeypatch):
    monkeypatch.setattr("exu_press.result.run.BLOCK", 10.0)  # which the campaign shortens
    counts = {"results": 0, "blocks": 0, "caches": 0, kind: 5}
    assert attack_files.main([*options(counts), "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and f"\n5 damaged {kind}" in f"\n{printed}"


def test_every_damage_is_one():
    content = random.Random(1).randbytes(50_000)
    seeds = map(random.Random, range(200))
    assert all(attack_files.damage(draw, content) != content for draw in seeds)


@pytest.mark.long
@pytest.mark.parametrize(("kind", "count"), [("scenes", 2), ("results", 1), ("step", 4)])
def test_a_few_inputs_end_without_a_fault(kind, count, capsys):
    counts = {"scenes": 0, "results": 0, "step": 0, kind: count}
    assert attack_scenes.main([*options(counts), "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and f"\n{count} " in f"\n{printed}"


@pytest.mark.long
def test_nine_measurements_of_three_scenes(tmp_path, capsys):
    """Of 21 intervals 20 are expected to hold the true key; those of a fit are not independent."""
    assert main(["--quiet", "--measurements", "3", "--out", str(tmp_path)]) == 0
    held = re.search(r"(\d+) of 21 intervals hold the true key", capsys.readouterr().out)
    assert held is not None
    assert int(held[1]) >= 18
