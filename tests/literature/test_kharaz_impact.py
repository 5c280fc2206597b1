"""A sphere that meets a plate obliquely, as it was photographed: friction and spin of an impact."""

import math

import exudyn as exu
import numpy as np
import pytest
from data import columns_of
from stand_in_system import planar_body, recorded, settings

from exu_press import solve_dynamic
from exu_press.joints import add_guideway_contact
from exu_press.laws.contact import hertz, hertz_stiffness, hu_guo
from exu_press.laws.friction import coulomb

TABLE = columns_of("kharaz_oblique_impact.csv")
RADIUS, DENSITY, SPEED = 2.5e-3, 4000.0, 3.9  # m, kg/m^3, m/s
MODULUS = 1.0 / ((1.0 - 0.23**2) / 380e9 + (1.0 - 0.25**2) / 70e9)  # Pa
RESTITUTION, FRICTION = 0.98, 0.092  # measured by the authors
MASS = DENSITY * 4.0 / 3.0 * math.pi * RADIUS**3
CLEARANCE, FLIGHT = 1e-3, 1e-5  # m beside the plate, m before the impact
SLIDES = 32.0  # deg, above which a rigid sphere slides during all of the impact


def rebound(angle_deg, tolerance):
    """Return tangential restitution, spin and angle of rebound after an impact at an angle."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    angle = math.radians(angle_deg)
    along, down = SPEED * math.sin(angle), -SPEED * math.cos(angle)
    place, velocity = [0.0, FLIGHT - CLEARANCE, 0.0], [along, down, 0]
    body, node = planar_body(mbs, MASS, 0.4 * MASS * RADIUS**2, place, velocity)
    add_guideway_contact(
        mbs,
        (body, (0.0, 0.0)),
        middle=(0.0, 0.0),
        direction=(1.0, 0.0),
        clearance=CLEARANCE,
        contact=hu_guo(hertz(hertz_stiffness(RADIUS, MODULUS)), RESTITUTION),
        friction=coulomb(FRICTION, 1e-4),
        half_width=RADIUS,
    )
    sensor = recorded(mbs, node, "Coordinates_t")
    mbs.Assemble()
    end = 6.0 * FLIGHT / SPEED / math.cos(angle) + 4e-5
    chosen = settings(end, 50, period=0.0, minimumStepSize=1e-14)
    solve_dynamic(mbs, chosen, tolerance=tolerance).check()
    _, x, y, spin = mbs.GetSensorStoredData(sensor)[-1]
    container.Reset()
    assert y == pytest.approx(-RESTITUTION * down, rel=1e-2)  # it has left the plate
    return {
        "tangential restitution": x / along,
        "spin": -spin,
        "angle of rebound": math.degrees(math.atan2(x, y)),
    }


@pytest.mark.validation(
    "measurement",
    "oblique impact of a sphere of aluminium oxide, 5 mm, on glass, 3.9 m/s",
    "A. H. Kharaz, D. A. Gorham, A. D. Salman, Powder Technology 120 (2001) 281-291, as digitised "
    "in chaos-polymtl/lethe (examples/dem/3d-oblique-wall-impact)",
    "measured numbers as there; its code is LGPL-3.0",
    "Restitution 0.98 and friction 0.092 are the authors'; all else follows from sizes and moduli. "
    "Below 32 degrees the surfaces stick: the elastic deformation along the plate then makes the "
    "sphere spin faster than rolling, by up to 43 %. The package's contact has none along the "
    "surface.",
)
@pytest.mark.parametrize(
    ("quantity", "unit", "sticking", "sliding"),
    [
        ("tangential restitution", "", 0.21, 0.02),
        ("spin", "rad/s", 0.32, 0.1),
        ("angle of rebound", "deg", 0.3, 0.03),
    ],
)
@pytest.mark.long
def test_rebound(quantity, unit, sticking, sliding, compare):
    rows = (TABLE["quantity"] == quantity) & (TABLE["angle_deg"] > 1.0)
    angle, theirs = TABLE["angle_deg"][rows], TABLE["value"][rows]
    ours, coarse = (
        np.array([rebound(degrees, tolerance)[quantity] for degrees in angle])
        for tolerance in (1e-4, 1e-3)
    )
    for name, where, rel in (
        ("sliding", angle > SLIDES, sliding),
        ("sticking", angle < SLIDES, sticking),
    ):
        error = np.abs(ours - coarse)[where]
        compare(f"{quantity}, {name}", theirs[where], ours[where], error=error, rel=rel, unit=unit)
