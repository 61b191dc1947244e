# SPDX-License-Identifier: MIT
"""The style of the references: labels are the keys, and an entry without a DOI says why.

Every entry of docs/references.bib has a `doi`, or a `nodoi`; tests/docs/test_site.py checks it."""

from pybtex.plugin import register_plugin
from pybtex.style.formatting.unsrt import Style as Unsorted
from pybtex.style.formatting.unsrt import field, sentence
from pybtex.style.labels import BaseLabelStyle
from pybtex.style.template import join, optional


class Keys(BaseLabelStyle):
    def format_labels(self, sorted_entries):
        return [entry.key for entry in sorted_entries]


class Style(Unsorted):
    default_label_style = Keys
    default_sorting_style = "author_year_title"

    def format_web_refs(self, e):
        why = join["No DOI: ", field("nodoi")]
        return sentence[super().format_web_refs(e), optional[why]]


def setup(app):
    register_plugin("pybtex.style.formatting", "polhode", Style)
    return {"parallel_read_safe": True}
