"""Sources that decide a result, and what of the user's counts among them."""

import pytest

from exu_press.files import sources
from exu_press.files.sources import source_digest, users_files


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Return what makes a file of a user and returns the digest of a module then."""
    monkeypatch.syspath_prepend(tmp_path)

    def with_file(name, text, module="some_package"):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return source_digest(module)

    return with_file


def test_what_a_row_comes_from_and_what_only_shows_it(digest):
    first = digest("some_package/__init__.py", "")
    assert digest("some_package/law.py", "x = 1") != first
    second = digest("some_package/law.py", "x = 2")
    assert digest("some_package/law.py", "x = 1") != second != first
    assert digest("some_package/law.py", "x = 2") == second
    shown = digest("some_package/plots/law.py", "x = 1")
    assert shown == digest("some_package/__pycache__/law.pyc", "x") == second


@pytest.mark.parametrize(
    "law",
    [
        "import helper",
        "from helper import stiffness",
        "def force():\n    import helper.inner as inside",
        "import middle",
        f"TABLE, LONG = 'helper.csv', 'no. {500 * 'x'}'",
        "from pathlib import Path\nTABLE = Path(__file__).with_name('helper.csv')",
    ],
)
def test_what_a_law_of_the_users_imports_or_names_counts_too(digest, law):
    digest("middle.py", "from helper import stiffness as middle")
    digest("helper.csv", "1,2")
    digest("helper.py", "stiffness = 1.0")
    first = digest("law.py", law, "law")
    changed = digest("helper.csv" if "csv" in law else "helper.py", "stiffness = 2.0", "law")
    assert changed != first
    assert digest("unused.py", "x = 1", "law") == changed


def test_a_source_that_is_none_is_digested_all_the_same(digest):
    assert digest("law.py", "def", "law") != digest("law.py", "def def", "law")


def test_what_is_installed_counts_by_its_version_alone(digest):
    assert set(users_files(["law"])) == set()
    digest("law.py", "import numpy, exu_press, json, no_such_module", "law")
    assert set(users_files(["law"])) == {"law"}


def test_our_own_are_always_among_them(monkeypatch):
    digests = {source_digest("exu_press"), source_digest("json")}
    monkeypatch.setattr(sources, "OURS", ("exu_press",))
    assert source_digest("exu_press") not in digests
