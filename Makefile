# SPDX-License-Identifier: MIT
# The daily commands, thin over the CMake presets. `make` alone lists them.

.DEFAULT_GOAL := help
.SUFFIXES:
POLHODE := build/release/polhode
PYTHON  := .venv/bin/python
# The package as it lies in the build tree, for our tests and pages; users take pip install.
PACKAGE := PYTHONPATH=build/release/python
CORES   := $(shell nproc 2>/dev/null || echo 2)
# A file of tests stays in one process: what its fixtures build is built once.
PYTEST  := $(PYTHON) -m pytest -n $(CORES) --dist loadfile
# Seconds of fuzzing for each target.
FUZZ := 600
# What `make bits` compares the tree with.
REV         := HEAD

# Interpreters that `make wheel` builds for, in place of that of .venv: "python3.11 python3.12".
WHEEL_PYTHONS :=

# Mutation testing: what is drawn. PAGE=docs/accuracy/tests.md writes the figures into that page.
# The peers' bodies are drawn by SEED as well.
SEED    := 1
MUTANTS := 400
# Benchmarks beside peers: repetitions of each measurement, variants of W1 (32: more than an hour).
REPETITIONS := 5
VARIANTS    := 8

.PHONY: help deps deps-clang build demo test test-full test-clang test-asan test-tsan test-neon test-sweeps check bits tidy format docs docs-tables figures bench bench-peers fuzz mutate wheel web clean

help: ## Print this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

deps: ## Install what is missing for build and test (Debian 12 or 13); does nothing when all is there
	@tools/install-deps

deps-clang: ## Install clang and clang-tidy, any version from 16 on: check, tidy, fuzz, test-clang
	@tools/install-deps --clang

build/%/build.ninja: CMakePresets.json | deps
	cmake --preset $*

build/clang/build.ninja build/fuzz/build.ninja: | deps-clang

build: build/release/build.ninja ## Build the libraries, build/release/polhode and the Python package
	cmake --build build/release --target polhode polhode_python polhode_stub

demo: build/release/build.ninja ## Apophis from ten lines of TOML: its exact rotation in CSV and HDF5, a table, a picture
	@echo "Building the program and the Python package; 5 to 15 minutes on two cores the first time"
	cmake --build build/release --target polhode polhode_python
	@mkdir -p build/demo
	$(POLHODE) run examples/apophis.toml --out build/demo/apophis.csv --out build/demo/apophis.h5
	$(PACKAGE) $(PYTHON) examples/apophis.py build/demo/apophis.png

test: build ## Every test on seeded samples (minutes)
	cmake --build build/release
	ctest --preset release -j $(CORES)
	$(PACKAGE) $(PYTEST) tests
	$(PACKAGE) $(PYTEST) python/tests

test-full: test-clang test-asan test-tsan test-neon fuzz test-sweeps web ## All that there is, part by part (hours)

test-clang: build/clang/build.ninja ## Part of test-full: the C++ tests as clang compiles them
	cmake --build --preset clang --target all benchmarks
	ctest --preset clang -j $(CORES)

test-asan: build/asan/build.ninja ## Part of test-full: C++ and Python tests under ASan and UBSan
	cmake --build --preset asan
	ctest --preset asan -j $(CORES)
	tools/sanitized asan $(PYTEST) python/tests

test-tsan: build/tsan/build.ninja ## Part of test-full: what starts threads, under ThreadSanitizer
	cmake --build --preset tsan
	ctest --preset tsan -j $(CORES)
	tools/sanitized tsan $(PYTEST) tests/cli/test_map.py tests/cli/test_ensemble.py
	tools/sanitized tsan $(PYTEST) python/tests -k "(thread or map or ctrl_c) and not mpi"  # Open MPI has races of its own

test-neon: ## Part of test-full: what computes in lanes, for AArch64 (NEON), run by qemu
	tools/install-deps --neon
	cmake --preset neon
	cmake --build --preset neon
	ctest --preset neon -j $(CORES)

