"""The film of a ball: its limits, and Reynolds' equation solved on the sphere by other means."""

import math
import random

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from slopes import slopes

from exu_press import InputError
from exu_press.laws.film import dissipated_power, socket_drag
from exu_press.laws.film.ball import ball
from exu_press.scene.film import BallFilm

CAPS = [math.pi / 4, 1.2, math.pi / 2]
GAUSS = np.polynomial.legendre.leggauss(200)


def closed_form(eps, cap_angle):
    """f_r of pure squeeze, integrated; a negative eps is an opening film's."""
    x, weights = GAUSS
    low = math.cos(cap_angle)
    t = 0.5 * (x + 1.0)
    x = 1.0 - (1.0 - low) * t * t  # dense at the narrow gap
    weights = weights * (1.0 - low) * t
    p = 3.0 / eps * ((1.0 - eps * x) ** -2 - (1.0 - eps * low) ** -2)
    return -2.0 * math.pi * float((p * x) @ weights)


def direct(eps, v_along, v_aside, tilt, cap_angle, rows=60, columns=80):
    """Load along and aside: volumes of the whole cap by latitude and longitude, relaxed."""
    d_theta, d_phi = cap_angle / rows, 2.0 * math.pi / columns
    theta = (np.arange(rows) + 0.5) * d_theta
    phi = np.arange(columns) * d_phi

    def at(theta, phi):
        theta, phi = np.broadcast_arrays(theta, phi)
        return np.array([np.cos(theta), np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)])

    def cubed(theta, phi):
        x, y, _ = at(theta, phi)
        return (1.0 - eps * (math.cos(tilt) * x + math.sin(tilt) * y)) ** 3

    edges = theta[:, None] + 0.5 * d_theta
    down = cubed(edges, phi) * np.sin(edges) * d_phi / d_theta
    down[-1] *= 2.0  # to the edge of the cap, half a cell
    beside = cubed(theta[:, None], phi + 0.5 * d_phi) / np.sin(theta[:, None]) * d_theta / d_phi
    places = at(theta[:, None], phi)
    area = np.sin(theta)[:, None] * d_theta * d_phi * np.ones(columns)
    number = np.arange(rows * columns).reshape(rows, columns)
    one = np.concatenate([number[:-1].ravel(), number.ravel()])
    other = np.concatenate([number[1:].ravel(), np.roll(number, -1, axis=1).ravel()])
    flow = np.concatenate([down[:-1].ravel(), beside.ravel()])
    size = rows * columns
    diagonal = np.zeros(size)
    np.add.at(diagonal, one, flow)
    np.add.at(diagonal, other, flow)
    diagonal[number[-1]] += down[-1]
    i = np.concatenate([one, other, np.arange(size)])
    j = np.concatenate([other, one, np.arange(size)])
    matrix = coo_matrix((np.concatenate([-flow, -flow, diagonal]), (i, j)), (size, size)).tocsr()
    source = ((v_along * places[0] + v_aside * places[1]) * area).ravel()
    wet = source > 0.0
    for _ in range(100):
        p = np.zeros(size)
        p[wet] = spsolve(matrix[wet][:, wet].tocsc(), source[wet])
        now = np.where(wet, p > 0.0, matrix @ p - source < -1e-9 * np.abs(source))
        if (now == wet).all():
            break
        wet = now
    load = 12.0 * p * area.ravel()
    return float(load @ places[0].ravel()), float(load @ places[1].ravel())


@pytest.mark.validation(
    "closed form",
    "squeeze film of a ball in its socket",
    "Reynolds' equation on a sphere, symmetric about its axis, integrated",
    "equation",
)
@pytest.mark.parametrize("cap_angle", CAPS)
@pytest.mark.parametrize("eps", [0.03, 0.3, 0.6, 0.9, 0.99, 0.999])
def test_squeeze_has_the_closed_form(eps, cap_angle, compare):
    law = ball(cap_angle).law
    closed = closed_form(eps, cap_angle), -closed_form(-eps, cap_angle)
    force = np.array([law(eps, 1.0, 0.0)[0], law(eps, -1.0, 0.0)[0]])
    compare("force", closed, force, error=BallFilm.law.error * np.abs(force), rel=5e-3)
    assert law(eps, 1.0, 0.0)[1] == pytest.approx(0.0, abs=1e-9 / (1.0 - eps))


