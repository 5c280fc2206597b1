"""A planet on the crank, geared 1 : -2, lets the ram rest: its path and its closed form."""

import numpy as np

from exu_press import Scene, simulate
from exu_press.mechanism import shipped_mechanism

press = shipped_mechanism("cycloidal_press")
turn = np.radians(np.arange(0.0, 361.0))
pin = 1j * (0.08 * np.exp(1j * turn) + 0.0276 * np.exp(-2j * turn))
closed_form = pin.imag - np.sqrt(0.6**2 - pin.real**2)
position = press.ideal_slider(turn, 1.0)[0]
deviation = float(np.abs(position - closed_form).max())
rest = float(np.ptp(position[160:201]))
result = simulate(Scene(mechanism=press, joints={}, speed_rpm=60.0, revolutions=1.0))
torque = result.quantity("gears.planet.peak_torque").value
print(f"deviation from the hypocycloid {deviation:.1e} m")
print(f"20 deg about the bottom: within {1e6 * rest:.0f} um of {1e3 * np.ptp(position):.0f} mm")
print(f"torque of the gear up to {torque:.0f} N m")
