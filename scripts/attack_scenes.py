"""Hostile scenes, results that name code, and damaged STEP files: what becomes of each.

Run with: python scripts/attack_scenes.py [--scenes N] [--results N] [--step N] [--seed S]

Every command runs in a child process, in a folder with modules that leave a mark when they are
imported. The totals count how inputs end; a traceback, a crash, a mark, a message of more than one
line and a file outside the folder are faults, which are printed with the seed of their input.
"""

import contextlib
import copy
import dataclasses
import io
import json
import os
import random
import sys
import tomllib
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import attacks
import exu_press
from attacks import Totals
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


class Attacker(AbstractContextManager["Attacker", None]):
    """Runs commands on hostile inputs in a child."""

    def __init__(self, folder: Path, name: str) -> None:
        """Put modules into a new folder that leave a mark when they are imported."""
        folder.mkdir()
        self.folder, self.totals = folder, Totals(name)
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
            self.totals.count(f"longer than {LONGEST:g} s")
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
                self.totals.count(ends.get(status, f"exit status {status}"))
        if (self.folder / MARK).exists():
            self.fault(seed, arguments, f"code ran: {(self.folder / MARK).read_text()}")
            (self.folder / MARK).unlink()
        if sorted(self.folder.parent.iterdir()) != self._around or (self.folder / "ran").exists():
            self.fault(seed, arguments, "a file outside the output directory")

    def fault(self, seed: int, arguments: list[str], what: str) -> None:
        """Count and print a fault."""
        self.totals.fault(seed, f"{' '.join(arguments)}: {what}")

    def end(self) -> None:
        """End the child."""
        if self._child is not None:
            self._child.end()
        self._child = None

    def __exit__(self, *_: object) -> None:
        self.end()


def attack_scenes(base: Path, seeds: Sequence[int]) -> int:
    """Run commands on hostile scenes."""
    with Attacker(base / "work", "scenes") as attacker:
        for seed in seeds:
            attacker.attack(seed, hostile_command(attacker.folder, seed))
    return attacker.totals.close()


def hostile_command(folder: Path, seed: int) -> list[str]:
    """Write a hostile scene into a folder, and return a command that reads it."""
    draw = random.Random(seed)
    data = damaged_scene(draw)
    lines = [f"{json.dumps(key)} = {toml(value)}" for key, value in data.items()]
    (folder / "scene.toml").write_text("\n".join(lines), encoding="utf-8")
    more = ["--no-pictures", "--quiet", "--out", "out"]
    command = draw.choice((["run", "--no-error"], ["compare", "--no-error"], ["attractor"]))
    if draw.random() < 0.1:
        command, more = ["draw"], ["--save", "drawing.png"]
    elif draw.random() < 0.3:
        more += ["--set", f"joints.crank_pin={draw.choice(CODE)}"]
    return [command[0], "scene.toml", *command[1:], *more]


def attack_results(base: Path, seeds: Sequence[int]) -> int:
    """Read results whose scene names code."""
    joints = {"crank_pin": "dry", "wrist_pin": "dry"}
    result = simulate(Scene(mechanism="slider_crank", joints=joints, revolutions=0.02))
    out = ["--no-pictures", "--out", "out"]
    commands = (
        ["report", "run.nc"],
        ["spectrum", "run.nc", "--out", "out"],
        ["view", "run.nc", "--save", "frame.png"],
        ["compare", "run.nc", "press", "--no-error", *out],
        ["run", "slider_crank", "--once", "--from", "run.nc", *out],
    )
    with Attacker(base / "work", "results") as attacker:
        for seed in seeds:
            draw = random.Random(seed)
            netcdf.write(forged(result, draw), attacker.folder / "run.nc")
            attacker.attack(seed, draw.choice(commands))
    return attacker.totals.close()


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


def attack_step_files(base: Path, seeds: Sequence[int]) -> int:
    """Reduce parts of damaged STEP files."""
    with Attacker(base / "work", "STEP files") as attacker:
        named = sum(1 for _ in named_entities(attacker, seeds))
    return attacker.totals.close(f"; {named} messages name an entity" if named else "")


def named_entities(attacker: Attacker, seeds: Sequence[int]) -> Iterator[str]:
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
                attacker.totals.count(f"longer than {LONGEST:g} s")
            else:
                crashed = "killed by" in message or "exit status" in message
                attacker.totals.count("refused, as the child crashed" if crashed else "refused")
            _, mark, entity = message.partition(": #")
            if mark:
                yield entity.partition(" ")[0]
        except Exception:
            attacker.fault(seed, ["STEP"], traceback.format_exc())
        else:
            finite = 0.0 < reduced.mass < 1e6 and bool((reduced.frequencies >= 0.0).all())
            attacker.totals.count("reduced")
            if not finite:
                attacker.fault(seed, ["STEP"], f"mass {reduced.mass}, {reduced.frequencies}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0 without a fault, else 1."""
    kinds = {
        "scenes": (attack_scenes, 500, "hostile scenes"),
        "results": (attack_results, 100, "forged results"),
        "step": (attack_step_files, 200, "damaged STEP files"),
    }
    return attacks.main(__doc__ or "", kinds, arguments)


if __name__ == "__main__":
    sys.exit(main())