@pytest.mark.parametrize("cap_angle", CAPS)
def test_at_the_centre_it_is_a_damper_in_every_direction(cap_angle):
    law, low = ball(cap_angle).law, math.cos(cap_angle)
    constant = 12.0 * math.pi * ((1.0 - low**3) / 3.0 - low * (1.0 - low**2) / 2.0)
    for angle in np.linspace(0.0, 2.0 * math.pi, 17):
        v, u = math.cos(angle), math.sin(angle)
        f_r, f_t = law(0.0, v, 2.0 * u)[:2]
        assert (f_r, f_t) == pytest.approx((-constant * v, constant * u), abs=5e-3 * constant)


@pytest.mark.parametrize("cap_angle", CAPS)
def test_towards_the_wall_it_is_a_sphere_before_a_plane(cap_angle):
    """6 pi mu r^2 v / h with r = R^2 / c, the curvatures' difference (Taylor)."""
    law = ball(cap_angle).law
    for gap, within in ((1e-2, 0.12), (1e-3, 0.02), (1e-5, 0.02)):
        limit = -6.0 * math.pi / gap
        assert law(1.0 - gap, 1.0, 0.0)[0] == pytest.approx(limit, rel=within)


@pytest.mark.parametrize(
    ("eps", "angle", "cap_angle"),  # from closing over rotation to opening
    [(0.8, 0.6, math.pi / 2), (0.25, 1.57, math.pi / 2), (0.8, 2.2, 1.0)],
)
def test_the_law_is_the_film_of_a_cap_that_faces_its_load(eps, angle, cap_angle):
    """Also between the table's knots."""
    v, u = math.cos(angle), math.sin(angle)
    f_r, f_t = ball(cap_angle).law(eps, v, 2.0 * u)[:2]
    tilt = math.atan2(f_t, -f_r)
    v_along = v * math.cos(tilt) + u * math.sin(tilt)
    v_aside = v * math.sin(tilt) - u * math.cos(tilt)
    along, aside = direct(eps, v_along, v_aside, tilt, cap_angle)
    assert along == pytest.approx(math.hypot(f_r, f_t), rel=0.015)
    assert abs(aside) < 0.02 * along


@pytest.mark.parametrize("onset", [None, 0.02])
@pytest.mark.parametrize("cap_angle", CAPS)
def test_derivatives_against_differences(cap_angle, onset):
    law, rng = ball(cap_angle, onset).law, random.Random(3)
    for _ in range(200):
        eps = rng.uniform(0.01, 0.999 if onset is None else 1.05)
        at, step = [eps, rng.uniform(-1, 1), rng.uniform(-1, 1)], 1e-6 * max(1e-3, abs(1 - eps))
        response = law(*at)
        found = slopes(law, at, [step] * 3)
        off = np.abs(np.reshape(response[2:8], (2, 3)) - found[:, :2].T)
        assert (off < 1e-3 * (math.hypot(*response[:2]) + np.abs(found[:, :2].T))).all()
        assert response[9] == pytest.approx(found[0, 8], rel=1e-3, abs=1e-4)
        assert dissipated_power(response, at[1], at[2]) >= 0.0


@pytest.mark.parametrize("cap_angle", CAPS)
@pytest.mark.parametrize("eps", [0.0, 0.02, 0.0499, 0.0501, 0.4, 0.9, 0.999])
def test_drag_against_its_integral(eps, cap_angle):
    low = math.cos(cap_angle)
    t, weights = GAUSS
    x = low + (1.0 - low) * 0.5 * (t + 1.0)
    weights = weights * 0.5 * (1.0 - low)
    both = 1.0 / (1.0 - eps * x) + 1.0 / (1.0 + eps * x)
    across, along = socket_drag(cap_angle)
    wanted = (
        math.pi * (weights @ ((1 + x * x) * both)),
        2 * math.pi * (weights @ ((1 - x * x) * both)),
    )
    assert (across(eps)[0], along(eps)[0]) == pytest.approx(wanted, rel=1e-6)
    step = 1e-5 * (1.0 - eps)
    for drag in (across, along):
        if eps > 0.0:
            slope = (drag(eps + step)[0] - drag(eps - step)[0]) / (2.0 * step)
            assert drag(eps)[1] == pytest.approx(slope, rel=1e-4, abs=1e-6)
    assert math.isnan(across(1.0)[0]) and math.isnan(along(math.nan)[1])


def test_a_cap_outside_the_table_is_refused():
    for cap_angle in (0.5, 1.7, math.nan):
        with pytest.raises(InputError, match=r"cap_angle = .*: allowed pi/4"):
            ball(cap_angle)
