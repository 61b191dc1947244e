#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where the types of other packages are documented: docs/inventories/PROJECT.txt.

    tools/site/inventories.py                     asks every project (needs the network)
    tools/site/inventories.py python=OBJECTS.INV  reads a file, such as that of a package -doc

The build needs no network: it reads these few names, in the oldest form of Sphinx's inventories,
which is text. A name that the reference shows and NAMES lacks is shown without a link."""

import pathlib
import sys
import urllib.request

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs/inventories"
ADDRESSES = {
    "python": "https://docs.python.org/3/",
    "numpy": "https://numpy.org/doc/stable/",
    "scipy": "https://docs.scipy.org/doc/scipy/",
    "matplotlib": "https://matplotlib.org/stable/",
    "pandas": "https://pandas.pydata.org/docs/",
    "xarray": "https://docs.xarray.dev/en/stable/",
}
NAMES = {
    "python": "bool bytes complex dict float frozenset int list object str tuple None "
    "ArithmeticError Exception KeyboardInterrupt OSError TypeError ValueError "
    "collections.abc.Callable collections.abc.Iterable collections.abc.Iterator "
    "collections.abc.Mapping collections.abc.Sequence datetime.datetime enum.Enum "
    "fractions.Fraction os.PathLike pathlib.Path typing.Any typing.SupportsIndex",
    "numpy": "numpy.datetime64 numpy.dtype numpy.float64 numpy.int32 numpy.int64 numpy.ndarray "
    "numpy.typing.ArrayLike numpy.typing.NDArray",
    "scipy": "scipy.spatial.transform.Rotation",
    "matplotlib": "matplotlib.axes.Axes matplotlib.figure.Figure",
    "pandas": "pandas.DataFrame",
    "xarray": "xarray.Dataset",
}


def mapping() -> dict[str, tuple[str, str]]:
    """What intersphinx takes."""
    return {name: (address, str(FOLDER / f"{name}.txt")) for name, address in ADDRESSES.items()}


def short_names() -> dict[str, str]:
    """ArrayLike -> numpy.typing.ArrayLike: names as modules import them."""
    return {name.rpartition(".")[2]: name for names in NAMES.values() for name in names.split()}


def text(project: str, content: bytes) -> str:
    from sphinx.util.inventory import InventoryFile

    known = InventoryFile.loads(content, uri="")
    lines = ["# Sphinx inventory version 1", f"# Project: {project}", "# Version: "]
    for name in NAMES[project].split():
        pages = [items[name].uri for kind, items in known.data.items()
                 if kind.startswith("py:") and name in items]  # fmt: skip
        page, _, anchor = pages[0].partition("#") if pages else ("", "", "")
        if anchor != name:
            raise SystemExit(f"{project}: no {name} with an anchor of its name: {pages}")
        lines.append(f"{name} class {page}")  # whatever it is, annotations take it for a class
    return "\n".join(lines) + "\n"


def main() -> None:
    files = dict(argument.split("=") for argument in sys.argv[1:])
    for project, address in ADDRESSES.items():
        if project in files:
            content = pathlib.Path(files[project]).read_bytes()
        elif files:
            continue
        else:
            content = urllib.request.urlopen(f"{address}objects.inv", timeout=60).read()
        (FOLDER / f"{project}.txt").write_text(text(project, content), encoding="utf-8")


if __name__ == "__main__":
    main()
