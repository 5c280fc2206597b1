"""All runs as one batch, and what they give."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exu_press.files.output_directory import output_directory
from exu_press.parallel import run_batch
from exu_press.scene import Scene
from paper.choice import LINE, MAP, separate
from paper.published import published
from paper.runs import DAMPINGS, DEFAULT, JOINTS, LOADS, clearance, paper_runs
from paper.settings import FLEXIBLE, QUICK, SETTINGS, changed
from paper.tasks import observe, part_frequencies
from paper.value import Value

__all__ = ["VARIED", "Study", "paper"]

TIME_LIMIT = 300.0  # s for one run with its refinements

VARIED = {
    "dry, 0.01 mm": "no load, dry, rigid",
    "lubricated, 0.01 mm": "no load, lubricated, rigid",
    "0.2 mm": "clearance 0.2 mm, rigid",
    "0.1 mm, 500 rpm": "500 rpm, rigid",
    "0.1 mm, 40 kN": "blanking 40 kN, rigid",
}
"""What SETTINGS are tried on, in words."""

VARIED_FLEXIBLE = {"lubricated, 0.01 mm": "no load, lubricated"}


@dataclass(frozen=True)
class Study:
    """What was run and what came out.

    Attributes:
        quick: the reduced form, whose numbers say nothing of the paper.
        scenes: of section 5, by reading of the damping and by name.
        rows: by scene, what `observe` returned.
        settings: (title, cases by their words, scenes by setting and case) of rigid bodies and of
            flexible ones.
        line, map: scenes that a clearance is chosen from: by reading; one for all joints, and pin
            and balls by themselves.
        frequencies: of each part, of every mode.
        files: of the results of the first runs, by scene.
    """

    quick: bool
    scenes: Mapping[str, Mapping[str, Scene]]
    rows: Mapping[Scene, Mapping[str, Any]]
    settings: Sequence[tuple[str, Mapping[str, str], Mapping[str, Mapping[str, Scene | None]]]]
    line: Mapping[str, Sequence[Scene]]
    map: Sequence[Scene]
    frequencies: Mapping[str, Sequence[Value]]
    files: Mapping[Scene, Path]

    def of(self, scene: Scene, measure: str) -> Value | None:
        """Return a measure of a run; None where it has none, or did not get to its end."""
        found = self.rows[scene].get("values", {}).get(measure)
        return Value(**found) if found else None

    def value(self, damping: str, name: str, measure: str) -> Value | None:
        """Return a measure of one of the paper's runs."""
        return self.of(self.scenes[damping][name], measure)

    @property
    def stopped(self) -> dict[str, str]:
        """Return why runs of section 5 did not get to their end, by reading and name."""
        return {
            f"c_max {damping}, {name}": f"{row['status']}: {row['reason']}"
            for damping, scenes in self.scenes.items()
            for name, scene in scenes.items()
            if (row := self.rows.get(scene)) and row["status"] != "completed"
        }

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of paper.json but for the tables: every run of section 5."""
        return {
            "quick": self.quick,
            "runs": {
                damping: {
                    name: self.rows[scene] for name, scene in scenes.items() if scene in self.rows
                }
                for damping, scenes in self.scenes.items()
            },
        }


def paper(
    directory: str | Path, *, quick: bool = False, workers: int | None = None, quiet: bool = True
) -> Study:
    """Run section 5, the sensitivity study and the study of the clearance.

    Args:
        directory: for the runs; called again, the study goes on where it was stopped.
        quick: rigid bodies, a fraction of a revolution, two settings: tries the machinery only.
        workers: processes; all cores unless told.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used.
    """
    directory = output_directory(directory)
    scenes = {
        damping: paper_runs(damping, flexible=not quick, revolutions=0.03 if quick else 2.0)
        for damping in DAMPINGS
    }
    chosen_for = {damping: runs["clearance 0.1 mm"] for damping, runs in scenes.items()}
    radii = LINE[::4] if quick else LINE
    line = {d: [clearance(scene, radial) for radial in radii] for d, scene in chosen_for.items()}
    pairs = separate(chosen_for[DEFAULT], MAP[::2] if quick else MAP)
    few = {words: SETTINGS[words] for words in QUICK}
    settings = [("rigid bodies", VARIED, few if quick else SETTINGS)]
    settings += [] if quick else [("flexible bodies", VARIED_FLEXIBLE, FLEXIBLE)]
    varied = [
        (
            title,
            cases,
            {
                words: {case: changed(scenes[DEFAULT][name], by) for case, name in cases.items()}
                for words, by in all_changes.items()
            },
        )
        for title, cases, all_changes in settings
    ]
    files = {
        runs[f"{load}, {joints}"]: directory / f"c_max_{d}_{load}_{joints}.nc".replace(" ", "_")
        for d, runs in scenes.items()
        for load in LOADS
        for joints in JOINTS
    }
    wanted = [
        *files,
        *(scene for runs in scenes.values() for scene in _used(runs)),
        *(scene for some in line.values() for scene in some),
        *pairs,
        *(s for *_, table in varied for row in table.values() for s in row.values() if s),
    ]
    unique = list(dict.fromkeys(wanted))
    tasks = [
        {"scene": scene.to_dict()} | ({"save": str(files[scene])} if scene in files else {})
        for scene in unique
    ]

    def run_all(function: Any, tasks: Sequence[Mapping[str, Any]], label: str) -> list[Any]:
        return run_batch(
            function,
            tasks,
            directory,
            workers=workers,
            time_limit=TIME_LIMIT,
            has_files=lambda task: "save" not in task or Path(task["save"]).exists(),
            label=label,
            quiet=quiet,
        )

    rows = dict(zip(unique, run_all(observe, tasks, "runs"), strict=True))
    size = 0.1 if quick else 0.02
    parts = {entry.part: max(entry.mode_numbers) for entry in published().frequencies}
    meshed = [{"part": p, "mesh_size": size, "modes": modes} for p, modes in parts.items()]
    found = run_all(part_frequencies, meshed, "parts")
    return Study(
        quick=quick,
        scenes=scenes,
        rows=rows,
        settings=varied,
        line=line,
        map=pairs,
        frequencies={
            part: [Value(**value) for value in row.get("values", [])]
            for part, row in zip(parts, found, strict=True)
        },
        files=files,
    )


def _used(runs: Mapping[str, Scene]) -> list[Scene]:
    """Return the scenes that a row of the tables needs: of peaks, those with rigid bodies too."""
    paper = published()
    names = [number.run for number in paper.numbers]
    names += [name for trend in paper.trends for name in trend.runs]
    names += [f"{number.run}, rigid" for number in paper.peaks]
    return [runs[name] for name in names]
