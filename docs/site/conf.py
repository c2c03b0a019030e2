"""Builds the manual as a site with Sphinx: `./run site`. The pages are those of docs/, unchanged."""

import re
from pathlib import Path

from docutils import nodes

docs = Path(__file__).resolve().parent.parent

project = "recoil"
author = "The recoil authors"
copyright = author  # noqa: A001
release = re.search(r"project\(recoil VERSION ([\d.]+)", (docs.parent / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "README"
include_patterns = ["*.md"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
suppress_warnings = ["myst.header"]

html_theme = "furo"
html_title = f"recoil {release}"
html_static_path = ["/usr/share/javascript/katex"]
html_extra_path = [str(page) for page in [docs.parent / "build/web/recoil.html"] if page.exists()]
html_css_files = ["katex.min.css"]
html_js_files = ["katex.min.js", "equations.js"]
html_math_renderer = "katex"
html_show_sphinx = False
html_copy_source = False
pygments_style = "friendly"
pygments_dark_style = "monokai"


def sections_as_menu(app, name, text):
    """The headings of README.md and the pages under them are the menu."""
    if name != root_doc:
        return
    parts = re.split(r"(?m)^## (.*)$", text[0])
    out = parts[0]
    for title, body in zip(parts[1::2], parts[2::2]):
        pages = "\n".join(dict.fromkeys(re.findall(r"\]\(([\w-]+)\.md\)", body)))
        menu = f"```{{toctree}}\n:hidden:\n:caption: {title.strip()}\n\n{pages}\n```\n"
        out += f"## {title}{body.rstrip()}\n\n{menu}\n"
    text[0] = out


def links_into_the_project(app, name, text):
    """Links that leave docs/ have no page on the site: only their words stay. Pygments has no csv."""
    text[0] = text[0].replace("```csv\n", "```text\n")
    text[0] = re.sub(r"\[([^\]]+)\]\((?:\.\./|tour\.ipynb)[^)]*\)", r"\1", text[0])


def equation(self, node, tag):
    self.body.append(f'<{tag} class="math">{self.encode(node.astext())}</{tag}>')
    raise nodes.SkipNode


def the_page(app, name, text):
    """The pages that speak of the program in one HTML file link it if it was made."""
    if html_extra_path and name in (root_doc, "browser"):
        text[0] = re.sub(r"(?m)^(# .*)$", r"\1\n\n```{raw} html\n"
                         r'<p><a href="recoil.html">Open recoil in this browser</a></p>' r"\n```", text[0], count=1)


def setup(app):
    app.add_html_math_renderer(
        "katex", (lambda self, node: equation(self, node, "span"), None),
        (lambda self, node: equation(self, node, "div"), None))
    app.connect("source-read", sections_as_menu)
    app.connect("source-read", links_into_the_project)
    app.connect("source-read", the_page)
    app.connect("build-finished", lambda app, error: (Path(app.outdir) / "_static/equations.js")
                .write_text('document.addEventListener("DOMContentLoaded", () => {\n'
                            '  for (const e of document.querySelectorAll(".math"))\n'
                            '    katex.render(e.textContent, e, {displayMode: e.tagName === "DIV"});\n'
                            "});\n"))
