"""A load beside the middle of a two-point press: the force of each point, and the slide's tilt."""

from importlib.resources import files

from exu_press import Scene, simulate

scene = Scene.load(files("exu_press.scenes") / "two_point_press.toml")
force, offset, reach = 6e5, 0.1, 0.3
weight = 9.81 * 1500.0
result = simulate(scene)
print("point  lever rule, kN  largest force in the run, kN")
shares, peaks = {}, {}
for side, sign in (("left", -1.0), ("right", 1.0)):
    shares[side] = 0.5 * (force * (1.0 + sign * offset / reach) - weight)
    peaks[side] = result.quantity(f"joints.wrist_pin_{side}.peak_force").value
    print(f"{side:5}  {1e-3 * shares[side]:14.1f}  {1e-3 * peaks[side]:28.1f}")
tilt = result.quantity("slider_tilt").value
print(f"tilt of the slide {1e6 * tilt:.1f} urad, in clearances of 50 um and an elastic guide")
