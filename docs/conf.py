"""How the documentation is built: `just docs`."""  # noqa: INP001 (Sphinx runs this file by its path)

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "rightofway"
author = "the rightofway developers"
version = release = version_of("rightofway")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "mathml",
    "as_written",
    "notebook_pages",
    "code_host",
    "plan_pages",
]
exclude_patterns = ["_build"]


myst_heading_anchors = 3

default_role = "py:obj"
add_module_names = False
maximum_signature_line_length = 88
autodoc_default_options = {"members": True}
napoleon_google_docstring = False
napoleon_attr_annotations = False  # signatures have them
napoleon_custom_sections = [("Attributes", "params_style")]  # as it knows no "tail, head" else
html_math_renderer = "mathml"

html_theme = "furo"
html_title = "rightofway"
html_static_path = ["_static"]
html_css_files = ["rightofway.css"]
html_search_scorer = str(Path(__file__).parent / "_static" / "scorer.js")
html_copy_source = False
html_show_copyright = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f62c9", "color-brand-content": "#1f62c9"},
    "dark_css_variables": {"color-brand-primary": "#7db2ff", "color-brand-content": "#7db2ff"},
}
