"""The press at top dead centre as a drawing, with the lengths and masses of the paper's Table 2.

Run with: python scripts/draw_press.py [PICTURE.png]
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from exu_press.mechanism.press import Press, press

SIZE = Press()
MECHANISM = press(SIZE)
AT = {joint.name: joint.at for joint in MECHANISM.joints}
CLEARANCE = "crank_pin", "ball_right", "ball_left"
THIN = {"arrowstyle": "-", "color": "0.4", "lw": 0.7}
LABEL_X = 0.36  # m


def labels():
    """Text, the point that it belongs to, and how far to move the text up, m."""
    ball_x, ball_y = AT["ball_right"]

    def dimension(first, second):
        (x_0, y_0), (x_1, y_1) = AT[first], AT[second]
        return 0.5 * (x_0 + x_1), 0.5 * (y_0 + y_1)

    def text(name, length, mass):
        return f"{name}: {1e3 * length:g} mm, {mass:g} kg"

    return [
        (
            text(
                "linkage (11)",
                SIZE.counterweight.counter_linkage_length,
                SIZE.counterweight.counter_linkage_mass,
            ),
            dimension("counter_pin", "counterweight_pin"),
            0.04,
        ),
        (text("crank (2)", SIZE.crank_radius, SIZE.crank_mass), (0.0, 0.015), 0.07),
        (
            f"counter-eccentric: {1e3 * SIZE.counterweight.counter_eccentricity:g} mm (assumed)",
            AT["counter_pin"],
            0.02,
        ),
        (
            text("linkage (3)", SIZE.linkage_length, SIZE.linkage_mass),
            dimension("crank_pin", "slide_pin"),
            0.02,
        ),
        (f"slide (4): {SIZE.slide_mass:g} kg (assumed)", AT["slide_pin"], 0.06),
        (
            text("link (6)", SIZE.link_6_length, SIZE.link_6_mass),
            dimension("pivot_right", "knuckle_6_right"),
            0.02,
        ),
        (
            text("link (5)", SIZE.link_5_length, SIZE.link_5_mass),
            dimension("slide_joint_right", "knuckle_6_right"),
            -0.05,
        ),
        (
            text("link (7)", SIZE.link_7_length, SIZE.link_7_mass),
            dimension("knuckle_7_right", "plunger_pin_right"),
            -0.05,
        ),
        (text("plunger (8)", SIZE.plunger_length, SIZE.plunger_mass), (ball_x, ball_y + 0.25), 0.0),
    ]


def block(axes, name, mass, centre, width, height):
    """Draw a block with its name and mass in it."""
    x, y = centre
    axes.add_patch(plt.Rectangle((x - width / 2, y - height / 2), width, height, color="0.87"))
    axes.text(x, y, f"{name}\n{mass:g} kg", ha="center", va="center", fontsize=9)


def main(path):
    """Draw bodies as lines through their joints, and label the right half."""
    figure, axes = plt.subplots(figsize=(7.2, 9.0))
    _, ball_y = AT["ball_right"]
    block(axes, "main slider (10)", SIZE.slider_mass, (0.0, ball_y - 0.07), 0.5, 0.14)
    _, weight_y = AT["counterweight_pin"]
    block(
        axes,
        "counterweight (12)",
        SIZE.counterweight.counterweight_mass,
        (0.0, weight_y + 0.065),
        0.5,
        0.13,
    )
    for body in MECHANISM.bodies:
        ends = sorted(
            {joint.at for joint in MECHANISM.joints if body.name in (joint.journal, joint.bearing)}
        )
        if body.name in ("slider", "slide", "counterweight") or len(ends) < 2:
            continue
        thick = 9 if body.name.startswith("plunger") else 4
        axes.plot(*zip(*ends, strict=True), lw=thick, color="0.65", zorder=1)
    for name, (x, y) in AT.items():
        size, colour = (9, "tab:red") if name in CLEARANCE else (6, "black")
        axes.plot(x, y, "o", ms=size, color=colour, zorder=4 if name in CLEARANCE else 3)
    for text, point, up in labels():
        axes.annotate(text, point, (LABEL_X, point[1] + up), va="center", arrowprops=THIN)
    red = {**THIN, "color": "tab:red"}
    for text, name, up in (
        ("crank pin:\nclearance", "crank_pin", 0.05),
        ("balls (9):\nclearance", "ball_left", 0.12),
    ):
        x, y = AT[name]
        position = (-LABEL_X, y + up)
        axes.annotate(text, (x, y), position, ha="center", color="tab:red", arrowprops=red)
    pivot_x, pivot_y = AT["pivot_right"]
    across = {"arrowstyle": "<->", "color": "0.4", "lw": 0.7}
    high = pivot_y + 0.05
    axes.annotate("", (-pivot_x, high), (0.0, high), arrowprops=across)
    axes.annotate(
        f"{1e3 * SIZE.pivot_distance:g} mm\n(assumed)",
        (-pivot_x, high),
        (-LABEL_X, high + 0.02),
        ha="center",
        va="center",
        arrowprops=THIN,
    )
    axes.set_aspect("equal")
    axes.set_xlim(-0.45, 0.78)
    axes.axis("off")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, bbox_inches="tight")
    print(path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture", nargs="?", type=Path, default="out/press_drawing.png")
    main(parser.parse_args().picture)
