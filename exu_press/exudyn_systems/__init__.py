"""Systems without clearance joints: constant steps, refined until their results agree."""

from exu_press.exudyn_systems.solve import solve_dynamic

__all__ = ["solve_dynamic"]
