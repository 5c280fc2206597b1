import numpy as np
import pytest

from exu_press.mechanism import GROUND
from exu_press.mechanism.shapes import transform_points
from exu_press.scene import mechanism_of
from exu_press.view import instants
from exu_press.view.joint_panel import CLEARANCE, JointPanel
from exu_press.view.mechanism_panel import poses


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


def test_the_journal_stands_at_its_eccentricity(runs, animation):
    result, shown = runs["press"], instants(runs["press"], frames=6)
    picture = animation(result, shown)
    for panel, name in zip(panels(picture, JointPanel), ("crank_pin", "ball_left"), strict=True):
        for frame in range(6):
            picture.show(frame)
            ratio = result[f"{name}_eccentricity"][shown.step[frame], :2] / 1e-4
            assert panel._journal.center == pytest.approx(CLEARANCE * ratio)


def test_no_impact_is_lost_between_frames(runs, animation):
    """The largest force of the run is shown, however few the frames are."""
    picture = animation(runs["press"], instants(runs["press"], frames=4))
    peak = np.linalg.norm(runs["press"]["ball_left_force"], axis=1).max()
    ball = panels(picture, JointPanel)[1]
    texts, lengths = [], []
    for frame in range(4):
        picture.show(frame)
        texts.append(ball._words.get_text())
        tail, tip = ball._arrow._posA_posB
        lengths.append(float(np.linalg.norm(np.subtract(tip, tail))))
    assert any(f"F = {peak / 1e3:.3g} kN" in text for text in texts)
    assert max(lengths) == pytest.approx(0.9, rel=1e-6)


def test_the_arrow_points_along_the_force(runs, animation):
    result, shown = runs["slider_crank"], instants(runs["slider_crank"], frames=9)
    picture = animation(result, shown)
    (panel,) = panels(picture, JointPanel)
    for frame in range(1, 9):
        picture.show(frame)
        since = shown.steps_since_last(frame)
        forces = result["crank_pin_force"][since]
        largest = forces[np.argmax(np.linalg.norm(forces, axis=1))]
        tail, tip = (np.array(end) for end in panel._arrow._posA_posB)
        if panel._arrow.get_visible():
            along = (tip - tail) / np.linalg.norm(tip - tail)
            assert along == pytest.approx(largest / np.linalg.norm(largest), abs=1e-6)
