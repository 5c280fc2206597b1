"""The parts of a page: text, tables, pictures inside it. Nothing is loaded from anywhere."""

import base64
from collections.abc import Iterable, Sequence
from pathlib import Path
from string import Template

from exu_press.page.document import Live, escape

__all__ = ["details", "page", "paragraph", "picture", "stills", "table", "warnings"]

NO_SCRIPTS = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; form-action 'none'; "
    "base-uri 'none'"
)
"""Content security policy of a page of pictures."""

PAGE = Template("""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="$policy">
<link rel="icon" href="data:,">
<title>$title</title>
<style>
:root { color-scheme: light dark; --ink: #1c1c1c; --paper: #fff; --pale: #555; --rule: #d5d9dd;
  --soft: #f5f7f9; --warn: #fdf3ec; --good: #eef5fa; }
@media (prefers-color-scheme: dark) { @media screen { :root { --ink: #e4e7ea; --paper: #15181c;
  --pale: #a4acb4; --rule: #3a4149; --soft: #1f242a; --warn: #33241a; --good: #1a2833; } } }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink);
  background: var(--paper); max-width: $widest; margin: 0 auto; padding: 1rem 1.5rem 3rem; }
a { color: inherit; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0.6rem 0 0.2rem; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.6rem; border-bottom: 1px solid var(--rule); }
p { margin: 0.4rem 0; max-width: 75ch; }
.under { color: var(--pale); }
.warnings { border-left: 5px solid #d55e00; background: var(--warn); padding: 0.4rem 1rem; }
.good { border-left: 5px solid #0072b2; background: var(--good); padding: 0.4rem 1rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: 0.3rem 0; }
th, td { text-align: left; vertical-align: top; padding: 0.2rem 0.9rem 0.2rem 0; }
thead th { border-bottom: 1px solid #888; }
tbody tr:nth-child(even) { background: var(--soft); }
tbody th { font-weight: 400; white-space: pre; }
figure { margin: 1rem 0; }
figure { overflow-x: auto; }
figure img { max-width: 100%; height: auto; cursor: zoom-in; }
figure input { position: absolute; opacity: 0; }
figure input:focus-visible + img { outline: 3px solid #0072b2; }
figure input:checked + img { max-width: none; cursor: zoom-out; }
figcaption { color: var(--pale); font-size: 0.9rem; }
.turned + .stills { display: none; }
.turned:checked + .stills { display: block; }
.show-pictures .turned + .stills { display: block; }
summary { cursor: pointer; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 0.92em; }
nav a { margin-right: 1.2rem; }
@media (max-width: 600px) {
  body { padding: 0.5rem 0.7rem 2rem; }
  h1 { font-size: 1.15rem; }
  table { font-size: 0.8rem; }
  th, td { padding-right: 0.5rem; overflow-wrap: anywhere; }
  thead th, tbody th, td { min-width: 4.5rem; }
  tbody th { white-space: pre-wrap; }
}
@media print {
  figure, tr { break-inside: avoid; }
  .turned + .stills { display: block; }
  .turned, label[for="turned"] { display: none; }
}
$style
</style>
</head>
<body>
<h1>$title</h1>
<p class="under">$under</p>
<nav aria-label="contents">$links</nav>
$body
$scripts
</body>
</html>
""")


def page(title: str, under: str, sections: Sequence[tuple[str, str | Live | None]]) -> str:
    """Return a page.

    Args:
        under: line below the title.
        sections: heading and HTML of each, or the live part; a section of None is left out.
    """
    live = next((inner for _, inner in sections if isinstance(inner, Live)), None)
    parts = [
        (heading, inner.body if isinstance(inner, Live) else inner)
        for heading, inner in sections
        if inner is not None
    ]
    links = "\n".join(
        f'<a href="#part-{number}">{escape(heading)}</a>'
        for number, (heading, _) in enumerate(parts)
    )
    body = "\n".join(
        f'<section id="part-{number}">\n<h2>{escape(heading)}</h2>\n{inner}\n</section>'
        for number, (heading, inner) in enumerate(parts)
    )
    return PAGE.substitute(
        title=escape(title),
        under=escape(under),
        links=links,
        body=body,
        policy=NO_SCRIPTS if live is None else live.policy,
        widest="1180px" if live is None else "1800px",
        style="" if live is None else live.style,
        scripts="" if live is None else "\n".join(f"<script>{s}</script>" for s in live.scripts),
    )


def stills(inner: str, live: Live | None) -> str:
    """Return pictures; beside a live part they are for print, and are shown on demand."""
    if live is None:
        return inner
    return (
        '<label for="turned">Pictures, as they are printed: show</label> '
        '<input type="checkbox" id="turned" class="turned">\n'
        f'<div class="stills">{inner}</div>\n'
        "<noscript><style>.turned + .stills { display: block }</style></noscript>"
    )


def paragraph(text: str) -> str:
    """Return a paragraph of plain text."""
    return f"<p>{escape(text)}</p>"


def warnings(texts: Sequence[str]) -> str:
    """Return a list of plain texts, or that there are none."""
    inner = "\n".join(f"<li>{escape(text)}</li>" for text in texts or ["none"])
    return f'<div class="{"warnings" if texts else "good"}"><ul>\n{inner}\n</ul></div>'


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "", name: str = ""
) -> str:
    """Return a table; the first cell of a row is its head. A wide one scrolls by itself.

    Args:
        name: under which a script finds it.
    """
    known_as = f' id="{escape(name)}"' if name else ""
    above = f"<caption>{escape(caption)}</caption>" if caption else ""
    top = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in head)
    lines = "\n".join(
        f'<tr><th scope="row">{escape(first)}</th>'
        + "".join(f"<td>{escape(cell)}</td>" for cell in rest)
        + "</tr>"
        for first, *rest in rows
    )
    return (
        f'<div class="wide" tabindex="0"><table{known_as}>{above}<thead><tr>{top}</tr></thead>\n'
        f"<tbody>\n{lines}\n</tbody></table></div>"
    )


def details(summary: str, inner: str) -> str:
    """Return a part that is shown on demand."""
    return f"<details><summary>{escape(summary)}</summary>\n{inner}\n</details>"


def picture(path: Path, caption: str) -> str:
    """Return a PNG file's content as a figure with a caption; a tap shows it in full size."""
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return (
        f'<figure><label><input type="checkbox" aria-label="full size: {escape(caption)}">'
        f'<img src="data:image/png;base64,{data}" alt="{escape(caption)}"></label>'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )
