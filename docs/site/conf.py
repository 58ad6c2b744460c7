"""Settings of Sphinx for the site that docs/site/build.py assembles."""

from importlib.metadata import version as version_of
from inspect import signature
from pathlib import Path

from docstrings import as_fields, with_budget
from sphinx.pycode import ModuleAnalyzer

import core

ROOT = Path(core.__file__).parent.parent

project = "Bench Dragon"
author = "Bench Dragon contributors"
project_copyright = author
version = release = version_of("bench-dragon")
root_doc = "index"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
# No file of the theme and none of ours comes from another host, and two builds give the same bytes.
html_theme = "pydata_sphinx_theme"
html_title = project
html_static_path = ["_static"]
html_css_files = ["guide.css"]
html_copy_source = False
html_show_sourcelink = False
html_last_updated_fmt = None
html_theme_options = {
    "show_prev_next": False,
    "navbar_align": "left",
    "header_links_before_dropdown": 9,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "logo": {"text": project},
}
# Without it the theme starts in a mode that its own script reports as invalid.
html_context = {"default_mode": "auto"}
myst_heading_anchors = 4
myst_enable_extensions = ["html_image"]
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]  # bodies of several lines in a console session
default_role = "code"  # single backquotes in docstrings are code
add_module_names = False
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_type_aliases = {"ArrayLike": "ArrayLike", "Floats": "Floats"}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 80


def setup(app):
    def convert(_app, kind, _name, described, _options, lines):
        takes_budget = kind == "function" and "budget" in signature(described).parameters
        lines[:] = as_fields(with_budget(list(lines)) if takes_budget else list(lines))

    # The source of a compiled module is not where Python finds the module.
    def find_source(_app, module):
        path = ROOT / f"{module.replace('.', '/')}.py"
        if not path.is_file():
            return None
        analyzer = ModuleAnalyzer.for_file(path, module)
        return analyzer.code, analyzer.find_tags()

    app.connect("autodoc-process-docstring", convert)
    app.connect("viewcode-find-source", find_source)