test-sweeps: build ## Part of test-full: the big sweeps
	cmake --build build/release
	POLHODE_TEST_FULL=1 ctest --preset release -j $(CORES)
	$(PACKAGE) POLHODE_TEST_FULL=1 $(PYTEST) tests
	$(PYTHON) -m pip install --quiet --disable-pip-version-check 'distributed>=2024.1'  # Dask's
	$(PACKAGE) POLHODE_TEST_FULL=1 $(PYTEST) python/tests --cov=polhode --cov-report=term --cov-fail-under=95

check: build/release/build.ninja deps-clang ## What to run before every commit: style, layers, headers, lint, unit tests
	tools/check

bits: build/release/build.ninja ## Outputs of revision REV and of the tree, bit by bit: make bits REV=HEAD~3
	tools/bits $(REV)

tidy: build/release/build.ninja deps-clang ## clang-tidy on every source (slow; `make check` reads the changed ones)
	tools/tidy.py --all

format: deps ## Format every C++ file
	git ls-files -co --exclude-standard '*.cpp' '*.hpp' | xargs .venv/bin/clang-format -i

docs: build ## Build the documentation as a site: build/site/index.html (no network)
	$(PYTHON) docs/theory/proofs/run.py --check
	$(PYTHON) -m sphinx -W --keep-going -q -j auto -b html -d build/doctrees docs build/site

docs-tables: build ## Regenerate what is generated in docs/ (keys, schema, paper map, proofs)
	tools/reference_docs.py
	$(PYTHON) docs/theory/proofs/run.py --table docs/theory/proofs.md
	tools/paper_map.py

figures: build ## Redraw every figure of docs/ and the gallery's page
	$(PYTHON) tools/figures/gallery.py

bench: build ## Run the benchmarks: time and error, next to Boost and GSL; build/bench/own/*.json
	cmake --build build/release --target benchmarks
	@mkdir -p build/bench/own
	@for b in build/release/benchmarks/bench_*; do echo "$$b"; \
	  $$b --benchmark_out="build/bench/own/$${b##*/}.json" --benchmark_out_format=json || exit 1; done

bench-peers: build ## polhode beside its peers, time and error: build/bench/peers.json; SEED=1 draws the bodies
	tools/install-deps --peers
	benchmarks/peers/environment
	cmake --preset release
	cmake --build build/release --target peers
	$(PACKAGE) build/bench/venv/bin/python benchmarks/peers/run.py --seed "$(SEED)" \
	  --repetitions $(REPETITIONS) --variants $(VARIANTS)

fuzz: build/fuzz/build.ninja ## Fuzz the readers for FUZZ seconds each (default 600), under ASan and UBSan
	cmake --build build/fuzz
	tools/fuzz $(FUZZ)

mutate: build/release/build.ninja ## MUTANTS small changes of the formulas, drawn by SEED: which do the tests catch? (an hour)
	$(PYTHON) tools/mutate --seed "$(SEED)" --mutants $(MUTANTS) --jobs $(CORES) $(if $(PAGE),--page $(PAGE))

wheel: build ## Build a wheel that needs nothing of a machine, try it in a bare root; an sdist: build/dist
	$(PYTHON) tools/wheel $(addprefix --python ,$(WHEEL_PYTHONS))
	@ls -l build/dist

# Where the site has the explorer; `make docs` links it when it is there.
EXPLORER := build/site/explorer
# The C library's functions without FMA, as those of WebAssembly are.
NO_FMA := GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2

web: build/release/build.ninja ## The explorer and its npm package: WebAssembly, tests in Node and a browser, page
	tools/install-deps --web
	cd web && npm ci --loglevel=error --ignore-scripts --no-audit --no-fund
	$(MAKE) -C web/core -j $(CORES)
	cd web && npm run --silent build
	cmake --build build/release --target web_answers web_answers_musl
	@mkdir -p build/web
	$(NO_FMA) build/release/web/web_answers > build/web/answers.json
	build/release/web/web_answers_musl > build/web/answers_musl.json
	cd web && npm test --silent
	cd web && npm run --silent page -- ../$(EXPLORER)
	cd web && CHROMIUM="$${CHROMIUM:-$$(command -v chromium || command -v chromium-browser)}" \
	  npm run --silent page-test
	cd web && npm pack --silent --pack-destination ../build/web

clean: ## Remove build/ and web/dist/ (keeps .venv and web/node_modules)
	rm -rf build web/dist
