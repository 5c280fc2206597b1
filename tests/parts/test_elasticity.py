"""The full model against closed-form solutions and published frequencies."""

import numpy as np
import pytest
import scipy.optimize
from netgen.occ import Box, Pnt, Sphere, X
from scipy.special import spherical_jn

from fe_models import (
    Interface,
    Material,
    OwnShape,
    Part,
    Reduction,
    clamped_frequencies,
    mesh_convergence,
    shipped_part,
)
from fe_models.clamped import (
    MODE_NUMBERS,
    PUBLISHED_HZ,
    ConvergenceRow,
    observed_order,
    relative_errors,
)
from fe_models.elasticity import rigid_motions
from fe_models.errors import InputError
from fe_models.reduction import reduce_part

STEEL = Material(2.1e11, 0.3, 7850.0)


def test_rigid_motions_cost_no_energy(crank_model):
    rigid = rigid_motions(crank_model.nodes, np.zeros(3))
    forces = abs(crank_model.stiffness @ rigid).max()
    assert forces < 1e-12 * abs(crank_model.stiffness).max()
    assert crank_model.nodal_mass.sum() == pytest.approx(217.6, abs=1e-3)


def timoshenko_free_free(length, side, material, count):
    """The bending frequencies [Hz] of a free square bar [m].

    Han, Benaroya, Wei: Dynamics of transversely vibrating beams using four engineering theories,
    J. Sound and Vibration 225 (1999) 935-988, Timoshenko; here solved as a boundary value problem
    in deflection w and slope psi with Cowper's shear factor 10 (1 + nu) / (12 + 11 nu).
    """
    e, nu, rho = material.youngs_modulus, material.poissons_ratio, material.density
    area, second = side**2, side**4 / 12.0
    shear = 10 * (1 + nu) / (12 + 11 * nu) * e / (2 * (1 + nu)) * area

    def determinant(frequency):
        w2 = (2 * np.pi * frequency) ** 2
        a = np.zeros((4, 4))  # d/dx of (w, psi, M, Q): Q = shear (w' - psi), M = EI psi'
        a[0, 1], a[0, 3] = 1.0, length**2 * e * second / shear / length**4
        a[1, 2] = 1.0
        a[2, 3], a[2, 1] = -1.0, -rho * second * w2 * length**2 / (e * second)
        a[3, 0] = -rho * area * w2 * length**4 / (e * second)
        transfer = scipy.linalg.expm(a)
        return np.linalg.det(transfer[2:, :2])

    grid = np.linspace(50.0, 1200.0, 60)
    values = np.array([determinant(f) for f in grid])
    brackets = np.flatnonzero(values[:-1] * values[1:] < 0.0)[:count]
    return [scipy.optimize.brentq(determinant, grid[i], grid[i + 1]) for i in brackets]


@pytest.mark.validation(
    "closed form",
    "bending frequencies of a free bar",
    "S. M. Han, H. Benaroya, T. Wei, J. Sound and Vibration 225 (1999) 935-988: Timoshenko",
    "equation",
)
def test_free_timoshenko_beam(compare):
    length, side = 1.0, 0.04
    bar = Box(Pnt(0, 0, 0), Pnt(length, side, side))
    bar.faces.Min(X).name = "end"
    part = Part("bar", OwnShape(bar), STEEL, (Interface("end"),), 0.02)
    found = reduce_part(part, Reduction(modes=6, method="free", stress=False)).frequencies
    exact = timoshenko_free_free(length, side, STEEL, 2)
    # bending modes come in pairs; Timoshenko's theory itself is good to about 0.02 % here
    theory = np.repeat(exact, 2)
    compare("first four frequencies", theory, found[:4], error=None, rel=1e-3, unit="Hz")


def lamb_spheroidal(degree, poissons_ratio):
    """The lowest root eta = omega R / c_s of the traction-free sphere's frequency equation.

    H. Lamb, On the vibrations of an elastic sphere, Proc. London Math. Soc. 13 (1882) 189-212;
    in the form of A. C. Eringen, E. S. Suhubi, Elastodynamics II (1975). Known value for
    Poisson's ratio 1/4 and degree 2: 0.840 pi.
    """
    slow = np.sqrt((1 - 2 * poissons_ratio) / (2 - 2 * poissons_ratio))  # c_s / c_p
    n = degree

    def determinant(k):
        h = slow * k
        jh, jh1 = spherical_jn(n, h), spherical_jn(n + 1, h)
        jk, jk1 = spherical_jn(n, k), spherical_jn(n + 1, k)
        t11 = (n * n - n - 0.5 * k * k) * jh + 2 * h * jh1
        t13 = n * (n + 1) * ((n - 1) * jk - k * jk1)
        t41 = (n - 1) * jh - h * jh1
        t43 = (n * n - 1 - 0.5 * k * k) * jk + k * jk1
        return t11 * t43 - t13 * t41

    return scipy.optimize.brentq(determinant, 2.2, 3.0)


