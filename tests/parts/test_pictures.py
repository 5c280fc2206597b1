from pathlib import Path

from matplotlib.image import imread

from fe_models import draw_mode_shapes


def test_picture_is_drawn_and_coloured(bar, tmp_path: Path):
    file = tmp_path / "bar.png"
    draw_mode_shapes(bar, file, modes=(2, 5))
    picture = imread(file)[:, :, :3]
    assert picture.shape[1] > 1000
    coloured = (picture.max(axis=2) - picture.min(axis=2)) > 0.3
    assert coloured.mean() > 0.02
