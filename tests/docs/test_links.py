# SPDX-License-Identifier: MIT
"""Every link between the pages, and from them into the checkout, leads somewhere."""

import re

from test_blocks import DOCUMENTS

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^( *)```.*?^\1```", re.MULTILINE | re.DOTALL)
# Pages that the site generates (tools/site); its own strict build checks them.
GENERATED = ("references.md", "examples.md", "reference/cpp/")


def broken_links(document):
    text = FENCE.sub("", document.read_text(encoding="utf-8"))
    for target in LINK.findall(text):
        path = target.split("#")[0]
        if "://" in path or path.endswith(GENERATED) or "reference/cpp/" in path:
            continue
        if path and not (document.parent / path).exists():
            yield f"{document.name}: {target}"


def test_no_link_is_broken():
    assert not [link for document in DOCUMENTS for link in broken_links(document)]
