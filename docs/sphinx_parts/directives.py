"""Tables that are made from the code, so that they cannot go out of date."""

import dataclasses
import os
import subprocess
import sys
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive

from exu_press import Scene
from exu_press.quantities import CATALOGUE
from exu_press.result.channel import AXES, OWNERS, VECTOR, Declaration
from exu_press.result.recorders import declared_channels
from exu_press.scene import DryJoint, Flexible
from exu_press.scene.load import LOAD_KINDS
from exu_press.scene.oil import Oil
from exu_press.scene.usage import TABLES, table_keys
from exu_press.scene.worn import WornDepths
from exu_press.schema.registry import Choice
from exu_press.schema.table import Table, declared_keys


def setup(app: Any) -> dict[str, Any]:
    """Add the directives."""
    app.add_directive("scene-keys", SceneKeys)
    app.add_directive("commands", Commands)
    app.add_directive("quantities", Quantities)
    app.add_directive("channels", Channels)
    return {"parallel_read_safe": True}


class SceneKeys(Directive):
    """Every table of a scene with its keys; its text is for readers of the source."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return a section a table."""
        content: list[nodes.Node] = []
        named = {"joints.NAME": DryJoint, "joints.NAME.worn": WornDepths, "bodies.NAME": Flexible}
        named |= {f"load.NAME, {kind}": load for kind, load in LOAD_KINDS.items()}
        for name, kind in {"at the top": Scene, **named, **TABLES, "film.oil": Oil}.items():
            title = name if kind is Scene else f"[{name}]"
            section = nodes.section(ids=[f"keys-{name.replace(' ', '-')}"], names=[title])
            section += nodes.title(title, title)
            summary = (kind.__doc__ or "").splitlines()[0]
            if kind is not Scene:
                section += nodes.paragraph(summary, summary)
            fields = table_keys(name) if name in TABLES else declared_keys(kind)
            rows = [("key", "default", "meaning", "allowed")]
            rows += [
                (
                    key,
                    _default(_usual(kind, field)),
                    _meaning(field) + _used_with(kind, key),
                    _allowed_values(field),
                )
                for key, field in fields.items()
                if "meaning" in field.metadata
            ]
            section += table_of(rows)
            content.append(section)
        return content


class Quantities(Directive):
    """Every quantity with its unit and meaning."""

    def run(self) -> list[nodes.Node]:
        """Return one table."""
        rows = [("name", "unit", "meaning", "kind")]
        rows += [(q.full_name("NAME"), q.unit, q.meaning, q.kind.name) for q in CATALOGUE]
        return [table_of(rows)]


class Channels(Directive):
    """Every channel with its unit, meaning, columns and runs."""

    def run(self) -> list[nodes.Node]:
        """Return one table."""
        rows = [("name", "unit", "meaning", "columns", "of")]
        rows += [_of_channel(declared) for declared in declared_channels()]
        return [table_of(rows)]


def _of_channel(declared: Declaration) -> tuple[str, ...]:
    """Return the row of a channel."""
    columns = ", ".join(AXES.get(declared.axis, (declared.axis and "a column each",)))
    if declared.axis == VECTOR:
        columns = "x, y; and z of spherical joints"
    texts = {declared.owner or "run": "NAME", "positive": "along its guide or across it"}
    runs = OWNERS[declared.owner] + (f"; not {declared.unless}" if declared.unless else "")
    meaning = declared.meaning.format(**texts)
    return declared.name_of("NAME"), declared.unit, meaning, columns, runs


class Commands(Directive):
    """What exu-press and each of its commands print for --help; its text is for source readers."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return a section a command."""
        from exu_press.cli.main import COMMANDS

        content: list[nodes.Node] = [help_of()]
        for command in COMMANDS:
            section = nodes.section(ids=[f"command-{command}"], names=[command])
            section += nodes.title(command, command)
            section += help_of(command)
            content.append(section)
        return content


def help_of(*words: str) -> nodes.literal_block:
    """Return what is printed for --help."""
    code = "import sys; from exu_press.cli import main; main(sys.argv[1:])"
    done = subprocess.run(
        [sys.executable, "-c", code, *words, "--help"],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "COLUMNS": "88"},
    )
    text = done.stdout.replace("usage: -c", "usage: exu-press")
    return nodes.literal_block(text, text, language="text")


def table_of(rows: list[tuple[str, ...]]) -> nodes.table:
    """Return a table with a head; first column as code."""
    group = nodes.tgroup(cols=len(rows[0]))
    for width in (22, 16, 44, 32, 32)[: len(rows[0])]:
        group += nodes.colspec(colwidth=width)
    head, body = nodes.thead(), nodes.tbody()
    for number, row in enumerate(rows):
        line = nodes.row()
        for column, text in enumerate(row):
            entry = nodes.entry()
            paragraph = nodes.paragraph()
            code = number > 0 and column < 2 and text
            paragraph += nodes.literal(text, text) if code else nodes.Text(text)
            entry += paragraph
            line += entry
        (body if number else head).append(line)
    group += head
    group += body
    table = nodes.table()
    table += group
    return table


def _usual(kind: Any, field: Any) -> Any:
    """Return the value that a key has in a scene that does not give it."""
    if kind is Scene:
        return getattr(Scene(), field.name)
    return 20 if kind is Flexible and field.name == "modes" else field.default


def _default(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else str(value)


def _used_with(kind: type[Table], name: str) -> str:
    """Return in words which choices of its table use a key, or nothing."""
    conditions = []
    for field in dataclasses.fields(kind):
        part = field.metadata.get("part")
        if not isinstance(part, Choice):
            continue
        users = [chosen.strip("'") for chosen, k in part.classes() if name in declared_keys(k)]
        if users and len(users) < len(part.kinds):
            conditions.append(f"{field.name} = {' or '.join(users)}")
    return f" (with {'; '.join(conditions)})" if conditions else ""


def _meaning(key: Any) -> str:
    meta = key.metadata
    return f"{meta['meaning']}, {meta['unit']}" if meta["unit"] else meta["meaning"]


def _allowed_values(key: Any) -> str:
    meta = key.metadata
    if meta["choices"]:
        return ", ".join(meta["choices"])
    signs = (("above", ">"), ("at_least", ">="), ("at_most", "<="))
    return ", ".join(f"{sign} {meta[k]:g}" for k, sign in signs if meta[k] is not None)
