"""Hostile scenes, results that name code, and damaged STEP files: what becomes of each.

Run with: python scripts/attack_scenes.py [--scenes N] [--results N] [--step N] [--seed S]

Every command runs in a child process, in a folder with modules that leave a mark when they are
imported. The totals count how inputs end; a traceback, a crash, a mark, a message of more than one
line and a file outside the folder are faults, which are printed with the seed of their input.
"""

import argparse
import contextlib
import copy
import dataclasses
import io
import json
import os
import random
import sys
import tempfile
import tomllib
import traceback
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import exu_press
from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main as command_line
from exu_press.result import netcdf
from fe_models import CRANK_STEEL, Axis, Interface, Part, Reduction, reduced_part
from fe_models.geometry import StepFile
from fe_models.processes import Child, ChildError, TimeLimitError

SCENES = Path(exu_press.__file__).parent / "scenes"
ROD = SCENES / "six_bar_rod.step"

LONGEST = 60.0
"""s, for one input."""

MARK = "imported"
"""File that the hostile modules write."""

HOSTILE_MODULES = ("hostile", "json", "numpy", "sitecustomize", "usercustomize")

CODE = (
    *("hostile:Spring", "hostile", "this:x", "antigravity:x", "os:system", "__main__:x"),
    *("hostile:Spring.__init__", "../hostile:Spring", "exu_press.__main__:main", ":", "a:b:c"),
    *("hostile.:x", "numpy:array", "json:loads", "\u202ehostile:Spring"),
)
VALUES: tuple[Any, ...] = (
    *(float("nan"), float("inf"), -1.0, 0, 1e308, -1e308, 10**30, 1e-308, True, False),
    *("", "a" * 50_000, "\x00", "\x1b[31mred", "../../etc/passwd", "/dev/zero", "/dev/stdin.toml"),
    *("$(touch ran)", "`touch ran`", "<script>", "%s%n", [], {}, [[[[1]]]], [1, "a"], {"a": {}}),
    *(["\n" * 100], {"kind": "hostile:Spring"}, {"file": "/dev/zero", "kind": "table"}),
)


def damaged_scene(draw: random.Random) -> dict[str, Any]:
    """Return the tables of a shipped scene with one to three hostile keys."""
    name = draw.choice(("press", "slider_crank", "drag_link"))
    data = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    data |= {"revolutions": 0.02, "settle": 0.0, "solver": {"max_steps": 300}}
    for _ in range(draw.randint(1, 3)):
        table = data
        while draw.random() < 0.6:
            inner = [value for value in table.values() if isinstance(value, dict)]
            if not inner:
                break
            table = draw.choice(inner)
        keys = [*table, "kind", "mechanism", "joints", "load", "bodies", "flexible", "__class__"]
        value = draw.choice(CODE) if draw.random() < 0.4 else draw.choice(VALUES)
        table[draw.choice(keys)] = copy.deepcopy(value)
    if draw.random() < 0.4:
        joints = data.setdefault("joints", {})
        if isinstance(joints, dict):
            kind = draw.choice(CODE)
            keys = {"kind": kind, "clearance": 1e-4}
            joints[draw.choice(("crank_pin", "balls", "wrist_pin"))] = draw.choice((kind, keys))
    return data


