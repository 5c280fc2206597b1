"""Errors, classes and speeds of the models."""

import itertools
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from exudyn_examples.measure import at_equal_error

__all__ = ["Model", "table"]

ENDED = "completed", "under-resolved"
CLEAR = 0.1
"""Difference of two references over an error, up to which they tell whether it is covered."""

SIZES = 0, 20, 60, 200
"""Numbers of unknowns between which times of steps are compared."""

AGREE = 3e-3
"""Of two references, up to which an error is counted."""

CLASSES = (
    "within one tolerance",
    "within ten tolerances",
    "within the references' own error",
    "within a hundred tolerances",
    "more than a hundred tolerances off",
    "stopped",
    "refused",
    "cut off at the time limit",
    "crashed",
    "no figure, as the references disagree",
)


def error(one, fine):
    """Return the largest error of any body's velocity, or of a first-order coordinate."""
    rows, exact = one["rows"], fine["rows"]
    if "weight" not in fine or rows.shape != exact.shape or not len(rows):
        return np.nan
    weight, body = fine["weight"], fine["body"]
    size = len(weight)
    missed, moved = rows - exact, np.vstack([exact, fine["fastest"]])
    found = 0.0
    owned = ~np.isnan(weight)
    if owned.any():
        square = np.where(owned, weight, 0.0) ** 2
        parts = np.unique(body, return_index=True)[1]
        norms = [
            np.add.reduceat(square * part[:, :size] ** 2, parts, axis=1) for part in (missed, moved)
        ]
        scale = norms[1].max()
        found = np.sqrt(norms[0].max() / scale) if scale > 0.0 else 0.0
    for i in (*np.flatnonzero(~owned), *range(size, rows.shape[1])):
        scale = np.abs(moved[:, i]).max()
        if scale > 0.0:
            found = max(found, np.abs(missed[:, i]).max() / scale)
    return float(found)


@dataclass
class Model:
    """A script and its runs."""

    name: str
    user: dict
    fine: list | None
    runs: dict
    coarse: list = field(default_factory=list)

    @property
    def own(self):
        """Return the references' own error; nan where there is none."""
        return error(self.fine[1], self.fine[0]) if self.fine else np.nan

    def comparable(self):
        """Return whether there is something to compare with, or a refusal to count."""
        refused = any(run["status"] == "refused" for run in self.runs.values())
        return self.fine is not None and (refused or bool(np.isfinite(self.own)))

    def agree(self):
        """Return whether both references say the same; a refused model has no weights for that."""
        return self.fine is not None and not self.own > AGREE

    def found(self, variant="tolerance"):
        """Return the error of a run."""
        return error(self.runs[variant], self.fine[0])

    def over_user(self, variant):
        """Return the time of a run over that of the user's."""
        return self.runs[variant]["seconds"] / max(self.user["seconds"], 1e-3)

    def users_will_do(self, tolerance):
        """Return whether the user's own steps have the tolerance."""
        return self.agree() and error(self.user, self.fine[0]) <= tolerance

    def at_equal_error(self, variant="tolerance"):
        """Return the run's time over that of the fixed steps with its error; nan beyond them."""
        done = [one for one in (*self.coarse, self.user) if one["status"] in ENDED]
        points = [(error(one, self.fine[0]), one["seconds"]) for one in done]
        points.append((self.own, self.fine[1]["seconds"]))
        points = [(missed, max(seconds, 1e-3)) for missed, seconds in points if missed > 0.0]
        found = at_equal_error(sorted(points, reverse=True), self.found(variant))
        return self.runs[variant]["seconds"] / found

    def per_step(self, variant="tolerance"):
        """Return the time of a tried step over that of one of the user's."""
        run, fixed = self.runs[variant], self.user
        return run["seconds"] / run["tries"] * fixed["steps"] / fixed["seconds"]

    def kind(self, tolerance, variant="tolerance"):
        """Return the class of a run, as an index."""
        run = self.runs[variant]
        if run["status"] == "refused":
            return 6
        if run["status"] == "time limit":
            return 7
        if run["status"] == "crashed":
            return 8
        if run["status"] not in ENDED:
            return 5
        found = self.found(variant)
        if found <= tolerance:
            return 0
        if found <= 10 * tolerance:
            return 1
        if found <= 3.0 * self.own:
            return 2
        if not self.agree():
            return 9
        return 3 if found <= 100 * tolerance else 4

    def line(self, tolerance):
        """Return a line about the model."""
        text = f"{self.name:44s} {self.user['unknowns']:5d} own {self.own:8.1e}"
        for variant, run in self.runs.items():
            if variant == "errors":
                text += f" | stated {run.get('stated', np.nan) / tolerance:8.2g} {run.get('why')}"
                continue
            fixed = self.user["seconds"]
            kind = CLASSES[self.kind(tolerance, variant)] if self.comparable() else "-"
            text += f" | {run.get('steps', 0):6d} of {run.get('tries', 0):6d} "
            text += f"({self.user['steps']:6d}) {run.get('seconds', 0.0):6.2f} s ({fixed:6.2f}) "
            text += f"{self.found(variant) / tolerance:8.2g} {kind}; {run['status']} "
            text += run["reason"][:160]
        return text


