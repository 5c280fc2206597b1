"""Compile joints and laws with mypyc: the same sources, two to four times as fast.

EXU_PRESS_COMPILE=1 demands it, 0 forbids it. By default an ordinary install does it where there is
a C compiler and stays in Python where that fails; `build_backend.is_compiled` decides.

Every module is a C file of its own; they are compiled side by side, without debug information and
with -O1: with -O3, which takes half as long again, runs are no faster.
"""

import gc
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from setuptools import setup
from setuptools.command.build_ext import build_ext

from build_backend import is_compiled

MODULES = [
    "integrate/constraints",
    "integrate/controller",
    "integrate/criteria/eccentricity",
    "integrate/criteria/film_force",
    "integrate/criteria/velocity",
    "integrate/error",
    "integrate/initial_conditions",
    "integrate/jacobian",
    "integrate/modal_mass",
    "integrate/monitor",
    "integrate/newton_filter",
    "integrate/predictor",
    "integrate/resolution",
    "integrate/scales",
    "integrate/stepping",
    "integrate/system",
    "integrate/user_functions",
    "integrate/variable_step",
    "joints/ends",
    "joints/user_force",
    "joints/interface",
    "joints/joint",
    "joints/path",
    "joints/planar",
    "joints/spatial",
    "joints/spherical",
    "joints/guideway",
    "joints/guideway_film",
    "joints/moving_guideway",
    "joints/oriented",
    "joints/worn",
    "laws/contact/damping",
    "laws/contact/stiffness",
    "laws/film/asperities",
    "laws/film/contract",
    "laws/film/finite_bearing",
    "laws/film/long_bearing",
    "laws/film/plane_pad",
    "laws/film/short_bearing",
    "laws/friction",
    "laws/profile",
    "numerics/floats",
]
"""What is called in every Newton iteration, and for every joint in every step."""

STUBS = {
    "build/stubs/numpy/__init__.pyi": """from typing import Any
def __getattr__(name: str) -> Any: ...
""",
    "build/stubs/numpy/typing.pyi": """from typing import Any, TypeVar
T = TypeVar("T")
NDArray = Any | T
""",
}
"""What mypyc has to know of NumPy: its own types take three times as long to install and to read as
all else, and an array is an object in C, whatever is in it."""

ASKED = os.environ.get("EXU_PRESS_COMPILE", "")


class BuildCompiled(build_ext):
    """Where compiling was not demanded, its failure leaves the package in Python."""

    def build_extensions(self) -> None:
        """Compile the C files side by side; setuptools would do one after the other."""
        print("compiling them", flush=True)
        one_after_the_other = self.compiler.compile

        def side_by_side(sources: list[str], *args: Any, **options: Any) -> list[str]:
            def compiled(source: str) -> list[str]:
                return list(one_after_the_other([source], *args, **options))

            with ThreadPoolExecutor(os.cpu_count()) as pool:
                return [file for files in pool.map(compiled, sources) for file in files]

        self.compiler.compile = side_by_side
        super().build_extensions()

    def run(self) -> None:
        """Compile all modules or none."""
        try:
            super().run()
        except Exception as error:
            if ASKED:
                raise
            print(f"joints and laws stay in Python, compiling them failed: {error}")
            for output in self.get_outputs():
                Path(output).unlink(missing_ok=True)
            self.extensions = []


def extensions() -> list:
    """Return the modules to be compiled; none while the build only asks what it needs."""
    if not {"bdist_wheel", "editable_wheel", "build_ext"} & set(sys.argv):
        return []
    from mypyc.build import mypycify

    print(f"translating {len(MODULES)} modules of joints, laws and steps to C", flush=True)
    for name, text in STUBS.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text, encoding="utf-8")
    os.environ["MYPYPATH"] = "build/stubs"
    gc.disable()  # of a million of mypy's objects, all in use
    # what is installed beside is not read: Bokeh's types would take minutes
    options = ["--config-file=", "--no-site-packages", "--ignore-missing-imports"]
    options += ["--follow-imports=silent"]
    sources = [f"exu_press/{module}.py" for module in MODULES]
    try:
        found = mypycify(
            options + sources,
            opt_level="1",
            debug_level="0",
            multi_file=True,
            include_runtime_files=True,  # in one of the C files: a dozen of few lines otherwise
            group_name="exu_press",
        )
    except SystemExit:  # its type check failed
        if ASKED:
            raise
        print("joints and laws stay in Python, their types could not be checked")
        return []
    gc.freeze()  # or the end of this process would take as long as the translation
    for extension in found:
        # a newer compiler's warnings are no errors; a fused a * b + c would round differently
        extension.extra_compile_args = [
            flag for flag in extension.extra_compile_args if flag != "-Werror"
        ] + ["-ffp-contract=off"] * (os.name == "posix")
    return found


setup(
    ext_modules=extensions() if is_compiled(editable="editable_wheel" in sys.argv) else [],
    cmdclass={"build_ext": BuildCompiled},
)
