"""What restitution contact parameters deliver: the paper's, and what c_max does to them.

Run with: python scripts/contact_restitution.py
"""

import argparse

from exu_press import Scene
from exu_press.laws.contact import DAMPING_LAWS, delivered_restitution, hertz, step_damping

argparse.ArgumentParser(description=__doc__).parse_args()
contact = Scene().contact
assert contact is not None
stiffness = hertz(contact["stiffness"], contact["exponent"])
mass = 1347.0  # slider, kg
speeds = (0.01, 0.1, 1.0)  # m/s


def row(name, law):
    values = "".join(f"{delivered_restitution(law, mass, speed):11.2g}" for speed in speeds)
    print(f"{name:44}{values}")


print(f"{'restitution of the slider at':44}" + "".join(f"{v:>7} m/s" for v in speeds))
default = contact["damping_max"]
for damping in (default, default / 100, default / 1000, default / 1e4, 0.01):
    law = step_damping(stiffness, damping, contact["damping_depth"])
    name = f"step, damping_max = {damping:.4g} N s/m"
    row(name + (" (Table 2)" if damping == default else ""), law)
for name in ("hunt_crossley", "lankarani_nikravesh", "flores", "gonthier", "hu_guo"):
    row(f"{name}, wanted 0.5", DAMPING_LAWS[name](stiffness, restitution=0.5))
