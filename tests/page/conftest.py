import pytest

from exu_press import Scene, simulate
from exu_press.report import Kind, report_of


@pytest.fixture(scope="session")
def press():
    """Two revolutions of the shipped press."""
    scene = Scene.from_dict(
        {
            "mechanism": "press",
            "film": {"law": "finite"},
            "joints": {"crank_pin": "lubricated", "balls": "dry"},
            "revolutions": 2.0,
            "solver": {"tolerance": 1e-2},
        }
    )
    return simulate(scene)


def page_of(result, folder):
    """Return the page of a run, by way of its file."""
    result.save(folder / "run.nc")
    page = folder / "report.html"
    page.write_text(report_of(Kind.RUN, folder / "run.nc"), encoding="utf-8")
    return page


@pytest.fixture(scope="session")
def report(press, tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:  # tests/report looks at pictures
        patch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])
        return page_of(press, tmp_path_factory.mktemp("press"))
