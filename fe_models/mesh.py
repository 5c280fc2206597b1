"""Second-order tetrahedra of a part's solid, by Netgen. Same part, same mesh."""

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import ngsolve as ngs  # type: ignore[import-untyped]
from netgen.occ import OCCGeometry  # type: ignore[import-untyped]

from fe_models.errors import InputError
from fe_models.part import Part

__all__ = ["generate_mesh"]


def generate_mesh(part: Part) -> Any:
    """Return an ngsolve mesh with curved second-order elements.

    Meshing parallel is slower on a busy machine and not reproducible, so it is off.
    """
    ngs.SetNumThreads(1)
    shape = part.geometry.build()
    known = {face.name for face in shape.faces if face.name is not None}
    for interface in part.interfaces:
        if interface.face not in known:
            raise InputError(
                f"{part.name}: the shape has no face named {interface.face!r}; its faces are named "
                f"{', '.join(repr(name) for name in sorted(known)) or 'nothing at all'}"
            )
    try:
        with _quiet():
            geometry = OCCGeometry(shape)
            netgen_mesh = geometry.GenerateMesh(maxh=part.mesh_size, parallel_meshing=False)
        tetrahedra = netgen_mesh.Elements3D()
        if len(tetrahedra) == 0:
            raise RuntimeError("no tetrahedra: is the shape a closed solid?")
        netgen_mesh.SecondOrder()
    except Exception as error:
        raise InputError(
            f"{part.name}: meshing failed at mesh_size = {part.mesh_size:g} m ({error}); "
            "try a smaller one, and check that the shape is one closed solid in m"
        ) from error
    return ngs.Mesh(netgen_mesh)


@contextmanager
def _quiet() -> Iterator[None]:
    """Drop what Netgen prints: of a mesh that fails a thousand lines, whatever its message level.

    Its errors are left, as it may end the process with one.
    """
    sys.stdout.flush()
    c_library = ctypes.CDLL(None)
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        c_library.fflush(None)
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)
