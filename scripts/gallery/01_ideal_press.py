"""The press with ideal joints, against the closed form of its motion."""

import numpy as np

from exu_press import Scene, simulate

scene = Scene(joints={}, revolutions=1.0, speed_rpm=240.0)
result = simulate(scene)

angle = scene.start_angle + scene.angular_speed * result.time
position, _, _ = scene.build().mechanism.ideal_slider(angle, scene.angular_speed)
deviation = np.abs(result["slider_position"] - position).max()
stroke = result.quantity("stroke").value
print(f"stroke {1e3 * stroke:.3f} mm, off the closed form by {deviation:.1e} m")
