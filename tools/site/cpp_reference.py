# SPDX-License-Identifier: MIT
"""The C++ reference: the directive `cpp-layer`, which shows the public headers of a layer.

Of each header it shows the labels of its first comment, or of each of its parts, and what it
declares, as clang sees it, in the C++ domain of Sphinx. A comment belongs to the declaration that
it stands before or behind. Bodies of functions, private members, namespaces detail and explicit
instantiations are left out."""

import functools
import itertools
import pathlib
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass

from checkout import shows
from clang.cindex import AccessSpecifier, Cursor, CursorKind, Index
from restructured import escaped, indented, nested
from sphinx.addnodes import pending_xref
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.docutils import SphinxDirective
from sphinx.util.nodes import make_refnode

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = ROOT / "include/polhode"
sys.path.insert(0, str(ROOT / "tools"))
import compiler_headers  # noqa: E402
from headers import LABELS  # noqa: E402

LABEL = re.compile(rf"^({'|'.join(LABELS)})(?: {{2,}}|$)|^(Corrections) ")
PAGE = re.compile(r"docs/([\w/-]+)\.md")
FUNCTIONS = {
    CursorKind.FUNCTION_DECL, CursorKind.FUNCTION_TEMPLATE, CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR, CursorKind.DESTRUCTOR, CursorKind.CONVERSION_FUNCTION,
}  # fmt: skip
CLASSES = {
    CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.CLASS_TEMPLATE,
    CursorKind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION,
}  # fmt: skip
VALUES = {CursorKind.VAR_DECL, CursorKind.FIELD_DECL}
ALIASES = {CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPE_ALIAS_TEMPLATE_DECL}
CONCEPT = CursorKind(604)  # these bindings do not name it
LEFT_OUT = re.compile(r"//[^\n]*|/\*.*?\*/|\binline\b|\[\[gnu::\w+\]\]")
LONG = 60  # of an initial value


@functools.cache
def source(name: str) -> bytes:
    return pathlib.Path(name).read_bytes()


def slice_of(cursor: Cursor, end: int | None = None) -> str:
    """The source of a declaration without comments, up to its end or an offset."""
    extent = cursor.extent
    text = source(cursor.location.file.name)[extent.start.offset : end or extent.end.offset]
    return " ".join(LEFT_OUT.sub("", text.decode()).split())


def outside_brackets(text: str, wanted: str) -> int:
    """Where a character first stands outside of all brackets; the length where it never does."""
    depth = 0
    for at, c in enumerate(text):
        if c == wanted and not depth and ":" not in (text[at - 1], text[at + 1 : at + 2]):
            return at
        depth += (c in "([{<") - (c in ")]}>" and text[at - 1 : at + 1] not in ("->", "<="))
    return len(text)


def body_start(cursor: Cursor) -> int | None:
    """The offset of the body of a function."""
    bodies = [c for c in cursor.get_children() if c.kind == CursorKind.COMPOUND_STMT]
    return bodies[0].extent.start.offset if bodies else None


def function(cursor: Cursor) -> tuple[str, str]:
    text = slice_of(cursor, body_start(cursor))
    text = text[: outside_brackets(text, ":")]
    return "function", re.sub(r" = defa\w*$", "", text)


def class_(cursor: Cursor) -> tuple[str, str]:
    """Behind `template <class T> requires(...)` the word that is outside of brackets."""
    text = slice_of(cursor).partition("{")[0]
    for match in re.finditer(r"\b(class|struct) ", text):
        before = text[: match.start()]
        if all(before.count(a) == before.count(b) for a, b in ("<>", "()")):
            return match[1], before + text[match.end() :]
    raise ValueError(text)


def value(cursor: Cursor) -> tuple[str, str]:
    """A variable or a member; of `double x = 0, y` the y: `double y`."""
    word = "var" if cursor.kind == CursorKind.VAR_DECL else "member"
    text = first = slice_of(cursor)
    while (comma := outside_brackets(text, ",")) < len(text):
        text = text[comma + 1 :].strip()
    if text != first:
        first = first[: outside_brackets(first, ",")]
        text = re.sub(r"\w+\s*$", "", re.split("[={]", first)[0]) + text
    text = text.partition("{")[0].rstrip("= ")
    equals = outside_brackets(text, "=")
    return word, text if len(text) - equals < LONG else text[:equals]


