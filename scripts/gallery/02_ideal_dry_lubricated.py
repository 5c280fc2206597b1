"""A slider-crank with an ideal, a dry and a lubricated crank pin: what each does to the slider."""

from exu_press import Scene, simulate

scene = Scene(mechanism="slider_crank", joints={}, revolutions=0.5)
peaks = {}
for kind in ("ideal", "dry", "lubricated"):
    result = simulate(scene.replace({"joints.crank_pin": kind}))
    resolved = result.quantity("peak_acceleration.resolved").value
    averaged = result.quantity("peak_acceleration.mean_1ms").value
    peaks[kind] = resolved, averaged
    print(f"{kind:10}  resolved {resolved:9.3f} m/s^2, mean over 1 ms {averaged:8.3f} m/s^2")
