"""Random scenes of the calibration are what users can write; each has its row."""

import json

import numpy as np
import pytest
from running import run

from calibration.scenes import groups_of, random_scene


def test_scenes_are_of_all_kinds():
    random = np.random.default_rng(3)
    found = {group for _ in range(200) for group in groups_of(random_scene(random, 0.35))}
    for kind in ("blanking", "table", "sheet", "spring"):
        assert f"load: {kind}" in found
    for kind in ("clearance", "elastic", "rubbing"):
        assert f"guides: {kind}" in found
    for law in ("none", "coulomb", "stribeck", "lugre_steady", "lugre"):
        assert f"friction: {law}" in found
    assert {"motor", "flexible", "steps: fixed", "joints: mixed", "joints: ideal"} <= found
    assert {"mechanism: own eccentric", "mechanism: own knuckle", "mechanism: six_bar"} <= found
    assert {"mechanism: own crank_rocker", "size: of a watch", "speed: below 30 rpm"} <= found
    assert {"joints: dry alone", "motor, load: blanking"} <= found


@pytest.mark.long
def test_a_study_goes_on_where_it_was_stopped(tmp_path):
    options = ["--seed", "5", "--out", "found"]
    run("calibrate_errors.py", tmp_path, "--scenes", "1", *options, quick=False)
    file = tmp_path / "found" / "seed_5.jsonl"
    (first,) = map(json.loads, file.read_text().splitlines())
    assert first["status"] == "completed" and first["figures"]
    table = run("calibrate_errors.py", tmp_path, "--scenes", "2", *options, quick=False)
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    assert rows[0] == first and len(rows) == 2
    assert "how they ended: completed (2)" in table