def declared(cursor: Cursor) -> tuple[str, str] | None:
    """The directive of the C++ domain and its argument; None for what is not shown."""
    kind, text = cursor.kind, slice_of(cursor)
    if re.match(r"extern template|template [^<]|friend class|static_assert", text):
        return None
    if kind in FUNCTIONS:
        return function(cursor)
    if kind in CLASSES:
        return class_(cursor) if cursor.is_definition() else None
    if kind in VALUES:
        return value(cursor)
    if kind in ALIASES:
        text = re.sub(r"\busing ", "", text)
        return "type", text.partition(" = ")[0] if "decltype" in text else text
    if kind == CursorKind.ENUM_DECL:
        head = text.partition("{")[0]
        return ("enum-class" if "class " in head else "enum"), re.sub(r"^enum (class )?", "", head)
    if kind == CursorKind.ENUM_CONSTANT_DECL:
        return "enumerator", text
    if kind == CONCEPT:
        return "concept", re.sub(r"\bconcept (\w+) .*", r"\1", text)
    if re.match(r"template\b.*\bconstexpr\b", text):
        return "var", text[: outside_brackets(text, "=")]
    return None


def comment_before(cursor: Cursor) -> str:
    lines = [x.strip() for x in (cursor.raw_comment or "").splitlines() if "NOLINT" not in x]
    return "\n".join(x.removeprefix("//").strip() for x in lines)


def comment_behind(cursor: Cursor) -> str:
    """What stands behind a declaration on its last line."""
    rest = source(cursor.location.file.name)[cursor.extent.end.offset :].partition(b"\n")[0]
    match = re.match(r"[;,]? *// (?!NOLINT)(.*)", rest.decode())
    return match[1] if match else ""


def is_shown(cursor: Cursor, inside: bool) -> bool:
    """Neither private, nor declared before, nor a member defined outside of its class."""
    hidden = (AccessSpecifier.PRIVATE, AccessSpecifier.PROTECTED)
    parent, first = cursor.semantic_parent, cursor.canonical
    outside = not inside and parent is not None and parent.kind in CLASSES
    is_first = first == cursor or "detail" in first.location.file.name
    again = cursor.kind in FUNCTIONS and not is_first
    return not outside and not again and cursor.access_specifier not in hidden


@dataclass
class Entry:
    """Declarations that share a comment, or have none: neighbours without an empty line between."""

    directive: str
    signatures: list[str]
    comment: str
    members: str
    line: int
    open: bool  # the next declaration may join

    def text(self) -> str:
        arguments = f"\n{' ' * (len(self.directive) + 11)}".join(self.signatures)
        comment = escaped(self.comment)
        return f".. cpp:{self.directive}:: {arguments}\n\n{indented(comment + self.members)}\n\n"


def entry(cursor: Cursor, inside: bool) -> Entry | None:
    found = declared(cursor) if is_shown(cursor, inside) else None
    if found is None:
        return None
    before, behind = comment_before(cursor), comment_behind(cursor)
    is_scope = found[0] in ("class", "struct", "enum", "enum-class")
    members = "\n\n" + text_of(cursor.get_children(), True) if is_scope else ""
    comment = before if before.endswith(behind) else f"{before}\n\n{behind}"
    return Entry(found[0], [found[1].strip()], comment, members, cursor.extent.end.line,
                 not is_scope and not behind)  # fmt: skip


def text_of(cursors: Iterable[Cursor], inside: bool = False) -> str:
    """Declarations as reStructuredText, with what is declared in them."""
    found: list[Entry] = []
    for outer in cursors:
        befriended = outer.kind == CursorKind.FRIEND_DECL
        for cursor in outer.get_children() if befriended else [outer]:
            new = entry(cursor, inside)
            if new is None:
                continue
            last = found[-1] if found else None
            near = last and cursor.extent.start.line <= last.line + 1
            same = near and last.directive == new.directive and new.comment in ("", last.comment)
            if same and last.open:
                last.signatures += new.signatures
                last.line, last.open = new.line, new.open
            else:
                found.append(new)
    return "".join(e.text() for e in found)


def arguments() -> list[str]:
    return ["-x", "c++", "-std=c++20", "-fparse-all-comments", f"-I{INCLUDE.parent}",
            *compiler_headers.arguments()]  # fmt: skip


def headers(layer: str) -> list[pathlib.Path]:
    found = sorted((INCLUDE / layer).glob("*.hpp"))
    return [path for path in found if path.name != "polhode.hpp"]


@functools.cache
def declarations() -> dict[str, list[Cursor]]:
    paths = sorted(INCLUDE.rglob("*.hpp"))
    return declarations_of([path for path in paths if "detail" not in path.parts])


def declarations_of(paths: list[pathlib.Path]) -> dict[str, list[Cursor]]:
    """What each header declares in namespace polhode: its path -> cursors."""
    text = "".join(f'#include "{path}"\n' for path in paths)
    unit = Index.create().parse("all.cpp", arguments(), [("all.cpp", text)])
    errors = [str(d) for d in unit.diagnostics if d.severity >= 3]
    if errors:
        raise RuntimeError("\n".join(errors))
    found = {str(path): [] for path in paths}

    def visit(scope: Cursor) -> None:
        for cursor in scope.get_children():
            file = cursor.location.file
            if file is None or file.name not in found:
                continue
            if cursor.kind == CursorKind.NAMESPACE:
                if "detail" not in cursor.spelling:
                    visit(cursor)
            elif scope.kind == CursorKind.NAMESPACE:
                found[file.name].append(cursor)

    visit(unit.cursor)
    found["unit"] = [unit.cursor]  # keeps it alive
    return found


