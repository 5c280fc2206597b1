"""The finite bearing against the tables of Raimondi and Boyd."""

import math

import numpy as np
import pytest
from data import columns_of

from exu_press.joints.interface import FilmInterface
from exu_press.laws.film import finite
from exu_press.laws.film.reynolds import solve_reynolds
from exu_press.laws.film.side_flow import finite_flow
from exu_press.scene.film import Finite

TABLE = columns_of("raimondi_boyd_1958.csv")
ROWS = np.isfinite(TABLE["L_over_D"])  # the law is meant for L/D up to 4
RATIO, EPS = TABLE["L_over_D"][ROWS], 1.0 - TABLE["h0_over_c"][ROWS]
FORCE_ERROR, FLOW_ERROR = Finite.error, Finite.flow_error
NARROW = EPS > 0.95  # where a grid of 1958 is at its worst

pytestmark = pytest.mark.validation(
    "table",
    "finite bearing, L/D 1, 1/2, 1/4",
    "A. A. Raimondi, J. Boyd, Trans. ASLE 1 (1958) 159-209",
    "printed numbers",
    "The largest deviations stand at eccentricity ratio 0.97, where their grid is coarse.",
)


def column(name):
    return TABLE[name][ROWS]


@pytest.fixture(scope="module")
def bearing():
    """Return f_r, f_t, the journal's moment over P c, the side flow over L R c, by rows."""
    rows = []
    for ratio, eps in zip(RATIO, EPS, strict=True):
        f_r, f_t, *_ = finite(ratio)(eps, 0.0, eps)
        moment = FilmInterface(finite(ratio), 1.0, 1.0).load(eps, 0.0, 0.0, 1.0, 0.0)[2]
        flow = finite_flow(ratio)(*(np.array([value]) for value in (eps, 0.0, eps)))
        rows.append((f_r, f_t, -moment, float(flow[0])))
    return np.array(rows).T


def test_load_and_attitude(bearing, compare):
    f_r, f_t, *_ = bearing
    sommerfeld = 1.0 / (math.pi * np.hypot(f_r, f_t))
    error = FORCE_ERROR * sommerfeld
    theirs = column("S")
    for rows, rel, where in ((~NARROW, 0.02, "to 0.9"), (NARROW, 0.035, "0.97")):
        name = f"Sommerfeld number, eccentricity ratio {where}"
        compare(name, theirs[rows], sommerfeld[rows], error=error[rows], rel=rel)
    attitude = np.degrees(np.arctan2(f_t, -f_r))
    compare(
        "attitude angle",
        column("phi_deg"),
        attitude,
        error=math.degrees(FORCE_ERROR),
        abs=0.6,
        unit="deg",
    )


def test_friction(bearing, compare):
    f_r, f_t, moment, _ = bearing
    ours, theirs = moment / np.hypot(f_r, f_t), column("friction_variable")
    for rows, rel, where in ((~NARROW, 0.01, "to 0.9"), (NARROW, 0.035, "0.97")):
        error = FORCE_ERROR * ours[rows]
        name = f"friction variable, eccentricity ratio {where}"
        compare(name, theirs[rows], ours[rows], error=error, rel=rel)


def test_side_flow_and_temperature_rise(bearing, compare):
    """rho c dT / p of oil that the side flow takes: 4 pi (R/c) f / (Q / (R c N L) Q_s / Q)."""
    f_r, f_t, moment, flow = bearing
    theirs = column("flow_variable") * column("side_flow_ratio")
    ours = 2.0 * math.pi * flow  # omega = 1 is N = 1 / (2 pi)
    compare("side flow variable", theirs, ours, error=FLOW_ERROR * ours, rel=0.01)
    rise = moment / (flow * np.hypot(f_r, f_t) / 2.0)
    published = 4.0 * math.pi * column("friction_variable") / theirs
    error = (FORCE_ERROR + FLOW_ERROR) * rise[~NARROW]
    compare(
        "temperature rise, eccentricity ratio to 0.9",
        published[~NARROW],
        rise[~NARROW],
        error=error,
        rel=0.015,
    )


def test_largest_pressure(compare):
    """P / p_max of Reynolds' equation solved on the grid that the law's table is made with."""
    ours = []
    for ratio, eps in zip(RATIO, EPS, strict=True):
        film = solve_reynolds(eps, 0.0, eps, ratio, math.pi)
        ours.append(math.hypot(film.f_r, film.f_t) / 24.0 / film.p.max())
    ours, theirs = np.array(ours), column("P_over_pmax")
    for rows, rel, where in ((~NARROW, 0.03, "to 0.9"), (NARROW, 0.06, "0.97")):
        error = 3e-3 * ours[rows]
        name = f"mean over largest pressure, eccentricity ratio {where}"
        compare(name, theirs[rows], ours[rows], error=error, rel=rel)
