# SPDX-License-Identifier: MIT
"""The documentation as a site: `make docs` builds it into build/site, without network.

Why Sphinx, and what tools/site adds to it: docs/design/0026-site.md."""

import os
import pathlib
import re
import sys

import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [
    str(ROOT / os.environ.get("POLHODE_PYTHON", "build/release/python")),
    str(ROOT / "tools/site"),
]
import inventories  # noqa: E402

project = "polhode"
author = "polhode authors"
version = release = ".".join(
    re.findall(
        r"#define POLHODE_VERSION_\w+ (\d+)", (ROOT / "include/polhode/version.hpp").read_text()
    )
)
repository = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["urls"]["Repository"]

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.intersphinx",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinxcontrib.bibtex",
    # ours
    "checkout",
    "cpp_reference",
    "pages",
    "python_reference",
    "references",
    "script_pages",
]

source_suffix = {".md": "markdown", ".py": "script"}
exclude_patterns = ["conf.py", "examples/figures/*", "theory/proofs/*"]
default_role = "py:obj"
highlight_language = "text"

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath", "html_image"]
myst_heading_anchors = 4
myst_update_mathjax = False

autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_docstring_signature = False
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100
cpp_maximum_signature_line_length = 100
add_module_names = False
toc_object_entries_show_parents = "hide"

bibtex_bibfiles = ["references.bib"]
bibtex_default_style = "polhode"
bibtex_cite_id = "{key}"

# What the types of the Python reference link to, without network.
intersphinx_mapping = inventories.mapping()

# The renderer of MathJax marks formulas; math.js typesets them with the KaTeX of the distribution.
mathjax_path = "math.js"
html_static_path = ["assets"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = ["katex/katex.min.js"]
html_theme = "pydata_sphinx_theme"
html_title = "polhode"
smartquotes = False
html_logo = html_favicon = "assets/logo.svg"
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
copyright = "polhode authors, MIT licence"
html_theme_options = {
    "logo": {"text": "polhode"},
    "header_links_before_dropdown": 9,
    "navbar_align": "left",
    "navigation_with_keys": False,
    "show_toc_level": 2,
    "show_prev_next": True,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
    "pygments_light_style": "tango",
    "pygments_dark_style": "monokai",
    "icon_links": [
        {"name": "Repository", "url": repository, "icon": "fa-solid fa-code-branch"},
    ],
}
html_sidebars = {"index": [], "references": ["sidebar-nav-bs"]}


def setup(app):
    # `make web` builds the explorer into the folder of the site; where it is, its page links it.
    if (pathlib.Path(app.outdir) / "explorer/index.html").exists():
        app.tags.add("explorer")
