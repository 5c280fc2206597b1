"""The law of clutch and brake: passive, without creep, and slipping at its capacity."""

import random

import pytest

from exu_press.laws.clutch import Coupling
from exu_press.laws.schedule import Ramp, Schedule


@pytest.mark.parametrize("damping", [0.0, 2.0, 200.0])
def test_a_coupling_never_gives_back_more_than_its_twist(damping):
    """Of any motion, with any capacity over time, the work into it is at least k x^2 / 2."""
    draw = random.Random(1)
    coupling, step = Coupling(1e5, damping), 1e-4
    coupling.begin(0.0, 0.0)
    angle = work = capacity = torque = 0.0
    for _ in range(4000):
        rate = draw.gauss(0.0, 1.0) * draw.choice([0.01, 1.0])
        capacity = max(0.0, capacity + draw.gauss(0.0, 2.0))
        angle += step * rate
        torque = coupling.torque(angle, rate, capacity)
        work += step * torque * rate
        assert abs(torque) <= capacity
        coupling.accept(step, angle, rate, capacity)
        twist = coupling.memory()[0]
        assert work >= 0.5 * 1e5 * twist * twist * (1.0 - 1e-9) - 1e-12
    assert work > 1.0


def test_what_holds_does_not_creep():
    """A torque below the capacity, swinging a thousand times, leaves the shaft where it was."""
    coupling = Coupling(1e5, 50.0)
    coupling.begin(0.0, 0.0)
    for number in range(1000):
        wanted = 60.0 + 39.0 * (number % 2)
        assert coupling.torque(wanted / 1e5, 0.0, 100.0) == pytest.approx(wanted, rel=1e-9)
        coupling.accept(1e-3, wanted / 1e5, 0.0, 100.0)
    assert coupling.torque(60.0 / 1e5, 0.0, 100.0) == pytest.approx(60.0, rel=1e-6)


def test_what_slips_has_its_capacity_and_holds_with_it_when_it_stops():
    coupling = Coupling(1e5, 50.0)
    coupling.begin(0.0, 0.0)
    angle = 0.0
    for _ in range(100):
        angle += 1e-3
        assert coupling.torque(angle, 1.0, 100.0) == 100.0
        assert coupling.excess_torque(angle, 1.0, 100.0) > 0.0
        coupling.accept(1e-3, angle, 1.0, 100.0)
    assert coupling.torque(angle, 0.0, 100.0) == pytest.approx(100.0, rel=1e-3)
    assert coupling.torque(angle - 5e-4, 0.0, 100.0) == pytest.approx(50.0, rel=1e-3)


def test_a_schedule_keeps_to_its_commands():
    on, off = Ramp(0.02, 0.06), Ramp(0.0, 0.01)
    brake_on = Ramp(0.1, 0.3, over_angle=True)
    schedule = Schedule(False, [0.5], [], 2.0, on, off, off, brake_on)
    assert (schedule.clutch(0.0, 0.0), schedule.brake(0.0, 0.0)) == (0.0, 1.0)
    assert schedule.corner(0.0, 0.0, 0.0) == 0.5
    schedule.accept(0.5, 0.0)
    assert (
        schedule.running and not schedule.is_engaged(0.55, 0.0) and schedule.is_engaged(0.56, 0.0)
    )
    corners, time = [], 0.5
    while time < 1.0:
        time = schedule.corner(time, 0.0, 0.0)
        corners.append(time)
    assert corners == pytest.approx([0.51, 0.52, 0.56, float("inf")])
    assert schedule.to_stop_angle(1.5) == 0.5
    remembered = schedule.memory()
    schedule.accept(1.0, 2.0)
    assert not schedule.running and schedule.done(1.0)
    assert schedule.clutch(1.005, 2.0) == pytest.approx(0.5)
    assert [schedule.brake(9.9, angle) for angle in (2.05, 2.2, 3.0)] == pytest.approx([0, 0.5, 1])
    assert schedule.corner(1.02, 2.05, 1.0) == pytest.approx(1.07)
    schedule.recall(remembered)
    assert schedule.running and schedule.to_stop_angle(1.5) == 0.5
