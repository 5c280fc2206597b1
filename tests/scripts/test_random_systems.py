"""Systems by chance: each kind is one that Exudyn builds, and ends with a tolerance."""

import runpy
import sys

import exudyn as exu
import pytest
from running import run

from exu_press import SolverStatus, solve_dynamic
from random_systems import KINDS, main


@pytest.mark.filterwarnings("ignore:settings.timeIntegration")
@pytest.mark.parametrize("number", range(len(KINDS)), ids=[kind.__name__ for kind in KINDS])
@pytest.mark.parametrize("part", [1.0, 1e-4])
def test_each_kind_ends(number, part, tmp_path, monkeypatch, capsys):
    outcomes = []

    def instead(mbs, settings):
        settings.solution.file.write = False
        outcomes.append(solve_dynamic(mbs, settings, tolerance=1e-2))

    monkeypatch.setattr(exu.MainSystem, "SolveDynamic", instead)
    words = [str(tmp_path), "--seeds", "17", "--part", str(part)]
    monkeypatch.setattr(sys, "argv", ["random_systems.py", *words])
    monkeypatch.setattr(sys, "path", [*sys.path])
    main()
    assert capsys.readouterr().out.startswith("17 scripts in")
    (script,) = tmp_path.rglob(f"*_{number:03d}.py")
    runpy.run_path(str(script))
    assert outcomes[0].status is SolverStatus.COMPLETED


def test_stated_errors_of_sensors_are_compared_with_true_ones(tmp_path):
    told = run("sensor_errors.py", tmp_path, "--seeds", "342", "344", quick=False)
    counts = [line.split() for line in told.splitlines()[1:]]
    assert [words[0] for words in counts] == ["worst", "peak:"]
    assert all(0 < int(words[-7]) <= int(words[-5]) for words in counts)
