import pytest
from matplotlib.figure import Figure
from PIL import Image

from exu_press.errors import InputError
from exu_press.files.output_directory import PICTURES
from exu_press.plots import save_comparison, save_pictures
from exu_press.plots.file import save_figure

EVERY = [f"{name}.png" for name in PICTURES["run"]]


def assert_pictures(paths):
    for path in paths:
        with Image.open(path) as image:
            assert image.format == "PNG"
            assert image.width == 1950  # 13 inch at 150 dpi
            assert image.info["dpi"] == pytest.approx((150, 150), abs=0.1)
        assert 15e3 < path.stat().st_size < 400e3


@pytest.mark.parametrize("label", ["ideal", "stopped at once"])
def test_pictures_of_a_run(results, label, tmp_path):
    paths = save_pictures(results[label], tmp_path)
    wanted = [name for name in EVERY if label != "ideal" or name != "orbit.png"]
    assert [path.name for path in paths] == wanted
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(wanted)
    assert_pictures(paths)


def test_pictures_of_a_comparison(results, tmp_path):
    paths = save_comparison({name: results[name] for name in ("ideal", "dry")}, tmp_path)
    assert [path.name for path in paths] == [f"{name}.png" for name in PICTURES["compare"]]
    assert_pictures(paths)


def test_a_directory_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        save_figure(Figure(), tmp_path / "missing" / "force.png")
