# SPDX-License-Identifier: MIT
"""Every mutant of a source, read from its syntax tree by libclang; none in a macro, in a constant
expression or among template arguments."""

import functools
import json
import pathlib
import re
import shlex

import compiler_headers
from clang import cindex

from . import operators
from .mutant import Mutant, numbered

Kind = cindex.CursorKind
LAYERS = ("elliptic", "rotor", "orbit", "free", "perturb", "system", "dynamics",
          "secular")
VECTORS = ("Vec3", "Quaternion", "Mat3", "Phasor", "Matrix6")
MACRO = re.compile(r"\b(?:[A-Z][A-Z0-9]*_[A-Z0-9_]+|NAN|INFINITY|assert)\b")
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE,
             Kind.DESTRUCTOR, Kind.CONVERSION_FUNCTION}
SCOPES = {Kind.NAMESPACE, Kind.CLASS_DECL, Kind.STRUCT_DECL, Kind.CLASS_TEMPLATE,
          Kind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION, Kind.LINKAGE_SPEC, Kind.UNEXPOSED_DECL}
VARIABLES = {Kind.VAR_DECL, Kind.FIELD_DECL}
NAMES = {Kind.TYPE_REF, Kind.TEMPLATE_REF, Kind.NAMESPACE_REF}
# What these bindings have no names for.
for number in (154, 155, 604):  # requires-expression, parenthesised list, concept
    try:
        Kind.from_id(number)
    except ValueError:
        Kind(number)
UNNAMED = {Kind.from_id(154), Kind.from_id(604)}
# Not looked into: constants, types, messages of errors, declarations of other things.
CLOSED = NAMES | UNNAMED | {
    Kind.STATIC_ASSERT, Kind.CXX_THROW_EXPR, Kind.CASE_STMT, Kind.TYPE_ALIAS_DECL,
    Kind.TYPEDEF_DECL, Kind.ENUM_DECL, Kind.USING_DECLARATION, Kind.USING_DIRECTIVE,
    Kind.PARM_DECL, Kind.FRIEND_DECL, Kind.DECL_REF_EXPR, Kind.CXX_NEW_EXPR,
    Kind.SIZE_OF_PACK_EXPR, Kind.CXX_UNARY_EXPR,
}


def files_of(root):
    """The sources that are mutated: {file: layer}."""
    found = {}
    for layer in LAYERS:
        for folder in (f"include/polhode/{layer}", f"src/{layer}"):
            for path in sorted((root / folder).rglob("*.[ch]pp")):
                found[path.relative_to(root).as_posix()] = layer
    return found


def flags_of(database):
    """Include paths, definitions and standard of the release build, as clang takes them."""
    entries = json.loads(pathlib.Path(database).read_text())
    command = next(shlex.split(e["command"]) for e in entries if "/src/free/" in e["file"])
    flags, words = [], iter(command)
    for word in words:
        if word.startswith(("-I", "-D", "-std=")):
            flags.append(word)
        elif word == "-isystem":
            flags += [word, next(words)]
    return ["-x", "c++", *flags, *compiler_headers.arguments(), "-Wno-pragma-once-outside-header"]


