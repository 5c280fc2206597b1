"""Print anew what docs/ shows: every block under <!-- printed by: COMMAND -->.

Run with: python tests/docs/refresh.py [PAGE ...], as in docs/tutorial.md; all pages unless named.
"""

import sys
import tempfile
from pathlib import Path

import pages

named = {Path(name).resolve() for name in sys.argv[1:]}
if unknown := named - {page for page, _ in pages.printed_blocks()}:
    sys.exit(f"no printed block in {', '.join(map(str, sorted(unknown)))}")

for page, block in pages.printed_blocks():
    if named and page not in named:
        continue
    with tempfile.TemporaryDirectory() as place:
        printed = pages.printed_again(page, block, Path(place))
    text = page.read_text(encoding="utf-8")
    old = f"<!-- printed by: {block.note('printed by')} -->\n```{block.language}\n{block.text}```"
    assert text.count(old) == 1, (page, block.note("printed by"))
    new = old.removesuffix(f"{block.text}```") + f"{printed}```"
    page.write_text(text.replace(old, new), encoding="utf-8")
    print(page.relative_to(pages.ROOT), "same" if old == new else "CHANGED", file=sys.stderr)
