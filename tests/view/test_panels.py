"""Instants of an animation, and what its panels show at them."""

import numpy as np
import pytest
from matplotlib.text import Text

from exu_press.errors import InputError
from exu_press.mechanism import GROUND
from exu_press.mechanism.shapes import transform_points
from exu_press.scene import mechanism_of
from exu_press.view import Look, instants, moment
from exu_press.view.flexible_panel import TIMES_SIGN, FlexiblePanel
from exu_press.view.joint_panel import CLEARANCE, JointPanel
from exu_press.view.mechanism_panel import MechanismPanel, poses


def panels(animation, kind):
    return [panel for panel in animation.panels if isinstance(panel, kind)]


@pytest.mark.parametrize("name", ["press", "slider_crank", "ideal", "flexible"])
def test_links_are_drawn_joined(runs, name):
    """Ideal joints meet; those with clearance are apart by their eccentricity."""
    result, shown = runs[name], instants(runs[name], frames=5)
    mechanism = mechanism_of(result.scene)
    where = poses(result, mechanism, shown) | {GROUND: np.zeros((5, 3))}
    for joint in mechanism.joints:
        for frame, now in enumerate(shown.time):
            journal, bearing = (
                transform_points(np.array([point]), where[body][frame])[0]
                for body, point in mechanism.ends(joint)
            )
            apart = np.zeros(2)
            if joint.name in result.clearance_joints:
                path = result[f"{joint.name}_eccentricity"]
                apart = [np.interp(now, result.time, path[:, k]) for k in (0, 1)]
            allowed = 2e-4 if name == "flexible" else 4e-6  # deflection; between steps
            assert journal - bearing == pytest.approx(apart, abs=allowed), joint.name


def test_dead_centres_are_drawn_in_front_of_bodies_on_which_they_may_lie(runs, animation):
    (panel,) = panels(animation(runs["press"], instants(runs["press"], frames=2)), MechanismPanel)
    in_front = [text.get_text() for text in panel.artists[-4:] if isinstance(text, Text)]
    assert in_front == ["TDC", "BDC"]


def test_journals_and_arrows_are_those_of_the_run_and_no_impact_is_lost(runs, animation):
    """The arrow is the largest force since the last frame, however few the frames are."""
    result, shown = runs["press"], instants(runs["press"], frames=6)
    picture = animation(result, shown)
    texts, lengths = [], []
    for frame in range(6):
        picture.show(frame)
        for panel, name in zip(
            panels(picture, JointPanel), ("crank_pin", "ball_left"), strict=True
        ):
            ratio = result[f"{name}_eccentricity"][shown.step[frame], :2] / 1e-4
            assert panel._journal.center == pytest.approx(CLEARANCE * ratio)
            forces = result[f"{name}_force"][shown.steps_since_last(frame)][:, :2]
            largest = forces[np.argmax(np.linalg.norm(forces, axis=1))]
            tail, tip = (np.array(end) for end in panel._arrow._posA_posB)
            length = float(np.linalg.norm(tip - tail))
            if frame and panel._arrow.get_visible():
                along = largest / np.linalg.norm(largest)
                assert (tip - tail) / length == pytest.approx(along, abs=1e-6)
        texts.append(panel._words.get_text())
        lengths.append(length)
    peak = np.linalg.norm(result["ball_left_force"], axis=1).max()
    assert any(f"F = {peak / 1e3:.3g} kN" in text for text in texts)
    assert max(lengths) == pytest.approx(0.9, rel=1e-6)


def test_every_step_is_seen_exactly_once(runs):
    """An impact between two frames is not lost; unless asked, a revolution takes five seconds."""
    shown = instants(runs["press"])
    assert len(shown) == 1 + round(0.3 * 5 * 25)
    assert shown.slow == pytest.approx(20.0, rel=1.0 / len(shown))  # a whole number of frames
    assert np.ptp(np.diff(shown.time)) < 1e-12
    time = runs["press"].time
    shown = instants(runs["press"], frames=7)
    steps = [s for f in range(len(shown)) for s in range(len(time))[shown.steps_since_last(f)]]
    assert steps == list(range(len(time)))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"start": -1.0}, "--from -1: the record goes from 0 to 0.075 s"),
        ({"start": 0.02, "stop": 0.01}, "--from 0.02 --to 0.01"),
        ({"fps": 0.0}, "--fps 0: allowed is 1 to 120"),
        ({"slow": -2.0}, "--slow -2: allowed is a number > 0"),
        ({"slow": 2.0, "frames": 3}, "allowed is one of the two"),
        ({"slow": 1e30}, "frames: allowed is 2 to"),
        ({"slow": float("nan")}, "--slow nan"),
        ({"start": float("nan")}, "--from nan"),
    ],
)
def test_wrong_options(runs, options, message):
    with pytest.raises(InputError, match=message):
        instants(runs["press"], **options)
    with pytest.raises(InputError, match=r"--at 3: allowed is 0 to 0\.075 s"):
        moment(runs["press"], 3.0)


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
    pose = result["body_position"][shown.step[4], result.bodies.index("crank")]
    outline = transform_points(result.surfaces["crank"].nodes[:, :2], pose)
    world = still @ panel_of(animation(result, shown))._view
    assert world[:, :2] == pytest.approx(outline, abs=1e-12)
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
