"""A blanking press in the shop: motor, flywheel, a sheet that is cut, oil that warms, a guide."""

from importlib.resources import files

from exu_press import Scene, simulate

scene = Scene.load(files("exu_press.scenes") / "drag_link_shop.toml")
result = simulate(scene.replace({"revolutions": 2.0, "settle": 1.0}))
force = result.quantity("loads.sheet.peak_force").value
motor = result.quantity("drive.peak_torque").value
crank = result.quantity("drive.peak_crank_torque").value
print(f"the cut takes {1e-3 * force:.1f} kN, and {1e-3 * crank:.2f} kN m at the crank")
print(f"the motor gives {motor:.0f} N m at most; the flywheel gives the rest")
