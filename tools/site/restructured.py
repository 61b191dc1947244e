# SPDX-License-Identifier: MIT
"""Plain text of comments and docstrings as reStructuredText, and such text as a section."""

import re
import textwrap

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

CODE = re.compile(r"``?([^`]+)``?")


def escaped(text: str) -> str:
    """Plain text in which nothing is marked but, by backticks, code."""
    parts = CODE.split(text)
    parts[::2] = [re.sub(r"([\\*|_])", r"\\\1", part) for part in parts[::2]]
    parts[::2] = [re.sub(r"(?:\\\*){2}(\w+)(?:\\\*){2}", r"**\1**", part) for part in parts[::2]]
    parts[1::2] = [f"``{part}``" for part in parts[1::2]]
    return "".join(parts)


def indented(text: str) -> str:
    return textwrap.indent(text, "   ")


def nested(directive: SphinxDirective, title: str, text: str) -> nodes.section:
    """A section of reStructuredText in a page of Markdown."""
    section = nodes.section("", nodes.title("", title), names=[nodes.fully_normalize_name(title)])
    directive.state.document.note_implicit_target(section, section)
    lines = ["```{eval-rst}", *text.splitlines(), "```"]
    source, line = directive.get_source_info()
    content = StringList(lines, source=source)
    directive.state.nested_parse(content, directive.content_offset, section)
    return section
