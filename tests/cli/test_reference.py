# SPDX-License-Identifier: MIT
"""docs/reference is what the table of keys says, and its JSON Schema agrees with the reader."""

import importlib.util
import json

import pytest


def test_generated_pages_are_current(root, polhode):
    path = root / "tools/reference_docs.py"
    spec = importlib.util.spec_from_file_location("reference_docs", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.stale(polhode) == [], "run tools/reference_docs.py"


def test_the_command_page_lists_every_chart(root, run):
    page = (root / "docs/reference/cli.md").read_text(encoding="utf-8")
    _, charts = run("convert", "--help").stdout.split("Charts and the columns they need:\n")
    for line in charts.split("\n"):
        if line.startswith("  ") and ":" in line:
            name, columns = line.strip().split(": ", 1)
            assert f"`{name}`" in page
            assert f"`{columns.split(';')[0].split(' ')[0]}`" in page


@pytest.fixture(scope="module")
def schema(root):
    return json.loads((root / "docs/reference/scenario.schema.json").read_text(encoding="utf-8"))


def test_examples_match_the_json_schema(root, schema):
    jsonschema = pytest.importorskip("jsonschema")
    tomllib = pytest.importorskip("tomllib")
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    validator = kind(schema)
    for path in sorted((root / "examples").glob("*.toml")):
        validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))


def test_every_key_has_a_place_in_the_json_schema(schema, run):
    keys = run("schema", "keys").stdout
    tables = [line.strip("# `[]") for line in keys.splitlines() if line.startswith("## `[")]
    assert "state.tumbler.pole" in tables
    for table in tables:
        node, holder = schema, None
        for name in table.split("."):
            holder = node
            node = node["additionalProperties"] if name == "*" else node["properties"][name]
        assert node["description"] or holder
        items = node.get("items", node)
        named = isinstance(items["additionalProperties"], dict)  # [orbit.NAME]
        assert named or items["additionalProperties"] is False
