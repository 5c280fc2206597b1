import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg

from fe_models.reduction import interface_rows
from fe_models.saddle import SaddleSolver, lowest_modes


def test_solver_satisfies_the_saddle_point_system(bar, bar_model):
    rows = interface_rows(bar, bar_model)
    generator = np.random.default_rng(0)
    load, motion = generator.standard_normal(bar_model.unknowns), generator.standard_normal(12)
    solver = SaddleSolver(bar_model, rows)
    found = solver.solve(load, motion)
    scale = bar_model.stiffness.diagonal().mean()
    system = sp.bmat([[bar_model.stiffness, scale * rows.T], [scale * rows, None]]).tocsc()
    exact = scipy.sparse.linalg.spsolve(system, np.concatenate([load, scale * motion]))[:-12]
    assert np.abs(found - exact).max() < 1e-9 * np.abs(exact).max()
    assert np.abs(rows @ found - motion).max() < 1e-9


def test_eigenpairs_have_small_residuals(bar, bar_model):
    rows = interface_rows(bar, bar_model)
    solver = SaddleSolver(bar_model, rows)
    squares, modes = lowest_modes(bar_model, lambda load: solver.solve(load, None), 5)
    for square, mode in zip(squares, modes.T, strict=True):
        again = square * solver.solve(bar_model.mass @ mode, None)
        assert np.abs(again - mode).max() < 1e-8 * np.abs(mode).max()
