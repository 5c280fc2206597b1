"""What tests of more than one folder need."""

import gc
import os
import re
import signal
import sys
from functools import cache

import pytest
from browser import launched
from comparisons import Compare
from in_process import InProcess, copy_or_stand_in

from fe_models.lazy import named_object

for library in ("OMP", "OPENBLAS", "MKL"):  # threads of the workers would wait for each other
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # as shells start what runs in the background
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def browser():
    """A real browser; a test that asks for it is skipped where there is none."""
    yield from launched()


@pytest.fixture(scope="session", autouse=True)
def few_new_processes():
    """Start no workers, but where a test asks for `processes`; refinements run in copies.

    A new process takes longer to load the package than most runs of tests. The second thread is
    execnet's, which receives the names of tests: it keeps no lock that a copy waits for. NGSolve's
    threads do, so that where a test has loaded it refinements run in this process.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("exu_press.parallel.run.Workers", InProcess)
        if sys.platform == "linux":
            for module in ("refinement", "side_by_side"):
                patch.setattr(
                    f"exu_press.verification.{module}.may_copy",
                    lambda: "ngsolve" not in sys.modules,
                )
            patch.setattr("exu_press.verification.refinement.Child", copy_or_stand_in)
        yield


@pytest.fixture
def processes(monkeypatch):
    """Real worker processes."""
    from exu_press.parallel.workers import Workers

    monkeypatch.setattr("exu_press.parallel.run.Workers", Workers)


@pytest.fixture(scope="module")
def sound_files():
    """STEP files and matrices that tests write are sound: this process reads them, no child."""

    def here(_, function, *arguments, report=None):
        reports = [] if report is None else [report]
        return named_object(function)(*arguments, *reports)

    with pytest.MonkeyPatch.context() as patch:
        for reader in ("geometry.StepFile", "matrices.MatrixPart"):
            patch.setattr(f"fe_models.{reader}.in_child", here)
        yield


@pytest.fixture
def compare(request):
    """Check numbers of ours against others', of which the test's mark `validation` says whose."""
    return Compare(request.node)


def pytest_configure(config):
    """Keep bytecode, here and in processes that tests start: compiling is half of their start."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False


def _second(config):
    """Return whether this process is the second worker of xdist."""
    return getattr(config, "workerinput", {}).get("workerid") == "gw1"


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Let workers begin at either end: what one has compiled the other one reads."""
    report = yield
    if isinstance(collector, pytest.Directory) and _second(collector.config):
        report.result.reverse()
    return report


@cache
def _has_solids(path):
    """Return whether a file's tests load NGSolve."""
    return bool(re.search(r'ngsolve|netgen|COARSE|flexible_press|"flexible"', path.read_text()))


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Put the tests into one order again, which workers agree upon; those of solids are last.

    A worker that has loaded NGSolve is not copied any more.
    """
    if hasattr(config, "workerinput"):
        items.sort(key=lambda item: (_has_solids(item.path), item.path))


def pytest_collection_finish(session):
    """Let the garbage collector look at what tests make, not at all tests each time."""
    gc.collect()
    gc.freeze()


SHARES = 20
"""A turn has every so many of the tests that are chosen."""


def pytest_addoption(parser):
    """Let long tests take turns: all of them run within as many runs as there are shares."""
    parser.addoption(
        "--turn", type=int, help=f"run every {SHARES}th of the chosen tests, from this one on"
    )


@pytest.hookimpl(trylast=True, specname="pytest_collection_modifyitems")
def pytest_keep_turn(config, items):
    """Keep the tests whose turn it is."""
    turn = config.getoption("--turn")
    if turn is None:
        return
    chosen = [i % SHARES == turn % SHARES for i in range(len(items))]
    config.hook.pytest_deselected(
        items=[x for x, now in zip(items, chosen, strict=True) if not now]
    )
    items[:] = [item for item, now in zip(items, chosen, strict=True) if now]
