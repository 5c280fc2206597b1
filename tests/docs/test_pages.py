"""Every command and every code block of the README and of docs/ runs, as a reader runs them.

The quick tests shorten the runs of those that only show that they run.
"""

import re
import shlex
import subprocess

import pages
import pytest

import exu_press

ONE_BY_ONE = pages.blocks_of(pages.ROOT / "README.md")
README_BLOCKS = [b for b in ONE_BY_ONE if b.language in ("sh", "python", "toml")]

SLOW = (
    *("built_press", "cluster", "extending", "figures", "film", "flexible", "matrices", "oil"),
    *("own_mechanism", "own_part", "pandas", "press_builders", "scene", "see", "tutorial", "wear"),
)
"""Pages whose short blocks take more than three seconds together."""

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)? *")


def name(value):
    return value.stem if hasattr(value, "stem") else None


def test_both_setup_commands_stand_in_the_readme():
    lines = [line for b in README_BLOCKS if b.language == "sh" for line in b.text.splitlines()]
    starts = [line for line in lines if line.startswith("python3 -m venv .venv && ")]
    assert any("exu-press compare press" in line for line in starts)
    assert any(line.endswith("pytest") for line in starts)


@pytest.mark.parametrize(
    "page",
    [pytest.param(p, marks=pytest.mark.long) if p.stem in SLOW else p for p in pages.PAGES],
    ids=name,
)
def test_page(page, tmp_path):
    for block in pages.blocks_of(page):
        if not block.long:
            pages.run_block(block, tmp_path, short=True)


@pytest.mark.long
@pytest.mark.parametrize(
    "page", [p for p in pages.PAGES if any(b.long for b in pages.blocks_of(p))], ids=name
)
def test_page_with_its_long_blocks(page, tmp_path):
    for block in pages.blocks_of(page):
        pages.run_block(block, tmp_path)


def test_a_command_that_nothing_runs_is_noticed(tmp_path):
    with pytest.raises(AssertionError, match="nothing runs this"):
        pages.run_block(pages.Block("sh", "rm -r somewhere\n", ""), tmp_path)


@pytest.mark.parametrize(("page", "block"), pages.printed_blocks(), ids=name)
def test_what_printed_a_block_can_be_run_again(page, block):
    """Blocks that only a reader can print anew, in his own way, have other notes."""
    words = shlex.split(block.note("printed by"))
    assert not any(word.endswith(",") or word.startswith("(") or word.isupper() for word in words)


@pytest.mark.long
@pytest.mark.parametrize(("page", "block"), pages.printed_blocks(), ids=name)
def test_what_is_shown_is_what_is_printed(page, block, tmp_path):
    """But for times, steps and what is nearly zero: other processors round otherwise."""
    printed = pages.printed_again(page, block, tmp_path)
    for shown, now in zip(block.text.splitlines(), printed.splitlines(), strict=True):
        assert NUMBER.split(shown) == NUMBER.split(now)
        if not re.search("time|steps|residual|differ", shown):
            old, new = (list(map(float, NUMBER.findall(line))) for line in (shown, now))
            assert new == pytest.approx(old, rel=0.05), (shown, now)


@pytest.mark.long
@pytest.mark.parametrize(("page", "block"), pages.partly_printed_blocks(), ids=name)
def test_what_is_shown_is_a_part_of_what_is_printed(page, block, tmp_path):
    """Every line has one of the same words; numbers that are small beside its largest are noise."""
    printed = pages.printed_again(page, block, tmp_path).splitlines()
    for shown in block.text.splitlines():
        same = [line for line in printed if words_of(line) == words_of(shown)]
        assert len(same) == 1, (shown, printed)
        if "differ" not in shown:
            old, new = (list(map(float, NUMBER.findall(line))) for line in (shown, same[0]))
            near = 1e-3 * max(map(abs, old), default=0.0)
            assert new == pytest.approx(old, rel=0.1, abs=near), (shown, same[0])


def words_of(line):
    """What stands between the numbers, but for blanks that line columns up."""
    return [part.split() for part in NUMBER.split(line)]


def test_the_reference_begins_with_every_public_name():
    text = (pages.ROOT / "docs" / "reference" / "public.md").read_text("utf-8")
    assert set(exu_press.__all__) <= set(dir(exu_press))
    for public in set(exu_press.__all__) - {"__version__"}:
        home = getattr(exu_press, public)
        assert f"`{public} <{home.__module__}.{public}>`" in text


def test_every_test_that_a_page_names_exists():
    named = {
        (match[1], match[2])
        for page in pages.PAGES
        for match in re.finditer(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", page.read_text("utf-8"))
    }
    assert len(named) > 30
    for file, function in named:
        path = pages.ROOT / file
        assert path.exists(), file
        assert not function or f"def {function}(" in path.read_text("utf-8"), (file, function)


@pytest.mark.long
@pytest.mark.parametrize(
    "line", [b.text for b in README_BLOCKS if b.text.startswith("python3 -m venv")]
)
def test_setup_command_on_a_bare_machine(line, tmp_path):
    clone = tmp_path / "clone"
    subprocess.run(["git", "clone", "--quiet", str(pages.ROOT), str(clone)], check=True)
    done = subprocess.run(line, shell=True, cwd=clone, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_tables_that_the_site_makes_are_explained_in_the_checkout():
    made = re.compile(r"^```\{(?:scene-keys|commands)\}\n(.*?)^```", re.MULTILINE | re.DOTALL)
    texts = [found[1] for page in pages.PAGES for found in made.finditer(page.read_text())]
    assert len(texts) == 2
    assert all("exu-press" in text for text in texts)


def test_goals_stand_in_the_theory_alone():
    """Pages for users state facts."""
    told = re.compile(r"\bNOT MET\b|\bgoals?\b|\bthe aims?\b", re.IGNORECASE)
    for_users = [page for page in pages.PAGES if "theory" not in page.parts]
    found = {page.name: told.findall(page.read_text()) for page in for_users}
    assert {name: words for name, words in found.items() if words} == {}
