"""The documentation as a site: sphinx-build -W docs out/docs."""

import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from sphinx_parts.scripts import NUMBERS, ROOT, gallery_sources

metadata = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
release_table = metadata["tool"]["exu_press"]["release"]

project = "exu_press"
author = ", ".join(writer["name"] for writer in metadata["project"]["authors"])
project_copyright = author
html_baseurl = release_table["documentation"]
exclude_patterns = ["joss"]
html_theme = "furo"
html_theme_options = (
    {
        "source_repository": release_table["repository"],
        "source_branch": "main",
        "source_directory": "docs/",
    }
    if release_table["repository"]
    else {}
)
html_title = "exu_press"
html_show_sphinx = False
html_static_path = ["sphinx_parts/site.css"]
html_css_files = ["site.css"]

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
    "sphinx-mathjax-offline",
    "sphinx_parts.docstrings",
    "sphinx_parts.directives",
    "sphinx_parts.live",
]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
default_role = "code"
napoleon_use_ivar = True
napoleon_use_rtype = False
napoleon_custom_sections = ["Result"]

sphinx_gallery_conf = {
    "examples_dirs": [str(gallery_sources())],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$",  # all of them run
    "within_subsection_order": "FileNameSortKey",
    "default_thumb_file": str(NUMBERS),
    "image_scrapers": (),
    "reset_modules": (),
    "write_computation_times": False,
    "download_all_examples": False,
    "show_signature": False,
    "remove_config_comments": True,
    "abort_on_example_error": True,
    "run_stale_examples": True,  # what they print depends on the library too
}
