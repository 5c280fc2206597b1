"""How many modes and how fine a mesh a scene's flexible bodies need, and which modes do the work.

Prints, for each flexible body, the share that each mode has in how its joints give way under a
force or moment of the plane, its own inertia balancing that, and in what rotation asks for; then
peak acceleration, deflections and stresses over modes and over mesh sizes. Draws them against the
finest. A run that takes its modes by flexibility error stands among those with numbers of modes.
Run with: python scripts/flexible_convergence.py [SCENE.toml] [--quick] [--out DIR]
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from exu_press import Scene, simulate
from exu_press.model.placement import placed_parts
from exu_press.model.solids import IN_THE_PLANE
from exu_press.plots.file import save_figure
from exu_press.plots.palette import COLOURS
from exu_press.plots.style import look
from exu_press.scene import flexible_press
from exu_press.terminal.columns import columns

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("scene", nargs="?", help="with flexible bodies; the shipped press unless given")
parser.add_argument("--quick", action="store_true", help="few and coarse")
parser.add_argument("--out", default="out/convergence", type=Path)
options = parser.parse_args()
MODES = (2, 4) if options.quick else (4, 8, 13, 20, 40)
SIZES = (0.1, 0.08) if options.quick else (0.06, 0.045, 0.03)  # m
ERROR = 0.01
MOST_SHOWN = 8
UNITS = {"m/s^2": (1.0, "m/s^2"), "m": (1e6, "um"), "rad": (1e6, "urad"), "Pa": (1e-6, "MPa")}

if options.scene:
    scene = Scene.load(options.scene)
else:
    scene = Scene(bodies=flexible_press(), revolutions=0.1)
if options.quick:
    scene = scene.replace({"revolutions": 0.005})


def with_bodies(**keys):
    """Return the scene with these keys of every flexible body."""
    return scene.replace(
        {f"bodies.{name}.{key}": value for name in scene.bodies for key, value in keys.items()}
    )


def participation(name, part):
    """Print the shares of the modes that have the largest ones."""
    rows = [
        (f"{face} {motion}", share)
        for (face, motion), share in zip(part.meta["motions"], part.participation(), strict=True)
        if motion in IN_THE_PLANE
    ]
    spun = part.couplings["mXRefTildePsiTilde"][2, 2::3] / (2.0 * np.pi * part.frequencies)
    rows.append(("rotation", spun**2 / (spun**2).sum()))
    shares = np.array([share for _, share in rows])
    best = np.sort(np.argsort(-shares.max(axis=0), kind="stable")[:MOST_SHOWN])
    table = [(f"{name}, %", *(f"{part.frequencies[i]:.0f} Hz" for i in best), "others", "left out")]
    for label, share in rows:
        others = share.sum() - share[best].sum()
        cells = [*share[best], others, max(0.0, 1.0 - share.sum())]
        table.append((label, *(f"{100 * value:.1f}" for value in cells)))
    print("\n".join([*columns(table), ""]))


def figures(result):
    """Return name -> (value, unit) of what is to converge."""
    found = {"peak acceleration": (np.abs(result["slider_acceleration"]).max(), "m/s^2")}
    for name in result:
        if name.endswith(("_deflection", "_elongation", "_bending")):
            channel = result[name].reshape(len(result.time), -1)
            unit = "rad" if name.endswith("_bending") else "m"
            found[name] = np.linalg.norm(channel, axis=1).max(), unit
    for body, stress in result.info["stress"].items():
        found[f"{body} stress"] = stress["von_mises"], "Pa"
    return found


def converge(label, cases):
    """Run the cases and print their figures; return them, (cases, figures), and the names."""
    rows, names = [], []
    for changed in cases.values():
        found = figures(simulate(changed))
        names = [f"{n.replace('_', ' ')}, {UNITS[unit][1]}" for n, (_, unit) in found.items()]
        rows.append([value * UNITS[unit][0] for value, unit in found.values()])
    table = [(label, *names)]
    table += [
        (case, *(f"{value:.4g}" for value in row)) for case, row in zip(cases, rows, strict=True)
    ]
    print("\n".join([*columns(table), ""]))
    return np.array(rows), names


def panel(axes, heading, x, values, names):
    """Draw the distance of all figures from the last."""
    away = np.abs(values[:-1] / values[-1] - 1.0)
    markers = "osD^vP*X"
    colours = list(COLOURS.values())
    for i, name in enumerate(names):
        style = {"color": colours[i % len(colours)], "marker": markers[i % len(markers)]}
        axes.plot(x[:-1], 100.0 * np.maximum(away[:, i], 1e-5), label=name.split(",")[0], **style)
    axes.set(yscale="log", ylabel="away from the last, %", title=heading, xticks=list(x[:-1]))
    axes.margins(x=0.06)


for body, placed in placed_parts(with_bodies(modes=4 if options.quick else 20)).items():
    participation(body, placed.reduced)
by_modes = {str(n): with_bodies(modes=n) for n in MODES}
by_error = {f"error {ERROR:g}": with_bodies(flexibility_error=ERROR)}
values, names = converge("modes", {**by_error, **by_modes})
sizes = {f"{1e3 * size:g} mm": with_bodies(mesh_size=size) for size in SIZES}
meshed, _ = converge("mesh size", sizes)

with look():
    figure = Figure(figsize=(10.5, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    panel(left, "Over the number of modes", MODES, values[1:], names)
    panel(right, "Over the mesh size", 1e3 * np.array(SIZES), meshed, names)
    left.set(xlabel="modes of each body")
    right.set(xlabel="mesh size, mm", ylabel="")
    right.invert_xaxis()
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    figure.suptitle(f"How flexible bodies converge: {', '.join(scene.bodies)}", x=0.01, ha="left")
    options.out.mkdir(parents=True, exist_ok=True)
    figure.draw_without_rendering()  # lays it out
    print("written:", save_figure(figure, options.out / "convergence.png"))
