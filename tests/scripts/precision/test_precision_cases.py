"""The study on its cheapest cases, and its table of cases."""

import pytest

from exu_press.studies.precision import precision
from precision.cases import chosen
from precision.peers import left_out


@pytest.fixture(scope="module")
def report():
    some = chosen(["slider_crank_lubricated_0.1mm"])
    return precision(some, quick=True, left_out=left_out())


def rows(report, case, solver):
    return [row for row in report.rows if (row.case, row.solver) == (case, solver)]


@pytest.mark.long
def test_fixed_steps_are_of_second_order_where_lubricated(report):
    order = next(
        o
        for o in report.orders
        if o["case"].startswith("slider_crank_lub") and o["solver"] == "fixed step"
    )
    assert order["error_position"] == pytest.approx(2.0, abs=0.1)


@pytest.mark.long
def test_peers_are_there_or_left_out_with_a_reason(report):
    for peer in ("SciPy Radau", "SciPy BDF", "SciPy LSODA", "CVODE", "IDA", "numbalsoda LSODA"):
        shown = rows(report, "slider_crank_lubricated_0.1mm", peer)
        assert shown or any(why.startswith(peer) for why in report.left_out)


@pytest.mark.long
def test_references_are_known_ten_times_better_than_what_is_told(report):
    for row in report.rows:
        difference = report.cases[row.case]["reference"]["difference"]
        if row.resolved("error_position") is not None:
            assert row.error_position > 10.0 * difference["position"]