def candidates(root, file, layer, flags):
    """Every mutant of `file`, which must compile alone."""
    path = pathlib.Path(root) / file
    unit = cindex.Index.create().parse(str(path), args=flags)
    errors = [d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
    if errors:
        raise ValueError(f"mutate: {file} does not parse: {errors[0]}")
    return _Reader(path.read_bytes(), str(path), file, layer, unit).mutants()


class _Reader:
    def __init__(self, source, path, file, layer, unit):
        self.source, self.path, self.file, self.layer, self.unit = source, path, file, layer, unit
        self.lines = source.decode().split("\n")
        self.found = []

    def mutants(self):
        for c in self.unit.cursor.get_children():
            if self.is_here(c):
                self.declaration(c)
        return numbered(self.found)

    # --- text ---

    def is_here(self, c):
        return c.extent.start.file is not None and c.extent.start.file.name == self.path

    def span(self, c):
        return c.extent.start.offset, c.extent.end.offset

    def text(self, start, end):
        return self.source[start:end].decode()

    def text_of(self, c):
        return self.text(*self.span(c))

    def arguments_start(self, c):
        """Where the template arguments of the name or type that begins `c` have ended."""
        start, end = self.span(c)
        depth, text = 0, self.text(start, end)
        for i, ch in enumerate(text):
            depth += (ch == "<") - (ch == ">" and text[i - 1] != "-")
            if ch in "({" and depth == 0:
                return start + i
        return start

    # --- where to look ---

    def declaration(self, c):
        if c.kind in FUNCTIONS:
            self.function(c)
        elif c.kind in VARIABLES:
            self.variable(c)
        elif c.kind in SCOPES:
            for child in c.get_children():
                if child.kind not in CLOSED:
                    self.declaration(child)

    def function(self, c):
        body = [k for k in c.get_children() if k.kind == Kind.COMPOUND_STMT]
        if not body or "consteval" in self.text(self.span(c)[0], self.span(body[-1])[0]):
            return
        if c.kind == Kind.CONSTRUCTOR or c.kind == Kind.FUNCTION_TEMPLATE:
            for k in c.get_children():
                if k.kind.is_expression() and k.extent.start.offset > c.location.offset:
                    if self.after_colon(c, k):
                        self.visit(k, None)
        self.visit(body[-1], None)

    def after_colon(self, c, k):
        """Whether k stands in the list of initialisers of a constructor."""
        before = self.text(c.location.offset, k.extent.start.offset)
        return re.search(r"\)\s*(?:noexcept)?\s*:\s*\w+[({]", before) is not None

    def variable(self, c):
        start, end = self.span(c)
        name = c.location.offset
        head = self.text(start, name)
        rest = self.text(name, end)
        opening = re.search(r"[={(]", rest)
        if opening is None or re.search(r"\bconstexpr\b|\bconsteval\b", head):
            return
        value = [k for k in c.get_children()
                 if k.kind.is_expression() and k.extent.start.offset >= name + opening.start()]
        kind = c.type.get_canonical()
        if kind.is_const_qualified() and kind.kind != cindex.TypeKind.DOUBLE and value and \
                not any(k.kind == Kind.DECL_REF_EXPR for k in value[-1].walk_preorder()):
            return  # may be a constant expression, where no mutant is active
        for k in value:
            if opening.group() == "=":
                self.sign_of_value(c, k)
            self.visit(k, c)

    def visit(self, c, parent):
        if c.kind in CLOSED:
            if c.kind == Kind.CASE_STMT:
                for k in list(c.get_children())[1:]:
                    self.visit(k, c)
            elif c.kind == Kind.DECL_REF_EXPR:
                self.constant(c)
            return
        if c.kind.is_expression() and (not self.text_of(c) or MACRO.search(self.text_of(c))):
            return
        if c.kind in VARIABLES:
            self.variable(c)
            return
        if c.kind in FUNCTIONS | SCOPES:
            self.declaration(c)
            return
        self.mutate(c, parent)
        inside = list(c.get_children())
        if c.kind == Kind.IF_STMT and re.match(r"if\s+constexpr\b", self.text_of(c)):
            inside = [k for k in inside if not k.kind.is_expression()]
        if c.kind == Kind.LAMBDA_EXPR:
            inside = inside[-1:]
        if c.kind == Kind.MEMBER_REF_EXPR:
            inside = [k for k in inside if k.extent.start.offset == c.extent.start.offset]
        elif any(k.kind in NAMES for k in inside):
            begin = self.arguments_start(c)
            inside = [k for k in inside if k.extent.start.offset >= begin]
        for k in inside:
            self.visit(k, c)

    # --- what to change ---

    def add(self, operator, span, arm, mutated=None, cast=""):
        start, end = span
        original = operators.plain(self.text(start, end))
        if not original or MACRO.search(original):
            return
        if re.search(r"\[[^\]]*\]\s*(\([^)]*\))?\s*(->[^{]*)?\{", original):
            return  # a lambda inside: its type would differ between the arms
        line = self.source.count(b"\n", 0, start)
        self.found.append(Mutant(
            self.file, self.layer, operator, start, end, original, mutated or arm, arm, line + 1,
            self.source.count(b"\n", 0, end) + 1, self.lines[line].strip(), cast))

    def mutate(self, c, parent):
        rule = {
            Kind.BINARY_OPERATOR: self.binary,
            Kind.COMPOUND_ASSIGNMENT_OPERATOR: self.binary,
            Kind.CALL_EXPR: self.call,
            Kind.UNARY_OPERATOR: self.unary,
            Kind.CONDITIONAL_OPERATOR: self.choice,
            Kind.IF_STMT: self.condition,
            Kind.MEMBER_REF_EXPR: self.field,
            Kind.INTEGER_LITERAL: self.literal,
            Kind.FLOATING_LITERAL: self.literal,
        }.get(c.kind)
        if rule is not None:
            rule(c, parent)

    @staticmethod
    @functools.cache
    def is_number(spelling):
        """Whether a type is one of formulas, or may become one: not a text, not a pointer."""
        return not re.search(r"\*|std::(?!array)|basic_string|iterator|char|void", spelling)

    def binary(self, c, parent):
        operands = [k for k in c.get_children() if k.kind not in NAMES]
        if len(operands) == 2:
            (a, b), (d, e) = self.span(operands[0]), self.span(operands[1])
            sign = operators.plain(self.text(b, d))
            self.operation(c, sign, (a, b), (d, e), operands[1].type.spelling)

    def operation(self, c, sign, left, right, divisor=""):
        types = c.type.get_canonical().spelling
        if sign not in operators.SWAPPED or not self.is_number(types):
            return
        a, b = (operators.plain(self.text(*s)) for s in (left, right))
        if a.startswith(("std::string", '"')) or '"' in b:
            return
        logical = sign in ("&&", "||") or sign[0] in "<>!" or sign == "=="
        name = "comparison" if logical else "arithmetic"
        for other in operators.SWAPPED[sign]:
            if other == "/" and any(word in divisor for word in VECTORS):
                continue  # no such thing
            self.add(name, self.span(c), f"({a}) {other} ({b})", f"{a} {other} {b}")
        self.dropped(c, sign, a, b)

    def dropped(self, c, sign, a, b):
        if sign in operators.SUMS:
            self.add("term", self.span(c), a)
            self.add("term", self.span(c), b if sign == "+" else f"-({b})")
        elif sign in ("+=", "-="):
            self.add("term", self.span(c), a)
        elif sign in operators.PRODUCTS:
            left, right = self.may_stand_alone(c)
            if left:
                self.add("factor", self.span(c), a)
            if right and sign == "*":
                self.add("factor", self.span(c), b)

    def may_stand_alone(self, c):
        """Which factor of a product may have its type, as far as types of templates are known."""
        whole = c.type.get_canonical().spelling.replace("const ", "")
        operands = sorted((k for k in c.get_children()
                           if k.kind not in NAMES and not self.is_operator(k)), key=self.span)
        if whole not in ("<dependent type>", ""):
            return [k.type.get_canonical().spelling.replace("const ", "") == whole
                    for k in (operands[0], operands[-1])]
        vectors = [any(word in k.type.spelling for word in VECTORS)
                   for k in (operands[0], operands[-1])]
        return vectors if any(vectors) else [True, True]

    def call(self, c, parent):
        children = list(c.get_children())
        sign = next((k for k in children if self.is_operator(k)), None)
        operands = [k for k in children if k is not sign and k.kind not in NAMES]
        if sign is not None:
            if len(operands) == 2:
                operands.sort(key=self.span)
                left, right = (self.span(k) for k in operands)
                at = self.span(sign)
                if left[1] <= at[0] and at[1] <= right[0]:
                    self.operation(c, self.text(*at), left, right, operands[1].type.spelling)
            elif len(operands) == 1 and self.text_of(sign) == "-":
                self.add("sign", self.span(c), operators.plain(self.text_of(operands[0])))
            return
        match = re.match(r"((?:std::)?)(\w+)\s*\(", self.text_of(c))
        if match and children:
            self.function_call(c, match.group(1), match.group(2), children)

    @staticmethod
    def is_operator(k):
        names = [k] + list(k.get_children())
        return any(re.fullmatch(r"operator[-+*/<>=!]+", n.spelling or "") for n in names) and \
            not list(k.get_arguments()) and k.kind in (Kind.DECL_REF_EXPR, Kind.UNEXPOSED_EXPR)

    def function_call(self, c, scope, name, children):
        start, end = self.span(c)
        inner = re.match(r"(?:std::)?\w+\s*\((.*)\)$", self.text(start, end), flags=re.S)
        if inner is None:
            return
        inner = operators.plain(inner.group(1))
        if name in operators.EXCHANGED:
            other = operators.EXCHANGED[name]
            arm = f"std::{other}({inner})" if scope else \
                f"[&] {{ using std::{other}; return {other}({inner}); }}()"
            self.add("function", (start, end), arm, f"{scope}{other}({inner})")
        arguments = [k for k in children if k.kind not in NAMES][1:]
        if name in operators.DROPPED and len(arguments) == 1:
            self.add("function", (start, end), inner)
        if name == "atan2" and len(arguments) == 2:
            a, b = (operators.plain(self.text_of(k)) for k in arguments)
            self.add("function", (start, end), f"{scope}atan2({b}, {a})")

    def unary(self, c, parent):
        operand = next(iter(c.get_children()))
        if self.text(c.extent.start.offset, operand.extent.start.offset).strip() == "-":
            self.add("sign", self.span(c), operators.plain(self.text_of(operand)))

    def sign_of_value(self, c, k):
        kind = c.type.get_canonical().spelling.replace("const ", "")
        if re.fullmatch(r"double|[TS]|type-parameter-\d-\d|polhode::\S*Vec3<.*>", kind):
            if k.kind not in (Kind.INIT_LIST_EXPR, Kind.FLOATING_LITERAL):
                self.add("sign", self.span(k), f"-({operators.plain(self.text_of(k))})")

    def negated(self, span):
        text = operators.plain(self.text(*span))
        self.add("condition", span, f"!({text})")

    def choice(self, c, parent):
        self.negated(self.span(next(iter(c.get_children()))))

    def condition(self, c, parent):
        if re.match(r"if\s+constexpr\b", self.text_of(c)):
            return
        inside = [k for k in c.get_children()]
        for k in inside[:-1]:
            if k.kind.is_expression():
                tail = self.text(k.extent.end.offset, c.extent.end.offset)
                if tail.lstrip().startswith(")"):
                    self.negated(self.span(k))
                    return

    def field(self, c, parent):
        start, end = self.span(c)
        match = re.search(r"(\.|->)(\w+)$", self.text(start, end))
        if not match or match.group(2) not in operators.FIELDS or \
                parent is not None and parent.kind == Kind.CALL_EXPR and \
                self.text(end, end + 1) == "(":
            return
        other = operators.FIELDS[match.group(2)]
        field = c.referenced
        if field is not None and field.semantic_parent is not None:
            fields = [k.spelling for k in field.semantic_parent.get_children()]
            if other not in fields:
                return
        text = operators.plain(self.text(start, end - len(match.group(2)))) + other
        self.add("index", (start, end), text)

    def constant(self, c):
        """A named constant is computed by the compiler: what can change is its use."""
        named = c.referenced
        if named is None or named.kind != Kind.VAR_DECL or \
                named.type.get_canonical().spelling != "const double":
            return
        declared = "".join(t.spelling + " " for t in named.get_tokens())
        if not re.search(r"\bconstexpr\b", declared) or "NaN" in declared or \
                "infinity" in declared:
            return
        value = declared.split("=")[-1].strip(" ;")
        arms = operators.mutated_float(value) or [f"2.0 * {c.spelling}"]
        for arm in arms[:1]:
            self.add("literal", self.span(c), arm)

    def literal(self, c, parent):
        text = self.text_of(c)
        end = self.span(c)[1]
        indexed = self.text(end, end + 1) == "]"
        called = parent is not None and parent.kind == Kind.CALL_EXPR and not any(
            k.kind in NAMES for k in parent.get_children()) and c.kind == Kind.INTEGER_LITERAL
        cast = ""
        kind = parent.type.get_canonical().spelling if parent is not None else ""
        if parent is not None and parent.kind == Kind.UNEXPOSED_EXPR:
            cast = {"double": "double", "unsigned long": "std::size_t"}.get(kind, "")
        if c.kind == Kind.INTEGER_LITERAL:
            arms = operators.mutated_integer(text, indexed or called)
            name = "index" if indexed else "literal"
        else:
            arms, name = operators.mutated_float(text), "literal"
        for arm in arms:
            self.add(name, self.span(c), arm, cast=cast)
