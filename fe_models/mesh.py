"""Second-order tetrahedra of a part's solid, by Netgen. Same part, same mesh."""

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
        netgen_mesh = OCCGeometry(shape).GenerateMesh(maxh=part.mesh_size, parallel_meshing=False)
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
