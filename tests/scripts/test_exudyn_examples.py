"""The campaign on Exudyn's own scripts, with three scripts of a few lines."""

import json

import pytest
from running import run

SYSTEM = """
import exudyn as exu
from exudyn.utilities import *

mbs = exu.SystemContainer().AddSystem()
node = mbs.AddNode(Node1D(referenceCoordinates=[0.0], initialCoordinates=[1.0]))
mbs.AddObject(ObjectMass1D(nodeNumber=node, mass=1.0))
ground = mbs.AddNode(NodePointGround())
markers = [mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=n, coordinate=0)) for n in (ground, node)]
mbs.AddObject(ObjectConnectorCoordinateSpringDamper(markerNumbers=markers, stiffness=100.0))
mbs.AddSensor(SensorNode(nodeNumber=node, storeInternal=True,
                         outputVariableType=exu.OutputVariableType.Coordinates_t))
mbs.Assemble()
settings = exu.SimulationSettings()
settings.timeIntegration.endTime = 2.0
settings.timeIntegration.numberOfSteps = 400
"""


@pytest.mark.long
def test_rows_and_totals(tmp_path):
    scripts = {
        "oscillator": SYSTEM + "mbs.SolveDynamic(settings)\n",
        "explicit": SYSTEM + "mbs.SolveDynamic(settings, exu.DynamicSolverType.RK44)\n",
        "nothing": "# SolveDynamic\n",
    }
    for name, text in scripts.items():
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    printed = run("exudyn_examples.py", tmp_path, ".", "--out", "rows", quick=False)
    assert "3 scripts: 1 refused, 1 no dynamic solution, 1 completed" in printed
    assert "within one tolerance 1 of 1" in printed
    assert "wrong in silence 0 of 1" in printed
    (file,) = (tmp_path / "rows").glob("*_oscillator.json")
    row = json.loads(file.read_text(encoding="utf-8"))
    assert row["missed"] <= row["stated"] <= 1e-3 and row["sufficient"] <= row["steps"]
    kept = file.stat().st_mtime_ns
    assert printed == run("exudyn_examples.py", tmp_path, ".", "--out", "rows", quick=False)
    assert file.stat().st_mtime_ns == kept
