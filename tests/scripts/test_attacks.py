"""A few attacks of the campaigns; all by scripts/attack_files.py and scripts/attack_scenes.py."""

import random

import pytest

import attack_files
import attack_scenes


def options(counts):
    return [word for name, count in counts.items() for word in (f"--{name}", str(count))]


@pytest.mark.parametrize("kind", ["results", "blocks", "caches"])
def test_a_few_damages_are_refused_or_nothing(kind, capsys, monkeypatch):
    monkeypatch.setattr("exu_press.result.run.BLOCK", 10.0)  # which the campaign shortens
    counts = {"results": 0, "blocks": 0, "caches": 0, kind: 12}
    assert attack_files.main([*options(counts), "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and f"\n12 damaged {kind}" in f"\n{printed}"


def test_every_damage_is_one():
    content = random.Random(1).randbytes(50_000)
    seeds = map(random.Random, range(200))
    assert all(attack_files.damage(draw, content) != content for draw in seeds)


@pytest.mark.parametrize(
    ("kind", "count"),
    [("scenes", 4), ("results", 2), pytest.param("step", 4, marks=pytest.mark.long)],
)
def test_a_few_inputs_end_without_a_fault(kind, count, capsys):
    counts = {"scenes": 0, "results": 0, "step": 0, kind: count}
    assert attack_scenes.main([*options(counts), "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and f"\n{count} " in f"\n{printed}"
