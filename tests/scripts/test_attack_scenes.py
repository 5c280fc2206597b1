"""A few attacks of the campaign; all of them by `python scripts/attack_scenes.py`."""

import pytest

from attack_scenes import main


@pytest.mark.parametrize(
    "kind", ["scenes", "results", pytest.param("step", marks=pytest.mark.long)]
)
def test_a_few_inputs_end_without_a_fault(kind, capsys):
    counts = {"scenes": 0, "results": 0, "step": 0, kind: 4}
    options = [word for name, count in counts.items() for word in (f"--{name}", str(count))]
    assert main([*options, "--seed", "7000"]) == 0
    printed = capsys.readouterr().out
    assert "FAULT" not in printed and "\n4 " in f"\n{printed}"
