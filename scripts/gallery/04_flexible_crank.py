"""The press with a rigid and with a flexible crank shaft: what elasticity does to a dry pin."""

from exu_press import Scene, simulate

scene = Scene(joints={"crank_pin": "dry"}, revolutions=0.02)
forces = {}
for kind, bodies in (("rigid", {}), ("flexible", {"crank": {"flexible": "crank", "modes": 4}})):
    result = simulate(scene.replace({"bodies": bodies}))
    forces[kind] = result.quantity("joints.crank_pin.peak_force").value
    print(f"{kind:8}  largest force in the pin {1e-3 * forces[kind]:7.2f} kN")
