# SPDX-License-Identifier: MIT
"""Renamed public names: names.tsv has a line OLD TAB NEW for each key, option, column or name in
Python or C++. Only whole words match; an option has its dashes: --old-name.
"""

import pathlib
import re

TABLE = pathlib.Path(__file__).with_name("names.tsv")


def replaced(pairs, text):
    """In one pass, so that two names can be exchanged."""
    if not pairs:
        return text
    longest_first = sorted(pairs, key=len, reverse=True)
    words = "|".join(map(re.escape, longest_first))
    return re.sub(rf"(?<![\w-])(?:{words})(?![\w-])", lambda found: pairs[found[0]], text)


class Names:
    def __init__(self, table=TABLE):
        lines = [line for line in table.read_text(encoding="utf-8").splitlines()
                 if line and not line.startswith("#")]
        self.pairs = dict(line.split("\t") for line in lines)

    def to_new(self, text):
        return replaced(self.pairs, text)

    def to_old(self, data):
        """For inputs; binary data stay as they are."""
        try:
            return replaced({new: old for old, new in self.pairs.items()},
                            data.decode("utf-8")).encode("utf-8")
        except UnicodeDecodeError:
            return data
