# SPDX-License-Identifier: MIT
"""Declarations of a C++ source with the comments that belong to them.

Only the syntax of namespaces, classes and comments is read: comments, strings and preprocessor
lines are told from code, and braces are matched. A comment belongs to the declaration that holds
it, else to the declarations that follow it without an empty line or another comment between.
"""

import bisect
import re
from dataclasses import dataclass, field

TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*.*?\*/)"
    r"|(?P<raw>R\"(?P<end>[^\s()\\]{0,16})\(.*?\)(?P=end)\")"
    r"|(?P<string>\"(?:\\.|[^\"\\\n])*\")"
    r"|(?P<number>\b\d(?:[\w.]|'\w)*)"
    r"|(?P<char>'(?:\\.|[^'\\\n])+')"
    r"|(?P<line>^[ \t]*#(?:\\\n|[^\n])*)",
    re.DOTALL | re.MULTILINE)
NAMESPACE = re.compile(r"(?:inline\s+)?namespace\b[^{;=]*\{|extern\s*\{")
ACCESS = re.compile(r"(?:public|protected|private)\s*:(?!:)")
CLASS = re.compile(r"(?:class|struct|union|enum(?:\s+class)?)\s+([\w:]+)[^;({=]*[{;]"
                   r"|concept\s+(\w+)")


@dataclass
class Declaration:
    """One declaration: its name (None if it has none of its own), offsets, and members."""

    name: str | None
    first: int
    last: int
    members: list = field(default_factory=list)


def blanked(text):
    """The code alone, every offset kept, and the offsets of the comments."""
    comments, parts, at = [], [], 0
    for match in TOKEN.finditer(text):
        if match["number"]:
            continue
        parts.append(text[at:match.start()])
        parts.append(re.sub(r"[^\n]", " ", match[0]))
        at = match.end()
        if match["comment"]:
            comments.append(match.span())
    return "".join(parts) + text[at:], comments


def balanced(code, at, opening, closing):
    """The offset after the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(code)):
        depth += (code[i] == opening) - (code[i] == closing)
        if depth == 0:
            return i + 1
    return len(code)


def after_template(head):
    """A declaration without `template <...> requires ...` in front."""
    while match := re.match(r"\s*(?:template\s*(?=<)|requires\s*(?=\()|\[\[[^\]]*\]\])", head):
        at = match.end()
        if at < len(head) and head[at] in "<(":
            at = balanced(head, at, head[at], ">" if head[at] == "<" else ")")
        head = head[at:]
    match = re.match(r"\s*requires\s+[\w:]+(?=<)", head)
    return after_template(head[balanced(head, match.end(), "<", ">"):]) if match else head


def name_of(declaration):
    """The name that a declaration introduces; None for an explicit instantiation."""
    head = after_template(declaration).strip()
    if head.startswith(("extern template", "friend", "static_assert")):
        return None
    if re.match(r"(?:class|struct|union|enum|concept)\b", head):
        match = CLASS.match(head)
        return (match[1] or match[2]) if match else None
    if match := re.match(r"using\s+(\w+)\s*=", head):
        return match[1]
    head = re.sub(r"\b(?:decltype|noexcept|alignas|explicit)\s*\((?:[^()]|\([^()]*\))*\)", "", head)
    while (flat := re.sub(r"<[^<>(){};=]*>", "", head)) != head:
        head = flat
    call = re.search(r"(operator\s*\W{1,3}?|~?[\w:]*\w)\s*\(", head)
    value = re.match(r"[^=;{(,]*?(\w+)\s*[=;{]", head)
    if call and not (value and value.end() <= call.start() + 1):
        return call[1]
    return value[1] if value else None


def is_value(head):
    """Whether a declaration gives a value: a brace of it is not the body of a function."""
    head = re.sub(r"\((?:[^()]|\([^()]*\))*\)", "", after_template(head))
    return bool(re.search(r"(?<![=!<>])=(?!=)", re.sub(r"operator\s*[^\w\s]+", "", head)))


def end_of(code, at):
    """The offset after the declaration that starts at `at`."""
    first, value = at, False
    while at < len(code):
        c = code[at]
        if c == ";":
            return at + 1
        if c == "(":
            at = balanced(code, at, "(", ")")
        elif c == "{":
            value = value or is_value(code[first:at])
            at = balanced(code, at, "{", "}")
            follow = re.compile(r"\s*(.?)", re.DOTALL).match(code, at)[1]
            if follow == ";":
                return code.index(";", at) + 1
            if not value and follow not in (",", "{", ")", "("):
                return at
        elif c == "}":
            return at
        else:
            at += 1
    return at


def declarations(code, at=0, stop=None, in_class=False):
    """The declarations of a file, or the members of a class."""
    found, stop = [], len(code) if stop is None else stop
    while at < stop:
        if code[at].isspace() or code[at] in "};":
            at += 1
            continue
        skipped = ACCESS.match(code, at) if in_class else NAMESPACE.match(code, at)
        if skipped:
            at = skipped.end()
            continue
        end = min(max(end_of(code, at), at + 1), stop)
        item = Declaration(name_of(code[at:end]), at, end)
        brace = code.find("{", at, end)
        if brace >= 0 and not in_class and re.match(
                r"(?:class|struct)\b", after_template(code[at:end]).lstrip()):
            item.members = declarations(code, brace + 1, end, True)
        found.append(item)
        at = end
    return found


class Source:
    """A C++ source: which declarations a comment at some offset belongs to."""

    def __init__(self, text):
        self.text = text
        self.code, comments = blanked(text)
        self.items = declarations(self.code)
        self.blocks = self.joined(comments)

    def joined(self, comments):
        """Comments on lines of their own that follow one another are one block."""
        blocks = []
        for first, last in comments:
            alone = not self.text[self.text.rfind("\n", 0, first) + 1:first].strip()
            if blocks and alone and blocks[-1][2] and not self.text[blocks[-1][1]:first].strip() \
                    and self.text.count("\n", blocks[-1][1], first) == 1:
                blocks[-1][1] = last
            else:
                blocks.append([first, last, alone])
        return blocks

    def owners(self, offset):
        """Names of the declarations that the comment at `offset` belongs to, `Class::member` of
        members; none if it belongs to the file."""
        first, last, alone = self.blocks[
            bisect.bisect_right([block[0] for block in self.blocks], offset) - 1]
        holder = next((i for i in self.items if i.first <= first < i.last), None)
        if holder is None:
            trailing = None if alone else self.before(self.items, first)
            return [i.name for i in ([trailing] if trailing else self.following(self.items, last))
                    if i.name]
        if not holder.members:
            return [holder.name] if holder.name else []
        member = next((m for m in holder.members if m.first <= first < m.last), None)
        if member is None and not alone:
            member = self.before(holder.members, first)
        members = [member] if member else self.following(holder.members, last)
        names = [f"{holder.name}::{m.name}" for m in members if m.name]
        return names or [holder.name]

    def before(self, items, offset):
        """The declaration that ends on the line of a trailing comment."""
        return next((i for i in items if i.last <= offset and
                     "\n" not in self.text[i.last:offset]), None)

    def following(self, items, offset):
        """The declarations right after a comment, up to an empty line or another comment."""
        found = []
        for item in items:
            if item.first < offset:
                continue
            between = self.text[offset:item.first]
            if between.strip() or between.count("\n") > 1:
                break
            found.append(item)
            offset = item.last
        return found
