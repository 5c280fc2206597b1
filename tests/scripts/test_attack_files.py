"""A few damages of the campaign; all of them by `python scripts/attack_files.py`."""

import random

import pytest

from attack_files import damaged, main


@pytest.mark.parametrize("kind", ["results", "blocks", "caches"])
def test_a_few_damages_are_refused_or_nothing(kind, capsys, monkeypatch):
    monkeypatch.setattr("exu_press.result.run.BLOCK", 10.0)  # which the campaign shortens
    counts = {"results": 0, "blocks": 0, "caches": 0, kind: 20}
    options = [word for name, count in counts.items() for word in (f"--{name}", str(count))]
    assert main([*options, "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and f"\n20 damaged {kind}" in f"\n{printed}"


def test_every_damage_is_one():
    content = random.Random(1).randbytes(50_000)
    assert all(damaged(random.Random(seed), content) != content for seed in range(200))
