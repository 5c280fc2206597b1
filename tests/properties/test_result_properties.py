"""Result files with anything in them changed: a result, or one line that says what is wrong."""

import copy
import json
import struct
import time
from contextlib import suppress

import pytest
from coarse_parts import COARSE
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from stored_results import rewritten, text_of

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main

SCENES = {
    "dry": {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}, "revolutions": 0.02},
    "press": {
        "guide": {"lateral_stiffness": 1e9},
        "load": {"blanking": {"kind": "blanking", "force": 1e4}},
        "revolutions": 0.005,
    },
    "flexible": {"bodies": COARSE, "revolutions": 0.002},
}
HOSTILE = r"$\frac{$ <script>alert(1)</script>"

values = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from([HOSTILE, "\ud800", "\x1b[31m", "a" * 10_000]),
    st.lists(st.integers(), max_size=2),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
)
numbers = st.sampled_from([0.0, -1.0, 1.0, 1e-300, 1e20, 1e90, -1e99, 1e300, float("nan")])


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    for name, scene in SCENES.items():
        simulate(Scene(**scene)).save(folder / name)
    return folder


def places(data, path=()):
    """Return the paths of everything in nested JSON."""
    inner = data.items() if isinstance(data, dict) else enumerate(data)
    found = [path]
    for name, value in inner:
        nested = isinstance(value, (dict, list))
        found += places(value, (*path, name)) if nested else [(*path, name)]
    return found


def other_json(draw, data):
    """Return JSON with one thing in it changed or missing."""
    data = copy.deepcopy(data)
    *path, last = draw(st.sampled_from(places(data)[1:]))
    place = data
    for name in path:
        place = place[name]
    if draw(st.booleans()):
        place[last] = draw(values)
    else:
        del place[last]
    return data


def other_text(draw, content):
    """Return a file in which one of the texts about the whole is another one."""
    name = draw(st.sampled_from(["scene", "info", "info", "bodies"]))
    return rewritten(content, {name: json.dumps(other_json(draw, text_of(content, name)))})


def other_bytes(draw, content):
    """Return a file with some bytes changed: in the header or anywhere."""
    place = draw(st.integers(0, len(content) - 1) | st.integers(0, 8000))
    new = draw(st.binary(min_size=1, max_size=8))
    return content[:place] + new + content[place + len(new) :]


def other_numbers(draw, content):
    """Return a file with some eight bytes, mostly one value, replaced by another number."""
    place = 8 * draw(st.integers(1000, len(content) // 8 - 1)) + draw(st.sampled_from([0, 4]))
    count = draw(st.sampled_from([1, 1, 10]))
    return content[:place] + count * struct.pack(">d", draw(numbers)) + content[place + 8 * count :]


def mutated(draw, files):
    """Return the content of a file after one change."""
    how = draw(st.sampled_from([other_text, other_text, other_bytes, other_numbers]))
    content = how(draw, (files / draw(st.sampled_from(sorted(SCENES)))).read_bytes())
    with suppress(Exception):  # checksums of what SciPy cannot read stay wrong
        return rewritten(content) if draw(st.booleans()) else content
    return content


def shown_or_refused(command, content, folder, capsys):
    path, target = folder / "run.nc", folder / ("x.png" if command == "view" else "x.html")
    path.write_bytes(content)
    option = "--save" if command == "view" else "--out"
    start = time.process_time()
    status = main([command, str(path), "--quiet", option, str(target)])
    assert time.process_time() - start < 60.0
    told = capsys.readouterr().err
    if status == 2:
        assert told.startswith(f"exu-press: {path}: ") or "--from" in told
        assert told.count("\n") == 1 and told.strip().isprintable() and len(told) < 1000
    else:
        assert (status, told) == (0, "")
        assert command == "view" or "<script>alert" not in target.read_text(encoding="utf-8")


RUNS = {"deadline": None, "suppress_health_check": list(HealthCheck), "print_blob": True}


@settings(max_examples=10, phases=[Phase.generate], **RUNS)
@given(data=st.data())
def test_a_mutated_file_is_a_result_or_an_input_error(data, files, tmp_path):
    """What it says of itself has been checked then: its summary is made, in strict JSON."""
    path = tmp_path / "run.nc"
    path.write_bytes(mutated(data.draw, files))
    try:
        result = Result.load(path)
    except InputError as error:
        told = str(error)
        assert told.startswith(f"{path}: ") and told.isprintable() and len(told) < 700
        return
    json.dumps(result.summary(), allow_nan=False)


@pytest.mark.long
@settings(max_examples=4, phases=[Phase.generate], **RUNS)
@given(data=st.data(), command=st.sampled_from(["view", "report"]))
def test_a_mutated_file_is_shown_or_refused(data, command, files, tmp_path, capsys):
    shown_or_refused(command, mutated(data.draw, files), tmp_path, capsys)
