# SPDX-License-Identifier: MIT
"""What a C++ header declares, as a reader of a reference wants it.

Not a parser of C++ but of the headers of this repository, which clang-format has laid out: bodies
of functions, private members, namespace detail, instantiations and preprocessor lines are left out;
comments stay with the declaration that they stand before or behind."""

import re

# Comments, strings and characters are skipped as a whole.
ATOM = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'|.', re.DOTALL)
CLOSING = {"(": ")", "{": "}", "[": "]"}
LEFT_OUT = re.compile(r"extern template|template [^<]|friend class|static_assert")
ACCESS = re.compile(r"(public|private|protected)$")


class Reader:
    """The atoms of a text, and where the reading is."""

    def __init__(self, text: str):
        self.atoms = ATOM.findall(text)
        self.at = 0

    def more(self) -> bool:
        return self.at < len(self.atoms)

    def take(self) -> str:
        self.at += 1
        return self.atoms[self.at - 1]

    def peek(self) -> str:
        """The next atom that is not white space; nothing is taken."""
        later = (a for a in self.atoms[self.at:] if not a.isspace())
        return next(later, "")

    def group(self, opening: str) -> str:
        """What follows an opening bracket, up to the bracket that closes it."""
        closing, depth, taken = CLOSING[opening], 1, []
        while depth:
            taken.append(self.take())
            depth += (taken[-1] == opening) - (taken[-1] == closing)
        return "".join(taken)

    def rest_of_line(self) -> str:
        """A comment behind a declaration, on its line."""
        taken = []
        while self.more() and self.atoms[self.at] in (" ", "\t"):
            taken.append(self.take())
        if self.more() and self.atoms[self.at].startswith("//"):
            return "  " + self.take()
        return ""


def without_comments(text: str) -> str:
    return re.sub(r"//[^\n]*", "", text).strip()


def without_template(code: str) -> str:
    """The code behind `template <...>` and a requires-clause on a line of its own."""
    while match := re.match(r"template\s*<", code):
        end, depth = match.end(), 1
        while depth:
            depth += (code[end] == "<") - (code[end] == ">")
            end += 1
        code = re.sub(r"^\s*(requires\b[^\n]*\n)?\s*", "", code[end:])
    return code


def kind_of(head: str) -> str:
    """What a brace after this text opens."""
    code = without_template(without_comments(head))
    if re.match(r"(inline\s+)?namespace\b", code):
        return "namespace"
    if re.match(r"enum\b", code):
        return "verbatim"
    if re.match(r"(class|struct|union)\b", code) and "(" not in code.split(":")[0]:
        return "class"
    if re.search(r"\)\s*requires\s*\([^()]*\)\s*$", code):
        return "function"  # with a clause behind its parameters
    if re.search(r"^concept\b|\brequires\s*\([^()]*\)\s*$", code):
        return "verbatim"
    before_call = code.split("(")[0]
    if re.search(r"(?<![=!<>])=(?!=)", before_call) and "operator" not in before_call:
        return "value"
    return "function" if "(" in code else "value"


def initializer_at(head: str) -> int | None:
    """Where the initialisers of a constructor start: a single colon outside of brackets."""
    depth = 0
    for match in re.finditer(r"//[^\n]*|::|[()<>:]", head):
        token = match[0]
        depth += token in "(<" and len(token) == 1
        depth -= token in ")>" and len(token) == 1
        if token == ":" and depth == 0 and ")" in head[:match.start()]:
            return match.start()
    return None


def is_outside_definition(head: str) -> bool:
    """A member defined after its class, which declares it."""
    name = re.match(r"(?s).*?([\w:~<>]+|operator[^\w\s]+)\s*\(", without_comments(head))
    return bool(name and re.search(r"(?<!std)::~?\w+$", name[1]))


def function(reader: Reader, head: str) -> str:
    """The declaration of a function whose body begins."""
    start = initializer_at(head)
    reader.group("{")
    while start is not None and reader.peek() in (",", "{"):
        while reader.take() != "{":
            pass
        reader.group("{")
    if is_outside_definition(head):
        reader.rest_of_line()
        return ""
    return (head if start is None else head[:start]).rstrip() + ";" + reader.rest_of_line()


def scope(reader: Reader, in_class: bool = False, hidden: bool = False) -> str:
    """The declarations up to the brace that closes the scope."""
    out, head = [], ""

    def add(text):
        if not hidden and text.strip():
            out.append(text)

    while reader.more():
        atom = reader.take()
        code = without_comments(head)
        if atom == "#" and not code:
            while reader.take() != "\n":
                pass
        elif atom == "}":
            return "".join(out)
        elif atom in "([":
            head += atom + reader.group(atom)
        elif atom == ":" and in_class and ACCESS.search(code):
            hidden = not code.endswith("public")
            add(head + ":")
            head = ""
        elif atom == ";":
            text = head + ";" + reader.rest_of_line()
            add("" if LEFT_OUT.match(code) else text)
            head = ""
        elif atom == "{":
            add(opened(reader, head))
            head = ""
        else:
            head += atom
    return "".join(out)


def opened(reader: Reader, head: str) -> str:
    """The declaration whose head is followed by an opening brace."""
    kind = kind_of(head)
    if kind == "function":
        return function(reader, head)
    if kind == "namespace":
        inner = scope(reader)
        reader.rest_of_line()
        return "" if re.search(r"namespace \w*detail", head) else inner
    if kind == "class":
        is_class = without_template(without_comments(head)).startswith("class")
        body = "{" + scope(reader, in_class=True, hidden=is_class).rstrip() + "\n}"
    else:
        body = "{" + reader.group("{")
        if kind == "value" and body.count("\n") > 8:
            body = "{ ... }"
    tail = ""
    while not tail.endswith(";"):
        atom = reader.take()
        tail += atom + (reader.group(atom) if atom in "({" else "")
    return head + body + tail + reader.rest_of_line()


def declarations(text: str) -> str:
    """What the header declares in namespace polhode, with its comments."""
    body = text.split("#pragma once", 1)[1]
    found = re.sub(r" *// NOLINT[^\n]*", "", scope(Reader(body)))
    found = re.sub(r"[ \t]+\n", "\n", found)
    found = re.sub(r"(;) {2,}//", r"\1  //", found)
    found = re.sub(r"\{\n\n+", "{\n", found)
    return re.sub(r"\n{3,}", "\n\n", found).strip("\n")
