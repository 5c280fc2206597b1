"""Write what the owner of a release has filled in into every file that repeats it.

The table `[tool.exu_press.release]` of pyproject.toml is the only place to edit. Each of the files
below has it between two lines that end in `release: begin` and `release: end`, or, in Markdown, in
`<!-- release: begin -->` and `<!-- release: end -->`.

Run with: python scripts/write_release.py
"""

import argparse
import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]

DEVELOPERS = "exu_press developers"
"""Name where no author is filled in."""

BLOCK = re.compile(r"(?<=release: begin)( -->)?\n.*?(?=(?:# |<!-- )release: end)", re.DOTALL)
"""What a file repeats, with the end of the line above it."""

Release = dict[str, Any]


def read_release() -> Release:
    """Return the table that the owner fills in."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    table: Release = tomllib.loads(text)["tool"]["exu_press"]["release"]
    return table


def full_name(author: dict[str, str]) -> str:
    """Return given and family names."""
    return f"{author['given-names']} {author['family-names']}"


def quote(text: str) -> str:
    """Return a text as TOML and YAML both quote it."""
    return json.dumps(text, ensure_ascii=False)


def project_authors(release: Release) -> str:
    """Return `authors` of the package's metadata."""
    lines = []
    for author in release["authors"]:
        email = f", email = {quote(author['email'])}" if author.get("email") else ""
        lines.append(f"    {{name = {quote(full_name(author))}{email}}},\n")
    lines = lines or [f"    {{name = {quote(DEVELOPERS)}}},\n"]
    return f"authors = [\n{''.join(lines)}]\n"


def project_urls(release: Release) -> str:
    """Return the addresses of the package's metadata."""
    repository = release["repository"].rstrip("/")
    addresses = {
        "Documentation": release["documentation"],
        "Repository": repository,
        "Issues": release["issues"],
        "Changelog": f"{repository}/blob/main/CHANGELOG.md" if repository else "",
    }
    lines = [f"{name} = {quote(url)}\n" for name, url in addresses.items() if url]
    return f"[project.urls]\n{''.join(lines)}"


def citation(release: Release) -> str:
    """Return authors, addresses and DOI for CITATION.cff."""
    lines = ["authors:\n"]
    for author in release["authors"]:
        mark = "-"
        for key in ("given-names", "family-names", "affiliation", "orcid", "email"):
            if value := author.get(key):
                value = f"https://orcid.org/{value}" if key == "orcid" else value
                lines.append(f"  {mark} {key}: {quote(value)}\n")
                mark = " "
    if not release["authors"]:
        lines.append(f"  - name: {quote(DEVELOPERS)}\n")
    addresses = {
        "repository-code": release["repository"],
        "url": release["documentation"],
        "doi": release["doi"],
    }
    lines += [f"{key}: {quote(value)}\n" for key, value in addresses.items() if value]
    return "".join(lines)


def paper_authors(release: Release) -> str:
    """Return authors and affiliations for the front matter of the paper."""
    affiliations = list(dict.fromkeys(a.get("affiliation", "") for a in release["authors"]))
    lines = ["authors:\n"]
    for author in release["authors"]:
        lines.append(f"  - name: {quote(full_name(author))}\n")
        if author.get("orcid"):
            lines.append(f"    orcid: {author['orcid']}\n")
        lines.append(f"    affiliation: {affiliations.index(author.get('affiliation', '')) + 1}\n")
    if not release["authors"]:
        lines.append(f"  - name: {DEVELOPERS}\n    affiliation: 1\n")
    lines.append("affiliations:\n")
    for number, name in enumerate(affiliations or [""], 1):
        lines.append(f"  - name: {quote(name or 'independent')}\n    index: {number}\n")
    return "".join(lines)


def clone_command(release: Release) -> str:
    """Return how a contributor gets the sources."""
    return f"```text\ngit clone {release['repository'] or 'ADDRESS'} exu_press\ncd exu_press\n```\n"


def security_address(release: Release) -> str:
    """Return where faults of security are reported."""
    address = release["security"]
    return (
        f"Report it in private: {address}.\n"
        if address
        else "Report it to the authors in private.\n"
    )


def issue_links(release: Release) -> str:
    """Return the links that are offered beside the templates of issues."""
    links = {
        "Documentation": (release["documentation"], "Many questions are answered there."),
        "Faults of security": (release["security"], "Please report them in private."),
    }
    lines = [
        f"  - name: {name}\n    url: {quote(url)}\n    about: {about}\n"
        for name, (url, about) in links.items()
        if url.startswith("http")
    ]
    return "".join(["contact_links:\n", *lines] if lines else [])


BLOCKS: dict[str, list[Callable[[Release], str]]] = {
    "pyproject.toml": [project_authors, project_urls],
    "CITATION.cff": [citation],
    "CONTRIBUTING.md": [clone_command],
    "SECURITY.md": [security_address],
    "docs/joss/paper.md": [paper_authors],
    ".github/ISSUE_TEMPLATE/config.yml": [issue_links],
}
"""What each file repeats, in the order in which it does; docs/conf.py reads the table itself."""


def release_text(file: str, release: Release) -> str:
    """Return the text of a file that repeats the table.

    Raises:
        ValueError: the file has not the lines between which it repeats it.
    """
    text = (ROOT / file).read_text(encoding="utf-8")
    functions = iter(BLOCKS[file])
    if len(BLOCK.findall(text)) != len(BLOCKS[file]):
        raise ValueError(f"{file}: {len(BLOCKS[file])} times `release: begin` and `release: end`")
    return BLOCK.sub(lambda match: f"{match[1] or ''}\n{next(functions)(release)}", text)


def main() -> None:
    """Write the files."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    release = read_release()
    for file in BLOCKS:
        (ROOT / file).write_text(release_text(file, release), encoding="utf-8")
        print(file)


if __name__ == "__main__":
    main()
