"""What a reader does with a page: its code blocks, in order, in one directory."""

import io
import os
import re
import shlex
import subprocess
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from itertools import pairwise
from multiprocessing import get_context
from pathlib import Path

from exu_press.cli import main
from exu_press.studies.registry import STUDIES, study_command
from exu_press.studies.sweep import Sweep

ROOT = Path(__file__).parents[2]
BIN = Path(sys.executable).parent
PAGES = [
    ROOT / "README.md",
    *sorted(p for p in (ROOT / "docs").rglob("*.md") if "gallery" not in p.parts),
]

FENCE = re.compile(
    r"(?P<notes>(?:^<!--.*?-->\n)*)^```(?P<language>\w+|\{container\})\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)

NOT_RUN = ("python3 -m venv", "pip install", ".venv/bin/", "pytest", "ruff", "sphinx-build", "mypy")
"""Beginnings of shell commands that set up or check: other tests run them, or CI does."""


@dataclass(frozen=True)
class Block:
    """One fenced block; notes are the HTML comments above it, as in <!-- long -->.

    Others are `file`, the file that a reader saves it as; `added to`, the mechanism file that he
    may add it to; `printed by` and `part of what this prints`, the command that did.
    """

    language: str
    text: str
    notes: str

    def note(self, name: str) -> str | None:
        """Return what a note has behind its name."""
        named = re.search(rf"<!-- {name}: (.+?) -->", self.notes)
        return named[1] if named else None

    @property
    def long(self) -> bool:
        """Whether it takes minutes."""
        return "<!-- long -->" in self.notes

    @property
    def shortened(self) -> list[str]:
        """What shows that the commands run, in ten degrees unless more is looked at.

        Of other dimensions the press has no flexible variants, whose modes take long to find.
        """
        few = [] if re.search("--at |--from ", self.text) else ["revolutions=0.03"]
        if "exu-press compare press" in self.text:
            few.append("press.crank_radius=0.029")
        return [word for change in few for word in ("--set", change)]

    @property
    def commands(self) -> list[str]:
        """The shell commands to run."""
        lines = [line.partition("  #")[0].strip() for line in self.text.splitlines()]
        parts = [part.strip() for line in lines if line for part in line.split("&&")]
        return [part for part in parts if not part.startswith(NOT_RUN) or "exu-press " in part]


def blocks_of(page: Path) -> list[Block]:
    """Return the fenced blocks of a page that name a language."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(m["language"], m["text"], m["notes"])
        for m in FENCE.finditer(text)
    ]  # fmt: skip


def run_block(block: Block, place: Path, *, short: bool = False) -> None:
    """Do what the block says, in a directory; what goes wrong is an AssertionError."""
    if block.note("file"):
        (place / block.note("file")).write_text(block.text, encoding="utf-8")
    if block.language == "python":
        run_python(block.text, place, short=short)
    elif block.language == "toml":
        read(block, place)
    elif block.language == "sh":
        for command in block.commands:
            written = run_command(command, place, block.shortened if short else None)
            assert all(path.exists() for path in written), (command, written)


def run_command(command: str, place: Path, shortened: list[str] | None) -> list[Path]:
    """Run a shell command of ours; return the files and directories that it was to write.

    Shortened, it runs in this process, which has imported everything already.
    """
    words = shlex.split(command)
    name = Path(words[0]).name
    if name == "python":
        words = [sys.executable, str(ROOT / words[1]), *words[2:]]
    else:
        assert name == "exu-press", f"nothing runs this command: {command}"
        words[0] = str(BIN / name)
        if words[1] in ("run", "compare", "sweep"):
            words.append("--no-pictures")  # longer than the run; tests/plots has them
        if words[1] in ("run", "compare") and "--within" not in words:
            words.append("--no-error")  # as long as the run; tests/confidence has them
            words += (shortened or []) if "revolutions=0.0" not in command else []
    if shortened is None or name == "python":
        run(words, place)
    else:
        run_here(words[1:], place)
    return [place / value for option, value in pairwise(words) if option in ("--out", "--save")]


def run(words: list[str], place: Path) -> str:
    """Run a process; return what it printed, with kernels for x86-64 processors since 2013.

    OpenBLAS has others for some of them, which round otherwise: errors that runs state differ in
    their first digit then, and peaks beyond the horizon by a tenth.
    """
    done = subprocess.run(
        words,
        cwd=place,
        capture_output=True,
        text=True,
        timeout=1800,
        check=False,
        env={**os.environ, "OPENBLAS_CORETYPE": "Haswell"},
    )
    assert done.returncode == 0, f"{words}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
    return done.stdout


def run_python(text: str, place: Path, *, short: bool) -> None:
    """Run a block as a script; shortened, in a copy of this process, which has imported a lot."""
    if not short:
        run([sys.executable, "-c", text], place)
        return
    process = get_context("fork" if sys.platform == "linux" else "spawn").Process(
        target=as_script, args=(text, place)
    )
    process.start()
    process.join(900)
    assert process.exitcode == 0, text


def as_script(text: str, place: Path) -> None:
    os.chdir(place)
    sys.path.insert(0, "")
    exec(compile(text, "block", "exec"), {"__name__": "__main__"})


def run_here(words: list[str], place: Path) -> None:
    """Run the command in a directory."""
    said = io.StringIO()
    with chdir(place), redirect_stdout(said), redirect_stderr(said):
        code = main(words)
    assert code == 0, f"{words}\n{said.getvalue()[-4000:]}"


def read(block: Block, place: Path) -> None:
    """Read a scene, a study or a mechanism as the commands do."""
    import tomllib

    from exu_press import Scene
    from exu_press.mechanism import load_mechanism
    from exu_press.studies.base import load_study

    path = place / (block.note("file") or "block.toml")
    above = (place / block.note("added to")).read_text("utf-8") if block.note("added to") else ""
    path.write_text(above + block.text, encoding="utf-8")
    if block.note("added to") or {"bodies", "crank"} <= set(tomllib.loads(block.text)):
        load_mechanism(path)
    elif "scene" in tomllib.loads(block.text):
        load_study(path, kind_of(tomllib.loads(block.text)))
    else:
        Scene.load(path)


def kind_of(tables: dict[str, object]) -> type:
    """Return the kind of a study, which its own tables tell."""
    kinds = [study_command(name).study for name in STUDIES]
    own = [kind for kind in kinds if tables.keys() & getattr(kind, "tables", {}).keys()]
    return own[0] if own else Sweep


def printed_blocks() -> list[tuple[Path, Block]]:
    """Return the blocks of docs/ that say what printed them; README shows parts of what is."""
    return [
        (page, block) for page in PAGES[1:] for block in blocks_of(page) if block.note("printed by")
    ]


def partly_printed_blocks() -> list[tuple[Path, Block]]:
    """Return the blocks that show a part of what is printed within some minutes.

    Diagrams take half an hour, and so does all that scripts/paper.py prints.
    """
    return [
        (page, block)
        for page in PAGES[1:]
        for block in blocks_of(page)
        if (block.note("part of what this prints") or "").startswith("exu-press attractor")
    ]


def printed_again(page: Path, block: Block, place: Path) -> str:
    """Run what printed a block or a part of it, with the files that the page saves before it."""
    for before in blocks_of(page):
        if before.note("file"):
            (place / before.note("file")).write_text(before.text, encoding="utf-8")
    words = shlex.split(block.note("printed by") or block.note("part of what this prints") or "")
    if words[0] == "exu-press":
        return run([str(BIN / words[0]), *words[1:]], place)
    return run([sys.executable, str(ROOT / words[1]), *words[2:]], place)
