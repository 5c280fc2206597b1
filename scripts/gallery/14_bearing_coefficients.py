"""Stiffness, damping and side flow of a bearing under three loads, and the mass that whirls."""

from exu_press import Scene, bearing_coefficients

scene = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.05}},
    film={"law": "finite", "length": 0.05, "viscosity": 0.05},
)
bearings = {
    load: bearing_coefficients(scene, "crank_pin", load=(0.0, -load), speed_rpm=300.0)
    for load in (200.0, 1000.0, 5000.0)
}
for load, bearing in bearings.items():
    print(f"{load:4.0f} N: eccentricity ratio {bearing.eccentricity_ratio:.3f}")
    print(f"  stiffness downwards {1e-6 * bearing.stiffness[1, 1]:.1f} MN/m")
    print(f"  side flow {6e4 * bearing.side_flow:.2f} l/min, power {bearing.power:.1f} W")
    print(f"  critical mass {bearing.critical_mass:.3g} kg")