def lamb_torsional():
    """The lowest root for degree 2: j_2(eta) = eta j_3(eta)."""
    return scipy.optimize.brentq(lambda k: spherical_jn(2, k) - k * spherical_jn(3, k), 2.2, 3.0)


@pytest.mark.validation(
    "closed form",
    "frequencies of a free sphere",
    "H. Lamb, Proc. London Math. Soc. 13 (1882) 189-212",
    "equation",
)
@pytest.mark.parametrize("mesh_size", [0.24, pytest.param(0.12, marks=pytest.mark.long)])
def test_free_sphere(mesh_size, compare):
    """Five torsional and five spheroidal modes of degree 2, within 0.1 % once converged."""
    assert lamb_spheroidal(2, 0.25) == pytest.approx(0.840 * np.pi, rel=1e-3)
    radius = 1.0
    shape = Sphere(Pnt(0, 0, 0), radius)
    shape.faces.name = "skin"
    part = Part("sphere", OwnShape(shape), STEEL, (Interface("skin"),), mesh_size)
    reduced = reduce_part(part, Reduction(modes=10, method="free", stress=False))
    shear_speed = np.sqrt(STEEL.youngs_modulus / (2.0 * 1.3) / STEEL.density)
    eta = 2.0 * np.pi * reduced.frequencies * radius / shear_speed
    compare("five torsional, omega R / c_s", lamb_torsional(), eta[:5], error=None, rel=1e-3)
    spheroidal = lamb_spheroidal(2, 0.3)
    compare("five spheroidal, omega R / c_s", spheroidal, eta[5:], error=None, rel=1e-3)


RMS = {"crank": 0.02, "linkage": 0.06}
DISCRETIZATION = 0.035  # of the frequencies, by test_mesh_convergence


@pytest.mark.validation(
    "table",
    "natural frequencies of crank shaft and linkage, clamped",
    "the paper (CITATION.cff), Figs. 8 and 9",
    "published numbers",
    "The paper prints no drawing of its parts: ours are shapes that were fitted to its masses and "
    "frequencies.",
)
@pytest.mark.parametrize(
    ("name", "mesh_size"),
    [
        pytest.param(name, size, marks=pytest.mark.long if (name, size) != ("crank", 0.06) else ())
        for name in ("crank", "crank_2", "linkage", "linkage_2")
        for size in (0.06, 0.02)
    ],
)
def test_published_frequencies(name, mesh_size, compare):
    kind = name.split("_")[0]
    frequencies = clamped_frequencies(shipped_part(name, mesh_size), 16)
    errors = relative_errors(frequencies, PUBLISHED_HZ[kind])
    assert np.sqrt((errors**2).mean()) < RMS[kind], errors
    if mesh_size == 0.02:
        ours = frequencies[np.array(MODE_NUMBERS) - 1]
        error = DISCRETIZATION * ours
        compare(
            f"five frequencies, {kind}", PUBLISHED_HZ[kind], ours, error=error, rel=0.1, unit="Hz"
        )


def test_clamping_what_is_no_interface(bar):
    with pytest.raises(InputError, match="cannot clamp"):
        clamped_frequencies(bar, 2, faces=("seat",))


def test_observed_order_of_a_known_law():
    rows = []
    for unknowns in (1000, 8000, 64000):
        h = unknowns ** (-1 / 3)
        rows.append(ConvergenceRow(h, unknowns, 1.0, np.array([100.0 + 7.0 * h**2.5])))
    order, limit = observed_order(rows, 1)
    assert order == pytest.approx(2.5)
    assert limit == pytest.approx(100.0)


@pytest.mark.long
@pytest.mark.parametrize("name", ["crank", "linkage"])
def test_mesh_convergence(name):
    rows = mesh_convergence(shipped_part(name), (0.06, 0.03, 0.02))
    frequencies = np.array([row.frequencies for row in rows])
    assert np.all(np.diff(frequencies[:, :6], axis=0) < 0.0)
    assert np.all(np.abs(frequencies[-1] / frequencies[0] - 1.0) < 0.035)
