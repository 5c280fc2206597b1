"""A free slider-crank whose slider has clearance in its guide, against Siconos' set-valued contact.

P. Flores, R. Leine, C. Glocker, Modeling and analysis of planar rigid multibody systems with
translational clearance joints based on the non-smooth dynamics approach, Multibody System Dynamics
23 (2010) 165-190: no drive, Newton's restitution 0.4, friction 0.01.
"""

import math

import numpy as np
import pytest
from data import columns_of
from planar_mechanism import GRAVITY, PlanarMechanism
from scipy.optimize import brentq

from exu_press.joints import add_guideway_contact
from exu_press.laws.contact import hertz, hu_guo, restitution_of
from exu_press.laws.friction import coulomb

CRANK, ROD, HALF_LENGTH, HALF_HEIGHT, CLEARANCE = 0.153, 0.306, 0.05, 0.025, 1e-3  # m
MASS, INERTIA = (0.038, 0.038, 0.076), (7.4e-5, 5.9e-4, 2.7e-6)  # kg, kg m^2
START = 150.0, -75.0  # rad/s of crank and rod, all along x
STIFFNESS, INTERVAL = 1e9, 4e-4  # N/m^1.5, s between their rows
TABLE = columns_of("siconos_slider_crank.csv")

SICONOS = pytest.mark.validation(
    "code",
    "free slider-crank, clearance 1 mm in its guide, restitution 0.4",
    "Siconos (siconos/siconos-tutorials b6c9bfd1, examples/mechanics/SliderCrank), Moreau-Jean "
    "with direct and with combined projection",
    "Apache-2.0",
    "Nothing drives the crank, and their energy grows: by 0.9 % in the 2.4 ms before the first "
    "impact, where nothing acts but gravity, and by 14 % in 200 ms. Their steps are 0.1 ms. Ours "
    "keeps it between impacts. After the first impact their two projections differ by a tenth of "
    "the clearance.",
)


def energy(crank, rod, spins):
    """Return the energy of the mechanism, J, from angles and angular velocities (3, n)."""
    middle, end = 0.25 * MASS[1] + MASS[2], 0.5 * MASS[1] + MASS[2]
    first = INERTIA[0] + (0.25 * MASS[0] + MASS[1] + MASS[2]) * CRANK**2
    both = end * CRANK * ROD * np.cos(rod - crank)
    second = INERTIA[1] + middle * ROD**2
    kinetic = first * spins[0] ** 2 + 2.0 * both * spins[0] * spins[1] + second * spins[1] ** 2
    height = (0.5 * MASS[0] + MASS[1] + MASS[2]) * CRANK * np.sin(crank) + end * ROD * np.sin(rod)
    return 0.5 * (kinetic + INERTIA[2] * spins[2] ** 2) + GRAVITY * height


def restitution_for(delivered):
    """Return the key with which Hu and Guo's law delivers a restitution."""
    return brentq(lambda e: restitution_of(1.5 * (1.0 - e) / e) - delivered, 0.05, 0.95)


def run(tolerance, end, interval):
    """Return times, angles and angular velocities (3, n) and the slider's height (n,)."""
    mechanism = PlanarMechanism()
    pin = CRANK * START[0]
    starts = (
        (0.5 * CRANK, 0.5 * pin, START[0]),
        (CRANK + 0.5 * ROD, pin + 0.5 * ROD * START[1], START[1]),
        (CRANK + ROD, 0.0, 0.0),
    )
    crank, rod, slider = (
        mechanism.add_body(mass, inertia, (x, 0.0, 0.0), (0.0, speed, spin))
        for (x, speed, spin), mass, inertia in zip(starts, MASS, INERTIA, strict=True)
    )
    mechanism.add_pin((mechanism.ground, 0.0), (crank, -0.5 * CRANK))
    mechanism.add_pin((crank, 0.5 * CRANK), (rod, -0.5 * ROD))
    mechanism.add_pin((rod, 0.5 * ROD), (slider, 0.0))
    for corner in (-HALF_LENGTH, HALF_LENGTH):
        add_guideway_contact(
            mechanism.mbs,
            (slider, (corner, 0.0)),
            middle=(0.0, 0.0),
            direction=(1.0, 0.0),
            clearance=CLEARANCE,
            contact=hu_guo(hertz(STIFFNESS), restitution_for(0.4)),
            friction=coulomb(0.01, 1e-4),
            half_width=HALF_HEIGHT,
        )
    times, poses, velocities = mechanism.run(tolerance, end, interval)
    return times, poses[:, :, 2], velocities[:, :, 2], poses[2, :, 1]


def theirs(projection, times):
    """Return their rows at instants."""
    rows = TABLE["projection"] == projection
    at = np.searchsorted(TABLE["t"][rows], times - 1e-9)
    assert TABLE["t"][rows][at] == pytest.approx(times, abs=1e-9)
    return {name: column[rows][at] for name, column in TABLE.items() if name != "projection"}


@SICONOS
@pytest.mark.long
def test_to_the_second_impact(compare):
    """The first impact is at 2.7 ms, the second at 5.6 ms with one projection."""
    times, angles, _, height = run(1e-4, 5.2e-3, INTERVAL)
    coarse = run(1e-3, 5.2e-3, INTERVAL)
    free = times < 2.5e-3
    for projection in ("Direct", "Combined"):
        table = theirs(projection, times)
        rod, error = angles[1], np.abs(angles[1] - coarse[1][1])
        name = f"angle of the rod to the first impact, {projection.lower()}"
        compare(name, table["theta2"][free], rod[free], error=error[free], abs=3e-4, unit="rad")
        name = f"height of the slider over the clearance to the second impact, {projection.lower()}"
        ratio, error = height / CLEARANCE, np.abs(height - coarse[3]) / CLEARANCE
        compare(name, table["y_slider_over_c"], ratio, error=error, abs=0.09)


@SICONOS
@pytest.mark.long
def test_energy(compare):
    """Ours is that of the start until the first impact, and never grows."""
    times, angles, spins, _ = run(1e-3, 0.2, 2e-3)
    ours = energy(angles[0], angles[1], spins)
    assert ours[times < 2.5e-3] == pytest.approx(ours[0], rel=2e-4)
    assert np.diff(ours).max() < 2e-4 * ours[0]
    finer = run(3e-4, 0.2, 2e-3)
    error = abs(energy(finer[1][0], finer[1][1], finer[2])[-1] - ours[-1])
    for projection in ("Direct", "Combined"):
        table = theirs(projection, times)
        spin = np.array([table[f"omega{i}"] for i in (1, 2, 3)])
        their = energy(2.0 * math.pi * table["crank_rev"], table["theta2"], spin)
        name = f"energy after 200 ms, {projection.lower()}"
        compare(name, their[-1], ours[-1], error=error, rel=0.2, unit="J")
