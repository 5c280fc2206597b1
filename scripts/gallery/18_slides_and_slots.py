"""Slides and slots between moving bodies: seven linkages, and a block that is loose on its arm."""

import numpy as np

from exu_press import Scene, simulate
from exu_press.mechanism import shipped_mechanism

LINKAGES = (
    "whitworth",
    "crank_shaper",
    "inverted_slider_crank",
    "oscillating_cylinder",
    "oldham",
    "scotch_yoke",
    "elliptic_trammel",
)
angle = np.linspace(0.0, 2.0 * np.pi, 3600, endpoint=False)
travels, torques = {}, {}
for name in LINKAGES:
    mechanism = shipped_mechanism(name)
    position = mechanism.ideal_slider(angle, 1.0)[0]
    travels[name] = float(np.ptp(position))
    result = simulate(Scene(mechanism=name, speed_rpm=120.0, revolutions=1.0))
    torques[name] = result.quantity("drive.peak_torque").value
    unit = mechanism.output.unit
    print(f"{name:22s} travel {travels[name]:.4f} {unit}, torque to {torques[name]:.3g} N m")

forces = {}
for clearance in (1e-5, 5e-5):
    guide = {"clearance": clearance, "length": 0.04, "width": 0.02, "lateral_stiffness": 1e8}
    scene = Scene(mechanism="inverted_slider_crank", revolutions=0.25, guide=guide)
    forces[clearance] = simulate(scene).quantity("guides.block.peak_force").value
    print(f"block with {1e6 * clearance:.0f} um of play: {forces[clearance]:.0f} N on the arm")
