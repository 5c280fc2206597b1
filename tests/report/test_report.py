import base64
import io
import re
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

from exu_press.cli import main
from exu_press.errors import InputError
from exu_press.quantities.reading import Reading
from exu_press.quantities.summary import run_warnings
from exu_press.report import Kind, find_output
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification.simulate import simulate

VOID = {"meta", "link", "img", "br", "input"}


class Page(HTMLParser):
    """What a page holds, and whether its tags match."""

    def __init__(self, text):
        super().__init__()
        self.open, self.images, self.headings, self.text, self.links = [], [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "img":
            self.images.append(attrs)
        self.links += [attrs[name] for name in ("src", "href") if name in attrs]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("script", "style"):
            return
        self.text.append(data)
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


@pytest.fixture(scope="module")
def parsed(pages):
    return {name: Page(path.read_text(encoding="utf-8")) for name, path in pages.items()}


@pytest.mark.parametrize("name", ["run", "compare", "stopped", "sweep"])
def test_pages_are_whole_and_load_nothing(parsed, name):
    page = parsed[name]
    assert page.open == []
    assert not re.search(r"\^[23]|\bu(m|rad)\b| \+- ", " ".join(page.text)), "units are typeset"
    assert all(link.startswith(("data:", "#part-")) for link in page.links)
    for image in page.images:
        data = base64.b64decode(image["src"].removeprefix("data:image/png;base64,"))
        with Image.open(io.BytesIO(data)) as picture:
            assert picture.width > 600
        assert len(image["alt"]) > 10


LAST = ["Provenance", "Scene", "Assumptions"]
FIRST = ["In motion", "Warnings", "Results", "Pictures"]


@pytest.mark.parametrize(
    ("name", "headings", "pictures"),
    [
        ("run", [*FIRST, "Energy and solver", *LAST], 6),
        ("compare", ["Differences of the scenes", *FIRST, *LAST], 3),
        ("sweep", ["Points", "Runs", "Warnings", "Pictures", *LAST], 1),
    ],
)
def test_what_a_report_has(parsed, name, headings, pictures):
    assert parsed[name].headings == headings
    assert len(parsed[name].images) == pictures


def test_a_run_shows_its_numbers_scene_and_assumptions(parsed, outputs):
    text = " ".join(parsed["run"].text)
    peak = Result.load(outputs["run"] / "run.nc").quantity("peak_acceleration.resolved").value
    shown = re.search(r"peak acceleration, m/s² (\S+) ± (\S+)", text)
    assert float(shown[1]) == pytest.approx(peak, abs=float(shown[2]))
    assert re.search(r"Read from revolutions \S+ to \S+\.", text) or "with the start." in text
    assert re.search(r"A-11\s+viscosity\s+film.viscosity = 0.4 Pa s", text)
    assert "counter-eccentric opposite the pin" in text
    assert "Newton iterations" in text


def test_an_early_stop_is_the_first_warning(parsed):
    text = " ".join(parsed["stopped"].text)
    assert re.search(r"Warnings\s+film broke down: film broke down at t = ", text)
    assert "film.viscosity = 0.4" not in text  # it was given
    assert "stroke: of the part that was run, without both dead centres." in text


def test_warnings_of_doubtful_runs(outputs):
    result = Result.load(outputs["run"] / "run.nc")
    given = result.scene.replace({"film.law": "finite"})
    assert run_warnings(Reading(replace(result, scene=given))) == []
    pin = result["crank_pin_eccentricity"]
    pin = pin * (0.99e-4 / np.linalg.norm(pin, axis=1).max())
    off = {"energy_input": result["energy_input"] + 1e6, "crank_pin_eccentricity": pin}
    energy, film = run_warnings(Reading(replace(result.with_values(off), scene=given)))
    assert re.search(r"the energy balance misses \S+ of the energy", energy)
    assert film.startswith("crank pin: eccentricity ratio up to 0.990")


def test_a_flywheel_is_no_part_of_the_solid_that_a_crank_is():
    """Its inertia is compared without."""
    result = simulate(
        Scene(joints={}, drive={"rated_torque": 400.0, "inertia": 50.0}, revolutions=0.005)
    )
    crank = result.scene.press
    arm = crank.crank_mass * crank.crank_radius**2 / 12
    solid = {"mass": crank.crank_mass, "inertia": arm, "centre_of_mass": [0.0, 0.0], "modes": 1}
    assert (
        run_warnings(Reading(replace(result, info={**result.info, "solids": {"crank": solid}})))
        == []
    )


def test_the_file_names_the_kind(outputs, tmp_path):
    assert find_output(outputs["compare"])[0] is Kind.COMPARISON
    assert find_output(outputs["sweep"])[0] is Kind.STUDY
    (tmp_path / "run.nc").touch()
    assert find_output(tmp_path) == (Kind.RUN, tmp_path / "run.nc")
    (tmp_path / "report.json").touch()
    with pytest.raises(InputError, match=r"has run\.nc and report\.json; name the file"):
        find_output(tmp_path)
    assert find_output(tmp_path, Kind.RUN) == (Kind.RUN, tmp_path / "run.nc")


@pytest.mark.parametrize(
    ("content", "path", "message"),
    [
        ({}, ".", "has none of run.nc, comparison.json, report.json"),
        ({}, "no.nc", "cannot be read"),
        ({"run.nc": "x"}, "run.nc", "not a result of exu_press"),
        ({"comparison.json": "{"}, ".", "not a comparison of exu_press"),
        ({"comparison.json": '{"a": {}}'}, ".", "run.nc: cannot be read"),
        ({"comparison.json": '["a"]'}, ".", "allowed is a table"),
        ({"comparison.json": "{}"}, ".", "it is empty"),
        ({"comparison.json": "[" * 100_000}, ".", "not a comparison of exu_press"),
        ({"comparison.json": '{"../a": 1}'}, ".", "'../a': allowed is the name of a variant"),
        ({"comparison.json": r'{"a\u0000": 1}'}, ".", r"'a\x00': allowed is the name of a variant"),
        ({"report.json": "{}"}, ".", "not a report of exu_press"),
        ({"report.json": ""}, ".", "the command that wrote it writes it anew"),
        ({"report.json": "[" * 100_000}, ".", "allowed is JSON"),
        ({"summary.json": "{}"}, "summary.json", "allowed is a result file"),
    ],
)
def test_wrong_input_is_status_2_in_one_line(tmp_path, capsys, content, path, message):
    for name, text in content.items():
        (tmp_path / name).write_text(text)
    assert main(["report", str(tmp_path / path)]) == 2
    told = capsys.readouterr().err
    assert message in told and told.count("\n") == 1
    assert not (tmp_path / "report.html").exists()


def test_where_it_is_written(outputs, tmp_path, capsys):
    target = tmp_path / "page.html"
    target.write_text("old")
    command = ["report", str(outputs["sweep"]), "--out", str(target)]
    assert main(command) == 0
    assert target.read_text().startswith("<!DOCTYPE html>")
    assert capsys.readouterr().out.startswith(f"written: {target} (")
    assert main([*command[:-1], str(tmp_path / "page.pdf")]) == 2
    assert main([*command[:-1], str(tmp_path / "no" / "page.html")]) == 2


@pytest.mark.parametrize("number", ["1" * 500, "1" * 5000, "-1e500", "nan", "inf"])
def test_a_number_that_is_none_is_refused_by_its_name(outputs, tmp_path, capsys, number):
    text = (outputs["sweep"] / "report.json").read_text()
    old = '"revolutions": 0.0'
    assert old in text
    other = number.replace("nan", "NaN").replace("inf", "Infinity")
    new = f'"revolutions": {other}, "x": 0.0'
    (tmp_path / "report.json").write_text(text.replace(old, new, 1))
    assert main(["report", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert "scene.revolutions = " in error and error.count("\n") == 1 and len(error) < 600


def test_without_the_library_the_page_has_pictures(outputs, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("exu_press.page.document.find_spec", lambda name: None)
    target = tmp_path / "sweep.html"
    assert main(["report", str(outputs["sweep"]), "--out", str(target)]) == 0
    text = target.read_text(encoding="utf-8")
    assert Page(text).images and "script" not in text.split("<body>")[1]
    assert "to zoom and play: pip install exu-press[page]" in capsys.readouterr().out
