"""Refuse names that do not say what they hold: python scripts/check_names.py [FOLDER ...]

Idle words (`found`, `part`) are refused as names of anything, bare participles and prepositions
(`filtered`, `_over`) as names of functions and classes. CONTRIBUTING.md has the rules.
"""

import argparse
import ast
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
IDLE = """found told given wanted got each one other others said shown kept left way place part
things thing before"""
BARE = """shaken beyond between apart never over at put on off under within without beside after
behind along across into onto from of by to with as like held met gone begun drawn known seen
taken thrown worn made sent set cut let heard felt built bent spent lost won"""
NOUNS = {"speed", "seed", "feed", "need", "bed", "shed"}
ALLOWED = {  # by the beginning of a path
    "fe_models/": ("Part",),  # of the public interface
    "exu_press/result/": ("place", "completed"),  # of files, and of the public interface
    "exu_press/scene/table_load.py": ("over",),  # likewise, of loads
    "exu_press/studies/": ("way",),  # of study files
}


def names(tree: ast.AST) -> Iterator[tuple[int, str, bool]]:
    """Return line and name of all that is bound, and whether it is a function or a class."""
    compared = set()  # arguments of comparisons, of which one is `other`
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) if name.startswith(("__", "compare")):
                compared |= {id(argument) for argument in node.args.args}
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield node.lineno, name, True
            case ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield node.lineno, name, False
            case ast.arg(arg=name) if name != "other" or id(node) not in compared:
                yield node.lineno, name, False


def refused_names(folder: str) -> Iterator[str]:
    """Return a line of text for each name of a folder that is refused."""
    for path in sorted((ROOT / folder).rglob("*.py")):
        file = path.relative_to(ROOT).as_posix()
        allowed = [name for begin in ALLOWED if file.startswith(begin) for name in ALLOWED[begin]]
        for line, name, is_definition in names(ast.parse(path.read_text(encoding="utf-8"))):
            word = name.strip("_").lower()
            is_participle = name.strip("_")[1:].islower() and word.endswith("ed")
            is_bare = word in BARE.split() or (is_participle and word not in NOUNS)
            is_refused = word in IDLE.split() or (is_definition and is_bare and "_" not in word)
            if is_refused and name not in allowed:
                yield f"{file}:{line}: `{name}` does not say what it is (CONTRIBUTING.md, Names)"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", nargs="*", default=("exu_press", "fe_models"))
    sys.exit("\n".join(n for f in parser.parse_args().folder for n in refused_names(f)) or None)
