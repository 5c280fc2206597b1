"""Mechanisms drawn for the tests."""

from cmath import exp, rect
from math import radians

from exu_press.mechanism import GROUND, Body, Guide, Joint, Mechanism, Output


def point(z):
    return z.real, z.imag


def meeting(a, length_a, b, length_b, side):
    """Where links from a and b meet, to the left of the way from a to b for side +1."""
    base = b - a
    along = (length_a**2 - length_b**2 + abs(base) ** 2) / (2 * abs(base))
    return a + (along + 1j * side * (length_a**2 - along**2) ** 0.5) * base / abs(base)


def links(**ends):
    """Uniform rods of 1 kg between two places each."""
    return tuple(
        Body(name, 1.0, centre_of_mass=point((a + b) / 2)) for name, (a, b) in ends.items()
    )


def four_bar(crank=0.1, coupler=0.4, rocker=0.3, base=0.35, at=0.7, side=1, **given):
    a, b = rect(crank, at), complex(base)
    c = meeting(a, coupler, b, rocker, side)
    return Mechanism(
        name="four_bar",
        bodies=links(crank=(0j, a), coupler=(a, c), rocker=(b, c)),
        joints=(
            Joint("shaft", (0.0, 0.0), "crank", GROUND),
            Joint("crank_pin", point(a), "crank", "coupler"),
            Joint("knuckle", point(c), "coupler", "rocker"),
            Joint("pivot", point(b), GROUND, "rocker"),
        ),
        guides=(),
        crank="crank",
        output=Output("rocker"),
        **given,
    )


def slider_crank(tilt=0.0, offset=0.0, crank=0.1, rod=0.4, at=0.7, second_rod=False):
    """A slider-crank whose guide points at an angle, beside the shaft."""
    direction = exp(1j * tilt)
    a = rect(crank, at)
    local = a / direction
    b = direction * (local.real + (rod**2 - (offset - local.imag) ** 2) ** 0.5 + 1j * offset)
    rods = ("rod", "other_rod") if second_rod else ("rod",)
    joints = [Joint("shaft", (0.0, 0.0), "crank", GROUND)]
    for name in rods:
        joints += [
            Joint(f"{name}_big_end", point(a), "crank", name),
            Joint(f"{name}_small_end", point(b), name, "slider"),
        ]
    return Mechanism(
        name="tilted",
        bodies=(
            *links(crank=(0j, a), **dict.fromkeys(rods, (a, b))),
            Body("slider", 2.0, 0.01, centre_of_mass=point(b)),
        ),
        joints=tuple(joints),
        guides=(Guide("slider", point(direction)),),
        crank="crank",
        output=Output("slider", point(direction)),
    )


def coupled_cranks(length=0.4, crank=0.1):
    """Two cranks a quarter turn apart on each of two axles, with two parallel coupling rods."""
    first, second, base = complex(crank), crank * 1j, complex(length)
    return Mechanism(
        name="coupled_cranks",
        bodies=(
            Body("crank", 1.0, 0.01),
            Body("follower", 1.0, 0.01, point(base)),
            *links(rod=(first, base + first), other_rod=(second, base + second)),
        ),
        joints=(
            Joint("shaft", (0.0, 0.0), "crank", GROUND),
            Joint("axle", point(base), "follower", GROUND),
            Joint("pin", point(first), "crank", "rod"),
            Joint("far_pin", point(base + first), "follower", "rod"),
            Joint("other_pin", point(second), "crank", "other_rod"),
            Joint("other_far_pin", point(base + second), "follower", "other_rod"),
        ),
        guides=(),
        crank="crank",
        output=Output("follower"),
    )


def stephenson():
    """A six-bar whose four links that are not known after the crank close together only.

    The crank swings the middle of a link that hangs on two rockers.
    """
    a = rect(0.03, radians(200.0))
    end = a + 0.3
    left, right = end + complex(-0.15, -0.05), end + complex(0.15, -0.05)
    pivot_left, pivot_right = left + complex(-0.03, 0.35), right + complex(0.04, 0.33)
    return Mechanism(
        name="stephenson",
        bodies=(
            Body("crank", 1.0, 0.01),
            *links(rod=(a, end)),
            Body("ternary", 3.0, 0.02, point(end)),
            *links(rocker_left=(pivot_left, left), rocker_right=(pivot_right, right)),
        ),
        joints=(
            Joint("shaft", (0.0, 0.0), "crank", GROUND),
            Joint("pin", point(a), "crank", "rod"),
            Joint("rod_end", point(end), "rod", "ternary"),
            Joint("left", point(left), "ternary", "rocker_left"),
            Joint("right", point(right), "ternary", "rocker_right"),
            Joint("pivot_left", point(pivot_left), "rocker_left", GROUND),
            Joint("pivot_right", point(pivot_right), "rocker_right", GROUND),
        ),
        guides=(),
        crank="crank",
        output=Output("ternary"),
    )
