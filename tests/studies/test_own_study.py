"""A study of a user's own: one module, known to the command by an entry point."""

import site
import sys

import pytest

from exu_press import InputError
from exu_press.cli import main
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.registry import study_command

MODULE = '''
"""The speed at which a quantity reaches a value."""

from dataclasses import dataclass
from types import MappingProxyType

from exu_press.schema.table import Table as Keys
from exu_press.schema.checks import key
from exu_press.studies.base import Runs, Study
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.report import Points, Report, Table, quantity_column

PEAK = "peak_velocity"


@dataclass(frozen=True)
class Target(Keys):
    """The table [limit_speed]."""

    table = "limit_speed"
    required = ("peak_velocity",)

    peak_velocity: float = key(None, "largest velocity of the slider", "m/s", above=0)


@dataclass(frozen=True)
class LimitSpeed(Study):
    """A file with one range."""

    plain_runs = False
    tables = MappingProxyType({"limit_speed": Target})

    limit_speed: Target = None


@dataclass(frozen=True)
class LimitReport(Report):
    """Speeds and their peaks."""

    name = "limit_speed"
    files = ("limit_speed.json",)

    study: LimitSpeed
    speeds: list
    peaks: list

    @property
    def title(self):
        return "Limit speed"

    @property
    def scene(self):
        return self.study.scene

    def tables(self):
        rows = [(f"{v:.1f}", f"{p:.4f}") for v, p in zip(self.speeds, self.peaks)]
        return [Table("Speeds", ("speed_rpm", "peak_velocity, m/s"), rows, of_points=True)]

    def points(self):
        labels = [f"exu-press run SCENE.toml --set speed_rpm={v}" for v in self.speeds]
        columns = [quantity_column("speed_rpm", self.speeds)], [quantity_column(PEAK, self.peaks)]
        return Points(*columns, labels)

    def to_dict(self):
        return {"speed_rpm": self.speeds[-1], "peak_velocity": self.peaks[-1]}


class LimitSpeedCommand(StudyCommand):
    """`exu-press limit-speed`."""

    example = "exu-press limit-speed speed.toml"
    study = LimitSpeed

    @staticmethod
    def run(study, directory, **how):
        low, high = study.keys["speed_rpm"].ends
        speeds, peaks = [], []
        with Runs(study, directory, report=LimitReport, **how) as runs:
            for _ in range(8):
                speeds.append(0.5 * (low + high))
                (row,) = runs.run_scenes([study.scene_at({"speed_rpm": speeds[-1]})])
                peaks.append(row[PEAK])
                below = peaks[-1] < study.limit_speed.peak_velocity
                low, high = (speeds[-1], high) if below else (low, speeds[-1])
        report = LimitReport(study, speeds, peaks)
        report.save(directory)
        return report
'''

STUDY = """
[scene]
mechanism = "slider_crank"
joints = {}
revolutions = 1.0
[keys]
speed_rpm = {low = 100.0, high = 300.0}
[limit_speed]
peak_velocity = 0.5
"""


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """A distribution with the study, in a folder of this interpreter's packages."""
    folder = tmp_path / "site-packages"
    info = folder / "limit_speed-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: limit_speed\nVersion: 1.0\n")
    entry = "[exu_press.studies]\nlimit-speed = limit_speed_study:LimitSpeedCommand\n"
    (info / "entry_points.txt").write_text(entry)
    (folder / "limit_speed_study.py").write_text(MODULE)
    monkeypatch.setattr(site, "getsitepackages", lambda: [str(folder)])
    monkeypatch.setattr(site, "ENABLE_USER_SITE", False)
    monkeypatch.syspath_prepend(folder)
    yield folder
    sys.modules.pop("limit_speed_study", None)


def test_an_installed_study_is_a_command_with_a_table_a_file_and_a_page(
    installed, tmp_path, capsys
):
    (tmp_path / "speed.toml").write_text(STUDY)
    out = tmp_path / "out"
    command = ["limit-speed", str(tmp_path / "speed.toml"), "--workers", "1", "--out", str(out)]
    assert main(command) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].split() == ["speed_rpm", "peak_velocity,", "m/s"]
    assert printed[-1] == f"written: limit_speed.json in {out}"
    lines = (out / "runs.jsonl").read_text()
    assert main([*command, "--quiet"]) == 0
    assert (out / "runs.jsonl").read_text() == lines  # nothing is run again
    # the page is of the files alone
    (installed / "limit_speed_study.py").unlink()
    sys.modules.pop("limit_speed_study")
    assert main(["report", str(out), "--quiet"]) == 0
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "<h2>Speeds</h2>" in page and "exu-press run SCENE.toml --set speed_rpm=200.0" in page


def test_what_is_registered_is_a_study_command(installed, capsys):
    assert issubclass(study_command("limit-speed"), StudyCommand)
    (installed / "limit_speed_study.py").write_text("LimitSpeedCommand = int\n")
    sys.modules.pop("limit_speed_study")
    with pytest.raises(
        InputError, match=r"limit-speed', registered by limit_speed: .* is no class"
    ):
        study_command("limit-speed")


def test_an_unknown_command_names_the_known_ones(capsys):
    with pytest.raises(SystemExit):
        main(["sweeep"])
    assert "sweep" in capsys.readouterr().err
