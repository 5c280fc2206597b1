"""Which edits of the sources make rows old."""

import pytest

from exu_press.parallel.task import source_digest


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Return what makes a file of a package and returns the digest then."""
    monkeypatch.syspath_prepend(tmp_path)

    def with_file(name, text):
        file = tmp_path / "some_package" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        source_digest.cache_clear()
        return source_digest("some_package")

    yield with_file
    source_digest.cache_clear()


def test_what_a_row_comes_from_and_what_only_shows_it(digest):
    first = digest("__init__.py", "")
    assert digest("law.py", "x = 1") != first
    second = digest("law.py", "x = 2")
    assert digest("law.py", "x = 1") != second != first
    assert digest("law.py", "x = 2") == second
    assert digest("plots/law.py", "x = 1") == digest("__pycache__/law.pyc", "x") == second


def test_our_own_are_always_among_them(monkeypatch):
    import exu_press.parallel.task as sources

    digests = {source_digest("exu_press"), source_digest("json")}
    monkeypatch.setattr(sources, "OURS", ("exu_press",))
    source_digest.cache_clear()
    digests.add(source_digest("exu_press"))
    source_digest.cache_clear()
    assert len(digests) == 3
