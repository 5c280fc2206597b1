import numpy as np
import pytest

from fe_models import clamped_frequencies, mesh_convergence, shipped_part
from fe_models.clamped import (
    MODE_NUMBERS,
    PUBLISHED_HZ,
    ConvergenceRow,
    observed_order,
    relative_errors,
)
from fe_models.errors import InputError

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
