"""Count the files that a reader visits who follows a scene, and the returns to files left before.

The walk is the order in which functions of the package run for the first time, from simulate on.
Functions of one line are read where they are called, and imports are not followed.
"""

import argparse
import inspect
import sys
from itertools import groupby
from pathlib import Path
from types import CodeType, FrameType

import exu_press
from exu_press import Scene, simulate

PACKAGE = Path(exu_press.__file__).parent
ENDS = {"build": "model/assemble.py", "solve": "model/model.py", "simulate": "verification/"}
"""Function at whose end the walk is counted -> beginning of its file's path."""
SCENES = {"ideal joints": Scene(joints={}, revolutions=0.02), "film": Scene(revolutions=0.02)}


def walk(scene: Scene) -> dict[str, list[str]]:
    """Return the end of a section of the walk -> the files visited so far, in order."""
    files: list[str] = []
    sections: dict[str, list[str]] = {}
    known: set[CodeType] = set()

    def watch(frame: FrameType, event: str, _: object) -> None:
        code = frame.f_code
        if not (path := Path(code.co_filename)).is_relative_to(PACKAGE):
            return
        file = path.relative_to(PACKAGE).as_posix()
        if event == "call" and code not in known:
            known.add(code)
            is_function = bool(code.co_flags & inspect.CO_OPTIMIZED) and code.co_name[0] != "<"
            length = len({line for *_, line in code.co_lines()} - {code.co_firstlineno, None})
            if is_function and length > 1 and file != "lazy.py":
                files.append(file)
        elif event == "return" and file.startswith(ENDS.get(code.co_name, "-")):
            sections[code.co_name] = [name for name, _ in groupby(files)]

    sys.setprofile(watch)
    try:
        simulate(scene)
    finally:
        sys.setprofile(None)
    return sections


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-v", action="store_true", help="print the walk to the assembled model")
    prints_walk = parser.parse_args().v
    for name, scene in SCENES.items():
        for end, files in walk(scene).items():
            count = len(set(files))
            print(f"{name}, to the end of {end}: {count} files, {len(files) - count} returns")
            if prints_walk and end == "build":
                print(*files, sep="\n")
