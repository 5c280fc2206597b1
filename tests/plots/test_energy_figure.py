import pytest

from exu_press.plots import energy_figure

LABELS = ["dry", "lubricated", "slider_crank", "stopped"]


@pytest.mark.parametrize(
    "label",
    [
        pytest.param(n, marks=[pytest.mark.long] * (n not in ("dry", "slider_crank")))
        for n in LABELS
    ],
)
def test_balance_losses_and_residual_with_units(results, label):
    panels = {axes.get_title("left"): axes for axes in energy_figure(results[label]).axes}
    assert set(panels) == {"Balance", "Dissipated in", "Residual"}
    assert all(axes.get_ylabel().endswith(("J", "mJ")) for axes in panels.values())
    names = [text.get_text() for text in panels["Dissipated in"].get_legend().get_texts()]
    assert names == ["crank pin"] + ["ball, each side"] * (label != "slider_crank")


def test_ideal_joints_dissipate_nothing(results):
    titles = {axes.get_title("left") for axes in energy_figure(results["ideal"]).axes}
    assert titles == {"Balance", "Residual"}


def test_the_legend_of_the_losses_lies_above_their_curves(results):
    """Also where a joint loses most at once, as a start does."""
    figure = energy_figure(results["dry"])
    panel = {axes.get_title("left"): axes for axes in figure.axes}["Dissipated in"]
    figure.draw_without_rendering()
    legend = panel.get_legend().get_window_extent().transformed(panel.transData.inverted())
    assert legend.y0 > max(
        results["dry"][name].max() for name in ("crank_pin_loss", "ball_left_loss")
    )