def labels(lines: Iterable[str]) -> list[tuple[str, str]]:
    """Of a comment: ("", what it is), then each label with its text."""
    found = [["", ""]]
    for line in lines:
        line = line.removeprefix("//").removeprefix(" ")
        match = LABEL.match(line)
        if match:
            found.append([match[1] or match[2], line[match.end() :].strip()])
        else:
            found[-1][1] += " " + line.strip()
    return [(label, " ".join(text.split())) for label, text in found]


def parts(path: pathlib.Path) -> list[tuple[int, list[tuple[str, str]]]]:
    """The first comment and each later one with labels: its line and what it says."""
    text = path.read_text(encoding="utf-8").partition("\n")[2]
    found = []
    for comment in re.finditer(r"(?:^//[^\n]*\n)+", text, re.MULTILINE):
        said = labels(comment[0].splitlines())
        if not found or said[1:]:
            found.append((text.count("\n", 0, comment.start()), said))
    return found


def prose(text: str) -> str:
    """The text of a label; pages that it names become links."""
    return PAGE.sub(r":doc:`\1 </\1>`", escaped(text))


def part_text(said: list[tuple[str, str]]) -> str:
    (_, what), *rest = said
    fields = "".join(f"   :{label}: {prose(text)}\n" for label, text in rest
                     if text.rstrip(".") != "none")  # fmt: skip
    return f"{prose(what)}\n\n" + (f".. container:: labels\n\n{fields}\n\n" if fields else "")


def scope(cursor: Cursor) -> str:
    """The namespace of a declaration; inline ones are left out."""
    names, at = [], cursor.lexical_parent
    while at is not None and at.kind == CursorKind.NAMESPACE:
        names += [] if re.fullmatch(r"v\d+", at.spelling) else [at.spelling]
        at = at.lexical_parent
    return "::".join(reversed(names))


def header_text(path: pathlib.Path) -> str:
    (_, first), *later = parts(path)
    name = path.relative_to(INCLUDE.parent)
    text = part_text(first) + f".. code-block:: cpp\n\n   #include \"{name}\"\n\n"
    ends = [line for line, _ in later] + [sys.maxsize]
    begin = 0
    for end, said in zip(ends, [None, *(said for _, said in later)], strict=True):
        text += part_text(said) if said else ""
        shown = [c for c in declarations()[str(path)] if begin <= c.location.line < end]
        for within, some in itertools.groupby(shown, scope):
            text += f".. cpp:namespace:: {within}\n\n{text_of(some)}"
        begin = end
    return text


class CppLayer(SphinxDirective):
    required_arguments = 1

    def run(self):
        out = []
        for path in headers(self.arguments[0].strip(".")):
            self.env.note_dependency(str(path))
            section = nested(self, path.name, header_text(path))
            shows(self.env, path, section["ids"][0])
            out.append(section)
        return out


class Types(SphinxPostTransform):
    """Links from signatures to what they name. The C++ domain would find them, but looks at every
    symbol for each of six thousand names: a fifth of the time of the build."""

    default_priority = 5  # before Sphinx resolves references

    def run(self, **_):
        for node in list(self.document.findall(pending_xref)):
            if node.get("refdomain") == "cpp":
                place = types_of(self.env).get(node["reftarget"])
                shown = node.children
                if place:
                    page = self.env.docname
                    shown = [make_refnode(self.app.builder, page, *place, node.children)]
                node.replace_self(shown)


def types_of(env) -> dict[str, tuple[str, str]]:
    """Classes, aliases, concepts and enumerations of namespace polhode: name, with and without the
    namespaces in it -> page and anchor."""
    if not hasattr(env, "polhode_types"):
        objects = env.domains.cpp_domain.get_objects()
        places = {name.removeprefix("polhode::"): (page, anchor)
                  for name, _, kind, page, anchor, _ in objects
                  if kind in ("class", "type", "concept", "enum")}  # fmt: skip
        env.polhode_types = {name.rpartition("::")[2]: at for name, at in places.items()} | places
    return env.polhode_types


def forget_types(app, env) -> None:
    env.__dict__.pop("polhode_types", None)


def parse_once(app, env, docnames) -> None:
    """Before processes part to read the pages."""
    if any(name.startswith("reference/cpp/") for name in docnames):
        declarations()


def setup(app):
    app.connect("env-before-read-docs", parse_once)
    app.add_directive("cpp-layer", CppLayer)
    app.add_post_transform(Types)
    app.connect("env-updated", forget_types)
    return {"parallel_read_safe": True}
