# SPDX-License-Identifier: MIT
"""The public names of the package, but for distributions (polhode.vary) and figures."""

import types

import polhode

MODULES = [
    polhode,
    *(thing for name in dir(polhode) if name not in ("vary", "figures")
      and isinstance(thing := getattr(polhode, name), types.ModuleType)),
]  # fmt: skip
# a name has one home
PUBLIC = {
    name: getattr(module, name) for module in MODULES for name in module.__all__
}  # fmt: skip
