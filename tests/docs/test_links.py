# SPDX-License-Identifier: MIT
"""Every link between the pages, and from them into the checkout, leads somewhere; every file that
says where the repository is says the same."""

import re
import sys

from test_blocks import DOCUMENTS, ROOT

sys.path.insert(0, str(ROOT / "tools"))
import repository  # noqa: E402

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^( *)```.*?^\1```", re.MULTILINE | re.DOTALL)


def broken_links(document):
    text = FENCE.sub("", document.read_text(encoding="utf-8"))
    for target in LINK.findall(text):
        path = target.split("#")[0]
        if path and "://" not in path and not (document.parent / path).exists():
            yield f"{document.name}: {target}"


def test_no_link_is_broken():
    assert not [link for document in DOCUMENTS for link in broken_links(document)]


def test_one_address_of_the_repository():
    found = repository.addresses()
    assert len({address for said in found.values() for address in said}) == 1
    assert all(len(said) == 1 for said in found.values()), found
