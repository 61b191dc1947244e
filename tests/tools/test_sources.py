# SPDX-License-Identifier: MIT
"""Rules of tools/sources.py: against tests that a NaN passes, and for the names of tests."""

import sys

import pytest

sys.dont_write_bytecode = True

BLIND_CPP = [
    "worst = std::max(worst, x);",
    "worst = std::max({worst, x, y});",
    "worst = std::fmax(worst, x);",
    "worst = fmax(worst, x);",
    "least = std::min<double>(least, x);",
    "EXPECT_LE(*std::max_element(e.begin(), e.end()), bound);",
    "EXPECT_LE(*std::ranges::max_element(e), bound);",
    "EXPECT_LE(std::ranges::max(e), bound);",
    "if (x > worst) worst = x;",
    "if (norm(a - b) > worst) {\n  worst = norm(a - b);\n}",
    "if (worst < e[i]) worst = e[i];",
    "if (!(x <= worst)) worst = x;",
    "worst = x > worst ? x : worst;",
    "worst = worst < x ? x : worst;",
    "EXPECT_FALSE(error > bound) << name;",
    "ASSERT_TRUE(!(error > bound));",
    "if (!std::isfinite(wanted)) continue;",
    "if (got == wanted || !std::isfinite(f(wanted))) {\n  continue;\n}",
]
SEEING_CPP = [
    "worst.add(x);  // not std::max(worst, x)",
    "worst = larger(worst, x);",
    "n = std::max<int>(n, 3); k = std::min<std::size_t>({i, j, k});",
    "EXPECT_LE(error, bound);",
    "EXPECT_FALSE(is_finite(state.at(3)->g)) << \"a > b\";",
    "if (x > 3.0) y = -1.0;",
    "if (std::isinf(wanted)) continue;",
    "if (!std::isfinite(top)) return {a, 0.0, 0.0};",
    "EXPECT_TRUE(std::numeric_limits<double>::max() > 0.0);",
]
BLIND_PYTHON = [
    "worst = max(worst, x)",
    "assert max(abs(x) for x in errors) < bound",
    "assert np.nanmax(error) < bound",
    "worst = np.fmax(worst, error)",
    "assert not error > bound",
    "assert not np.any(error > bound)",
    "if x > worst:\n    worst = x",
    "worst = x if x > worst else worst",
    "assert_allclose(a, b, atol=bound, equal_nan=True)",
]
SEEING_PYTHON = [
    "assert np.abs(error).max() < bound",
    "worst = largest(worst, x)",
    "assert max(map(len, lines)) <= 254",
    "assert np.nanmax(error) < bound  # NaN: the gaps, counted above",
    "assert not run.outcome.ok and run.t[-1] <= 10",
]


@pytest.fixture(scope="module")
def errors_of(root):
    sys.path.insert(0, str(root / "tools"))
    import sources

    yield lambda name, text: list(sources.blind_errors_of(name, text))
    sys.path.remove(str(root / "tools"))


@pytest.mark.parametrize("folder", ["tests/unit/math", "benchmarks", "tests/oracle"])
@pytest.mark.parametrize("line", BLIND_CPP)
def test_what_drops_nan_is_refused(errors_of, folder, line):
    (error,) = errors_of(f"{folder}/x.cpp", f"// one\n{line}\n")
    assert error.startswith(f"{folder}/x.cpp:2: ")


@pytest.mark.parametrize("folder", ["tests/cli", "python/tests", "benchmarks"])
@pytest.mark.parametrize("line", BLIND_PYTHON)
def test_what_drops_nan_in_python_is_refused(errors_of, folder, line):
    (error,) = errors_of(f"{folder}/test_x.py", f"# one\n{line}\n")
    assert error.startswith(f"{folder}/test_x.py:2: ")


@pytest.mark.parametrize(("suffix", "line"), [
    *((".cpp", line) for line in SEEING_CPP), *((".py", line) for line in SEEING_PYTHON)])
def test_what_keeps_nan_is_let_be(errors_of, suffix, line):
    assert errors_of(f"tests/unit/x{suffix}", f"{line}\n") == []


def test_the_library_is_not_asked(errors_of):
    assert errors_of("src/math/x.cpp", "worst = std::max(worst, x);\n") == []


def test_max_and_min_that_keep_nan():
    from closeness import largest, smallest

    nan = float("nan")
    for values in ([nan, 1.0], [1.0, nan], [1.0, nan, 2.0]):
        assert largest(*values) != largest(values) and smallest(*values) != smallest(values)
    assert largest([1.0, 3.0, 2.0]) == largest(1.0, 3.0) == 3.0
    assert smallest([2.0, -3.0]) == smallest(2.0, -3.0) == -3.0
    with pytest.raises(ValueError):
        largest([])


@pytest.mark.parametrize(("name", "complaint"), [
    ("tests/unit/math/dual.cpp", []),
    ("tests/unit/math/dual_test.cpp",
     ["tests/unit/math/dual_test.cpp: a test is named after what it tests: dual.cpp"]),
])
def test_the_name_of_a_test_has_no_suffix(root, monkeypatch, name, complaint):
    monkeypatch.syspath_prepend(str(root / "tools"))
    import sources

    text = "// SPDX-License-Identifier: MIT\n"
    assert list(sources.errors_of(name, text)) == complaint
