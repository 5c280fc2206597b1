"""What a lubricated slider-crank does in the long run: its period, and whether it is chaotic."""

from exu_press import Scene
from exu_press.studies.attractor import attractor

scene = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.03}},
    film={"law": "short", "length": 0.05, "viscosity": 0.1},
)
motion = attractor(scene, revolutions=20, skip=5, most=2)
exponent, low, high = motion.per_second
print(f"period: {motion.period}")
print(f"largest Lyapunov exponent below {high:.3g} 1/s")
