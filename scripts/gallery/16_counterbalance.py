"""An air cylinder that bears the slide, and the torque of the drive without and with it."""

from dataclasses import replace

from exu_press import Scene, simulate
from exu_press.mechanism import shipped_mechanism
from exu_press.mechanism.springs import GasSpring

press = shipped_mechanism("eccentric_press")
slide = press.body(press.slider)
foot = (0.0, slide.centre_of_mass[1] - 0.8)
area, weight = 0.03, 9.81 * slide.mass
cylinder = GasSpring(
    "counterbalance",
    ("frame", slide.name),
    (foot, slide.centre_of_mass),
    area=area,
    pressure=101325.0 + weight / area,
    volume=0.2,
    exponent=1.3,
)
torques = {}
for label, springs in (("without", ()), ("with", (cylinder,))):
    mechanism = replace(press, springs=springs)
    result = simulate(Scene(mechanism=mechanism, joints={}, speed_rpm=30.0, revolutions=1.0))
    torques[label] = result.quantity("drive.peak_torque").value
    print(f"{label:8}drive torque up to {torques[label]:7.1f} N m")
pressure = result.quantity("springs.counterbalance.peak_pressure").value
print(f"pressure of the air {1e-5 * cylinder.pressure:.2f} to {1e-5 * pressure:.2f} bar")