def table(models, tolerance):
    """Return how many models are in which class, and how long they took."""
    comparable = [model for model in models if model.comparable() and model.runs]
    lines = [f"{len(models)} models with an implicit solver, {len(comparable)} comparable"]
    for variant in comparable[0].runs if comparable else ():
        if variant == "errors":  # the same runs once more
            continue
        kinds = [model.kind(tolerance, variant) for model in comparable]
        counts = Counter(kinds)
        agreeing = Counter(
            kind for model, kind in zip(comparable, kinds, strict=True) if model.agree()
        )
        lines.append(f"\n{variant} {tolerance:g}:")
        lines.append(f"{'all':>5s} {'references agree':>17s}")
        lines.append(f"{counts.total():5d} {agreeing.total():17d}  comparable")
        for i, name in enumerate(CLASSES):
            lines.append(f"{counts[i]:5d} {agreeing[i]:17d}  {name}")
        ended = [m for m, kind in zip(comparable, kinds, strict=True) if kind < 5]
        equal = [m.at_equal_error(variant) for m in ended if m.coarse]
        user = "processor time over the user's run"
        enough = [m for m in ended if m.users_will_do(tolerance)]
        for name, ratios in (
            (user, [m.over_user(variant) for m in ended]),
            (
                f"{user}, whose error is within the tolerance",
                [m.over_user(variant) for m in enough],
            ),
            (
                "processor time over the fixed step's of the same error",
                [ratio for ratio in equal if np.isfinite(ratio)],
            ),
        ):
            if ratios:
                low, most = np.percentile(ratios, [50, 95])
                lines.append(f"{name} ({len(ratios)} models): median {low:.2g}, 95 % {most:.2g}")
        for above, up_to in itertools.pairwise(SIZES):
            sized = [m for m in ended if above < m.user["unknowns"] <= up_to]
            steps = [m.per_step(variant) for m in sized if m.runs[variant].get("tries")]
            if steps:
                lines.append(
                    f"a tried step over a fixed one, {above} to {up_to} unknowns "
                    f"({len(steps)} models): median {np.median(steps):.2g}"
                )
    told = [m for m in comparable if "stated" in m.runs.get("errors", ())]
    if told:
        lines += ["", *stated(told, tolerance)]
    return "\n".join(lines)


def stated(told, tolerance):
    """Yield in words how the errors that runs state cover the true ones."""
    pairs = [(m.found("errors"), m.runs["errors"]["stated"]) for m in told]
    clear = [pair for m, pair in zip(told, pairs, strict=True) if 0.0 < m.own <= CLEAR * pair[0]]
    ratios = [said / missed for missed, said in clear]
    covered = sum(missed <= said for missed, said in clear)
    yield f"errors stated by {len(told)} runs, {len(clear)} of them clearly off the references"
    yield f"the stated error covers the true one: {covered} of {len(clear)}"
    yield f"stated over true error: median {np.median(ratios):.2g}"
    for times in (10, 100):
        far = [said for missed, said in pairs if missed > times * tolerance]
        warned = sum(said > 10 * tolerance for said in far)
        yield f"more than {times} tolerances off: {len(far)}, with a warning {warned}"
    right = [said for missed, said in pairs if missed <= tolerance]
    warned = sum(said > 10 * tolerance for said in right)
    yield f"within one tolerance: {len(right)}, with a warning {warned}"
