"""fe_models: reduced flexible bodies from solid geometry, by NGSolve, for Exudyn.

A part (geometry, material, interfaces, mesh size) becomes a `ReducedPart` (modes, reduced matrices,
interface motions), which becomes an ObjectFFRFreducedOrder. What is imported here costs nothing
until it is used: NGSolve is loaded only where a part is meshed, never for one read from the cache.
"""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from fe_models.cache import default_folder, reduced_part
    from fe_models.clamped import ConvergenceRow, clamped_frequencies, mesh_convergence
    from fe_models.exudyn_body import FlexibleBody, add_flexible_body
    from fe_models.geometry import Axis, CrankShape, LinkageShape, OwnShape, Patch, Sides, StepFile
    from fe_models.material import CRANK_STEEL, LINKAGE_IRON, Material
    from fe_models.matrices import MatrixPart, write_matrices
    from fe_models.part import Interface, Part, shipped_faces, shipped_part
    from fe_models.pictures import draw_mode_shapes
    from fe_models.reduced import ReducedInterface, ReducedPart
    from fe_models.reduction import Reduction

__all__ = [
    "CRANK_STEEL",
    "LINKAGE_IRON",
    "Axis",
    "ConvergenceRow",
    "CrankShape",
    "FlexibleBody",
    "Interface",
    "LinkageShape",
    "Material",
    "MatrixPart",
    "OwnShape",
    "Part",
    "Patch",
    "ReducedInterface",
    "ReducedPart",
    "Reduction",
    "Sides",
    "StepFile",
    "add_flexible_body",
    "clamped_frequencies",
    "default_folder",
    "draw_mode_shapes",
    "mesh_convergence",
    "reduced_part",
    "shipped_faces",
    "shipped_part",
    "write_matrices",
]

__getattr__ = lazy_names(__name__)