def toml(value: Any) -> str:
    """Return a value as TOML has it in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value)


def damaged_step(draw: random.Random, text: str) -> str:
    """Return the text of a STEP file with one to three damages of many kinds."""
    lines = text.splitlines()
    types = sorted({line.partition("= ")[2].partition("(")[0] for line in lines if "= " in line})
    for _ in range(draw.randint(1, 3)):
        i = draw.randrange(len(lines))
        line, other = lines[i], draw.choice(lines)
        numbers = [part for part in line.replace("(", ",").replace(")", ",").split(",") if part]
        old = draw.choice(numbers) if numbers else line
        lines[i] = draw.choice(
            (
                "",
                other,
                line[: draw.randrange(len(line) + 1)],
                line.replace(old, draw.choice(("NAN", "1.E999", "-1.E30", "0.", "#1", "$", "*"))),
                line.replace(old, f"#{draw.randrange(2000)}"),
                line.replace("#", f"#{draw.randrange(9)}", 1),
                line.replace(line.partition("= ")[2].partition("(")[0] or "(", draw.choice(types)),
                line.replace("(", "((", 1),
                "".join(draw.sample(line, len(line))),
                line + chr(draw.randrange(1, 0x250)) * draw.choice((1, 10_000)),
            )
        )
    text = "\n".join(lines)
    return text[: draw.randrange(len(text))] if draw.random() < 0.05 else text


def perform(arguments: list[str], folder: str) -> tuple[int | None, str]:
    """Return the exit status of a command and its messages, in a child; None with a traceback."""
    os.chdir(folder)
    messages = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(messages):
        try:
            return command_line(arguments), messages.getvalue()
        except SystemExit as stop:
            return int(stop.code or 0), messages.getvalue()
        except BaseException:
            return None, traceback.format_exc()


class Attacker:
    """Runs commands on hostile inputs in a child, counts how they end, and prints faults."""

    def __init__(self, folder: Path) -> None:
        """Put modules into a folder that leave a mark when they are imported."""
        self.folder, self.counts, self.faults = folder, Counter[str](), 0
        self._child: Child | None = None
        self._around = sorted(folder.parent.iterdir())
        for module in HOSTILE_MODULES:
            text = f"open({str(folder / MARK)!r}, 'a').write({module!r})\n"
            (folder / f"{module}.py").write_text(text, encoding="utf-8")

    def attack(self, seed: int, arguments: list[str]) -> None:
        """Run a command on what a seed has made."""
        child = self._child or Child(f"attack_scenes:{perform.__name__}", one_thread=True)
        self._child = child
        child.request(arguments, str(self.folder))
        try:
            status, messages = child.answer(LONGEST)
        except TimeLimitError:
            self.count(f"longer than {LONGEST:g} s")
            self.end()
        except ChildError as error:
            self.fault(seed, arguments, f"crash: {error}")
            self.end()
        else:
            refused = [line for line in messages.splitlines() if line.startswith("exu-press: ")]
            refused = [line for line in refused if not line.startswith("exu-press: warning")]
            if status is None:
                self.fault(seed, arguments, f"traceback: {messages}")
            elif status == 2 and (len(refused) != 1 or "Traceback" in messages):
                self.fault(seed, arguments, f"refused in other words: {messages[:500]}")
            else:
                ends = {0: "completed", 2: "refused in one line", 3: "stopped, with its reason"}
                self.count(ends.get(status, f"exit status {status}"))
        if (self.folder / MARK).exists():
            self.fault(seed, arguments, f"code ran: {(self.folder / MARK).read_text()}")
            (self.folder / MARK).unlink()
        if sorted(self.folder.parent.iterdir()) != self._around or (self.folder / "ran").exists():
            self.fault(seed, arguments, "a file outside the output directory")

    def count(self, how: str) -> None:
        """Count an end."""
        self.counts[how] += 1

    def fault(self, seed: int, arguments: list[str], what: str) -> None:
        """Count and print a fault."""
        self.faults += 1
        self.count("FAULT")
        print(f"FAULT, seed {seed}, {' '.join(arguments)}: {what}", flush=True)

    def end(self) -> None:
        """End the child."""
        if self._child is not None:
            self._child.end()
        self._child = None


def attack_scenes(attacker: Attacker, seeds: Sequence[int]) -> None:
    """Run commands on hostile scenes."""
    for seed in seeds:
        draw = random.Random(seed)
        data = damaged_scene(draw)
        lines = [f"{json.dumps(key)} = {toml(value)}" for key, value in data.items()]
        (attacker.folder / "scene.toml").write_text("\n".join(lines), encoding="utf-8")
        more = ["--no-pictures", "--quiet", "--out", "out"]
        command = draw.choice((["run", "--no-error"], ["compare", "--no-error"], ["attractor"]))
        if draw.random() < 0.1:
            command, more = ["draw"], ["--save", "drawing.png"]
        elif draw.random() < 0.3:
            more += ["--set", f"joints.crank_pin={draw.choice(CODE)}"]
        attacker.attack(seed, [command[0], "scene.toml", *command[1:], *more])


def attack_results(attacker: Attacker, seeds: Sequence[int]) -> None:
    """Read results whose scene names code."""
    joints = {"crank_pin": "dry", "wrist_pin": "dry"}
    result = simulate(Scene(mechanism="slider_crank", joints=joints, revolutions=0.02))
    file = attacker.folder / "run.nc"
    for seed in seeds:
        draw = random.Random(seed)
        netcdf.write(forged(result, draw), file)
        out = ["--no-pictures", "--out", "out"]
        command = draw.choice(
            (
                ["report", "run.nc"],
                ["spectrum", "run.nc", "--out", "out"],
                ["view", "run.nc", "--save", "frame.png"],
                ["compare", "run.nc", "press", "--no-error", *out],
                ["run", "slider_crank", "--once", "--from", "run.nc", *out],
            )
        )
        attacker.attack(seed, command)


def forged(result: Result, draw: random.Random) -> Result:
    """Return a result with a scene that names code."""
    data = result.scene.to_dict()
    kind = draw.choice(CODE)
    keys = {"kind": kind, "clearance": 1e-4, "stiffness": draw.choice((1e8, "x", {}))}
    joint = draw.choice(("crank_pin", "wrist_pin", "nowhere"))
    data["joints"] = {**data["joints"], joint: draw.choice((kind, keys))}
    if draw.random() < 0.2:
        data["load"] = {"press": {"kind": kind, "force": 1.0}}

    class Forged:
        asked = result.scene.asked

        def to_dict(self) -> dict[str, Any]:
            return data

    other: Any = object.__new__(Result)
    for field in dataclasses.fields(Result):
        object.__setattr__(other, field.name, getattr(result, field.name))
    object.__setattr__(other, "scene", Forged())
    return other


def attack_step_files(attacker: Attacker, seeds: Sequence[int]) -> Iterator[str]:
    """Reduce parts of damaged STEP files; yield the entities that messages name."""
    axes = {"big": Axis((0.015, 0.232), hole=True), "small": Axis((0.043, -0.595), hole=True)}
    faces, text = (Interface("big"), Interface("small")), ROD.read_text(encoding="utf-8")
    for seed in seeds:
        file = attacker.folder / "rod.step"
        file.write_text(damaged_step(random.Random(seed), text), encoding="utf-8")
        step = StepFile(file, 1e-3, axes=axes, time_limit=LONGEST)
        part = Part("rod", step, CRANK_STEEL, faces, 0.06)
        try:
            reduced = reduced_part(part, Reduction(2), folder=attacker.folder / "cache")
        except InputError as error:
            message = str(error)
            if "\n" in message or (str(file) not in message and "rod" not in message):
                attacker.fault(seed, ["STEP"], message)
            elif "more than" in message and "takes" in message:
                attacker.count(f"longer than {LONGEST:g} s")
            else:
                crashed = "killed by" in message or "exit status" in message
                attacker.count("refused, as the child crashed" if crashed else "refused")
            _, found, entity = message.partition(": #")
            if found:
                yield entity.partition(" ")[0]
        except Exception:
            attacker.fault(seed, ["STEP"], traceback.format_exc())
        else:
            finite = 0.0 < reduced.mass < 1e6 and bool((reduced.frequencies >= 0.0).all())
            attacker.count("reduced")
            if not finite:
                attacker.fault(seed, ["STEP"], f"mass {reduced.mass}, {reduced.frequencies}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0 without a fault, else 1."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--scenes", type=int, default=500, metavar="N", help="hostile scenes")
    parser.add_argument("--results", type=int, default=100, metavar="N", help="forged results")
    parser.add_argument("--step", type=int, default=200, metavar="N", help="damaged STEP files")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first input")
    options = parser.parse_args(arguments)
    faults = 0
    for name, count in (("scenes", options.scenes), ("results", options.results)):
        faults += campaign(name, range(options.seed, options.seed + count))
    return int(
        bool(faults + campaign("STEP files", range(options.seed, options.seed + options.step)))
    )


def campaign(name: str, seeds: Sequence[int]) -> int:
    """Attack with inputs of one kind, print the totals, and return the number of faults."""
    with tempfile.TemporaryDirectory() as base:
        folder = Path(base) / "work"
        folder.mkdir()
        attacker, entities = Attacker(folder), []
        try:
            if name == "scenes":
                attack_scenes(attacker, seeds)
            elif name == "results":
                attack_results(attacker, seeds)
            else:
                entities = [*attack_step_files(attacker, seeds)]
        finally:
            attacker.end()
    ends = ", ".join(f"{count} {how}" for how, count in attacker.counts.most_common())
    named = f"; {len(entities)} messages name an entity" if entities else ""
    print(f"{len(seeds)} {name}: {ends or 'none'}{named}", flush=True)
    return attacker.faults


if __name__ == "__main__":
    sys.exit(main())
