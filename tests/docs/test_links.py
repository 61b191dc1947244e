# SPDX-License-Identifier: MIT
"""Every link between the pages, and from them into the checkout, leads somewhere."""

import re

from test_blocks import DOCUMENTS

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def broken_links(document):
    text = FENCE.sub("", document.read_text(encoding="utf-8"))
    for target in LINK.findall(text):
        path = target.split("#")[0]
        if path and "://" not in path and not (document.parent / path).exists():
            yield f"{document.name}: {target}"


def test_no_link_is_broken():
    assert not [link for document in DOCUMENTS for link in broken_links(document)]


def test_every_page_is_in_the_index():
    index = next(d for d in DOCUMENTS if d.name == "index.md")
    listed = {(index.parent / link).resolve() for link in LINK.findall(index.read_text())}
    pages = {d.resolve() for d in DOCUMENTS if index.parent in d.parents and d != index}
    assert not pages - listed
