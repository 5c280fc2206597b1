"""A mechanism of your own, as dataclasses: a toggle press; then with a worn pin."""

from exu_press import Mechanism, Scene, simulate
from exu_press.mechanism import GROUND, Body, Guide, Joint, Output

mechanism = Mechanism(
    name="toggle",
    bodies=(
        Body("crank", 5.0, centre_of_mass=(0.025, 0.0)),
        Body("rod", 4.0, centre_of_mass=(0.16, 0.05)),
        Body("rocker", 3.0, centre_of_mass=(0.26, 0.2)),
        Body("link", 3.0, centre_of_mass=(0.26, 0.0)),
        Body("ram", 20.0, inertia=0.1, centre_of_mass=(0.25, -0.1)),
    ),
    joints=(
        Joint("shaft", (0.0, 0.0), "crank", GROUND),
        Joint("crank_pin", (0.05, 0.0), "crank", "rod"),
        Joint("knee", (0.27, 0.1), "rod", "rocker"),
        Joint("pivot", (0.25, 0.3), "rocker", GROUND),
        Joint("upper_pin", (0.27, 0.1), "link", "rocker"),
        Joint("ram_pin", (0.25, -0.1), "link", "ram"),
    ),
    guides=(Guide("ram", (0.0, 1.0)),),
    crank="crank",
    output=Output("ram", (0.0, 1.0)),
)
scene = Scene(mechanism=mechanism, joints={}, speed_rpm=120.0, revolutions=1.0)
ideal = simulate(scene)
pin = {"kind": "dry", "clearance": 2e-4, "radius": 0.02, "contact": {"length": 0.04}}
worn = simulate(scene.replace({"joints.knee": pin}))
strokes = [result.quantity("stroke").value for result in (ideal, worn)]
print(f"stroke {1e3 * strokes[0]:.4f} mm, with 0.2 mm of clearance {1e3 * strokes[1]:.4f} mm")
