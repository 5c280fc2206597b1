"""The base of all studies: a file, keys that vary, runs side by side, their rows."""

from exu_press.studies.base.keys import Key, Normal, Range, Values
from exu_press.studies.base.runs import Row, Runs, arguments_of, row_of, run_scene, scene_from
from exu_press.studies.base.study import Study, load_study

__all__ = [
    "Key",
    "Normal",
    "Range",
    "Row",
    "Runs",
    "Study",
    "Values",
    "arguments_of",
    "load_study",
    "row_of",
    "run_scene",
    "scene_from",
]
