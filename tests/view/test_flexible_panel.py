import numpy as np
import pytest

from exu_press.errors import InputError
from exu_press.view import Look, instants
from exu_press.view.flexible_panel import TIMES_SIGN, FlexiblePanel


def panel_of(animation):
    (panel,) = [panel for panel in animation.panels if isinstance(panel, FlexiblePanel)]
    return panel


def title_of(animation):
    (title,) = [
        t for t in (a.get_title("left") for a in animation.figure.axes) if "deformation" in t
    ]
    return title


def test_the_factor_is_stated_and_moves_the_nodes(runs, animation):
    result, shown = runs["flexible"], instants(runs["flexible"], frames=5)
    still, once, twice = (
        panel_of(animation(result, shown, Look(exaggerate=factor)))._corners("crank", 4)
        for factor in (0.0, 100.0, 200.0)
    )
    assert np.abs(once - still).max() > 0.0
    assert twice - still == pytest.approx(2.0 * (once - still), rel=1e-4, abs=1e-7)
    assert title_of(animation(result, shown, Look(exaggerate=200.0))).endswith(
        f"deformation {TIMES_SIGN} 200"
    )


@pytest.mark.parametrize(
    ("colour", "words"), [("displacement", "displacement, µm"), ("stress", "von Mises stress, MPa")]
)
def test_colours_reach_the_largest_value_of_the_animation(runs, animation, colour, words):
    result, shown = runs["flexible"], instants(runs["flexible"], frames=5)
    picture = animation(result, shown, Look(colour=colour))
    (bar,) = [axes for axes in picture.figure.axes if axes.get_xlabel() == words]
    largest = max(
        (1e-6 * surface.von_mises(q).max())
        if colour == "stress"
        else 1e6 * np.linalg.norm(surface.displacement(q), axis=1).max()
        for name, surface in result.surfaces.items()
        for q in result[f"{name}_modes"][shown.step]
    )
    assert bar.get_xlim() == pytest.approx((0.0, largest))


@pytest.mark.parametrize(
    ("look", "message"),
    [
        ({"colour": "red"}, "--colour red: allowed is one of displacement, stress"),
        ({"exaggerate": -1.0}, "--exaggerate -1"),
        ({"exaggerate": float("nan")}, "--exaggerate nan"),
    ],
)
def test_wrong_looks(look, message):
    with pytest.raises(InputError, match=message):
        Look(**look)
