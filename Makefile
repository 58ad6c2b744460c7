# The first `make` in a fresh clone creates .venv, installs the locked versions and compiles core/kernels: `make serve`
# what the service needs, `make test` also what the tests need.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.PHONY: help setup test-setup serve test test-all machines hunt deep rounding libreoffice lint words sweep-pitch sweep-kills job-kills soak fuzz mutants record bench ccd docs examples figures dist wheels install-time lock versions clean

VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet --quiet
INSTALL := bash .ci/install
# Some tests wait for a process or a browser, so one more than there are cores.
PROCESSES ?= $(shell expr $$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN) + 1)
HOST ?= 127.0.0.1
PORT ?= 8000
# The tests start hundreds of processes: without bytecode each of them compiles all of app and core.
unexport PYTHONDONTWRITEBYTECODE
# Variables that lead Python to another program's modules, or pip to another place than .venv.
unexport PYTHONHOME PYTHONPATH PIP_PREFIX PIP_ROOT PIP_TARGET
export PIP_USER := 0
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)

help:
	@echo 'make serve    the service on http://$(HOST):$(PORT) (HOST=, PORT=)'
	@echo 'make test     the tests, some minutes (ARGS= for pytest, SHUFFLE=random for a random order)'
	@echo 'make test-all  the same with kills, bombs, packages and further cases'
	@echo 'make machines  make serve and make test on other Debians, ten minutes each (as root; SUITES=, PACKAGES=, OWNER=)'
	@echo 'make hunt     random campaigns against slow oracles, 20 minutes (SECONDS=, SEED=; the seed is printed)'
	@echo 'make deep     make test-all with all cases and samples, of which it runs some of each kind'
	@echo 'make rounding 10,000 computed gaps against 50-digit arithmetic and the bounds on rounding (ARGS="GAPS SEED")'
	@echo 'make libreoffice  grades the three workbooks as saved by LibreOffice (needs libreoffice-calc; ARGS=--renew: the small ones)'
	@echo 'make lint     ruff and mypy, and for the page oxlint and TypeScript'
	@echo 'make sweep-pitch  the minimum pitch of 2,000 random dragons against a slow scan, 10 minutes (DRAGONS=, FIRST=)'
	@echo 'make sweep-kills  a sweep of 200,000 designs on a Dask cluster with 50 kills, half an hour (DESIGNS=, KILLS=, FIRST=)'
	@echo 'make job-kills  50 processes of the service killed at random while it works on jobs, 5 minutes (KILLS=, SEED=)'
	@echo 'make soak     each attack alone, then all in turn beside 64 clients, 8 minutes (SECONDS=, FOLDER= for its curve)'
	@echo 'make fuzz     10,000 requests from the service description, 12,000 odd ones, 5,000 files (CASES=, MUTANTS=, SEED=, FILES=)'
	@echo 'make mutants  80 random faults put into the program, one at a time: how many do the tests notice? Some hours, continued'
	@echo '              after an interruption'
	@echo 'make record   960 answers of calls, commands and files into FOLDER=, compared with those of BEFORE= (2 minutes)'
	@echo 'make words    the sentences of the code into the catalogues of core/words, where make lint misses translations'
	@echo 'make bench    benchmarks against a plain SciPy baseline, into docs/performance.md'
	@echo 'make ccd      100,000 queries of continuous collision detection to every engine, into docs/dragon-ccd.md: some'
	@echo '              hours, continued after an interruption (QUERIES=, SEED=)'
	@echo 'make examples new answers for the examples in /docs'
	@echo 'make docs     the documentation as a site, which the service shows at /guide/'
	@echo 'make figures  the figures of README.md and docs/'
	@echo 'make dist     the sdist and the wheel in dist/, checked'
	@echo 'make wheels   wheels for all Pythons that are here, tried in empty environments (PYTHONS=)'
	@echo 'make install-time  how long pip takes to install the wheel of core and its command, downloads not counted'
	@echo 'make lock     new exact versions in requirements*.lock, and the digests of their files'
	@echo 'make versions  make test with the lowest versions that pyproject.toml allows, then with the newest (ARGS=)'
	@echo 'make clean    remove everything that make created'

# Packages are installed while the kernels are compiled: both wait for the disk now and then.
setup:
	@$(MAKE) --silent --no-print-directory --jobs=2 $(VENV)/service $(VENV)/compiled

test-setup:
	@$(MAKE) --silent --no-print-directory --jobs=2 $(VENV)/tests $(VENV)/engines $(VENV)/node $(VENV)/compiled

# uv first, which installs the others, and what compiles the kernels. Without bytecode: Python writes it at the first
# import, and most installed modules are never imported.
$(VENV)/tools: requirements.lock
	@PYTHON='$(PYTHON)' bash .ci/make-venv $(VENV)
	@echo 'Installing the locked packages into $(VENV) (half a minute to four minutes, once)'
	@$(INSTALL) --only uv $(VENV) requirements.lock || echo 'uv cannot be had here: pip installs, in some minutes' >&2
	@$(INSTALL) --only 'babel|cython|setuptools' $(VENV) requirements.lock
	@touch $@

# Never the tools, which compile the kernels meanwhile.
$(VENV)/service: $(VENV)/tools
	@$(INSTALL) --but 'babel|cython|setuptools|uv' $(VENV) requirements.lock
	@touch $@

$(VENV)/tests: $(VENV)/service requirements-test.lock
	@$(INSTALL) $(VENV) requirements-test.lock
	@touch $@

# Not every machine and Python has them; the tests of the others run without them.
$(VENV)/engines: $(VENV)/tests requirements-ccd.lock
	@$(INSTALL) --each $(VENV) requirements-ccd.lock
	@touch $@

# Node.js for the tests of the page's modules and for the type check; it comes as a wheel.
$(VENV)/node: $(VENV)/engines .ci/typescript/node.lock
	@$(INSTALL) --each $(VENV) .ci/typescript/node.lock
	@touch $@

# The normal install, editable: it compiles core/kernels in place, or reports why it runs uncompiled.
$(VENV)/compiled: $(wildcard core/kernels/*.py core/kernels/*.pxd core/words/*.po) setup.py pyproject.toml $(VENV)/tools
	@rm -f core/kernels.*.so core/kernels/*.so
	@$(PIP) install --no-build-isolation --no-deps -e .
	@ls core/kernels/*.so >/dev/null 2>&1 || printf '%s\n' \
		'No C compiler with the headers of Python was found. Everything works, but many times slower.' \
		'For full speed: apt install gcc python3-dev, then: make clean setup' >&2
	@touch $@

serve: setup
	@BENCH_DRAGON_DATA="$${BENCH_DRAGON_DATA:-data}" $(BIN)/bench-dragon serve --host $(HOST) --port $(PORT)

test-all: ALL := --all
test test-all: test-setup
	@$(BIN)/python tests/support/browser.py
	@$(BIN)/python -m pytest --numprocesses $(PROCESSES) --dist worksteal $(ALL) $(ARGS)

# Not with the settings of this make, which are for this machine.
machines:
	@env -u MAKEFLAGS -u MAKELEVEL bash .ci/machines $(SUITES)

hunt: test-setup
	@$(BIN)/python -m tests.campaigns.hunt $(or $(SECONDS),1200) $(SEED)

deep: setup
	@DEEP=1 $(MAKE) --no-print-directory test-all

rounding: test-setup
	@$(BIN)/python -m tests.campaigns.rounding_sweep $(or $(ARGS),10000)

libreoffice: test-setup
	@$(BIN)/python -m tests.campaigns.libreoffice $(ARGS)

# TypeScript for the types of the page's scripts. Node.js takes the certificates of the system, as uv does.
$(VENV)/types: .ci/typescript/package-lock.json $(VENV)/node
	@mkdir -p $(VENV)/typescript
	@cp .ci/typescript/*.json $(VENV)/typescript
	@cd $(VENV)/typescript && NODE_OPTIONS=--use-system-ca PATH="$(CURDIR)/$(BIN):$$PATH" npm ci --silent --no-audit --no-fund
	@touch $@

lint: test-setup $(VENV)/types
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/python .ci/words
	@$(BIN)/oxlint --quiet app/page
	@$(BIN)/node $(VENV)/typescript/node_modules/typescript/bin/tsc --project jsconfig.json

words: test-setup
	@$(BIN)/python .ci/words --write

sweep-pitch: test-setup
	@$(BIN)/python -m tests.campaigns.sweep_pitch $(or $(DRAGONS),2000) $(or $(FIRST),0)

sweep-kills: test-setup
	@$(BIN)/python -m tests.campaigns.sweep_kills $(or $(DESIGNS),200000) $(or $(KILLS),50) $(or $(FIRST),0)

job-kills: test-setup
	@$(BIN)/python -m tests.campaigns.job_kills $(or $(KILLS),50) $(or $(SEED),0)

soak: test-setup
	@$(BIN)/python -m tests.campaigns.soak $(or $(SECONDS),300) $(or $(FOLDER),build)

fuzz: test-setup
	@$(BIN)/python -m tests.campaigns.fuzz $(or $(CASES),10000) $(or $(MUTANTS),12000) $(or $(SEED),0) $(or $(FILES),5000)

record: test-setup
	@$(BIN)/python -m tests.campaigns.recording $(or $(FOLDER),build/recording)
	@$(if $(BEFORE),diff --recursive $(BEFORE) $(or $(FOLDER),build/recording))

mutants: test-setup $(VENV)/mutants
	@$(BIN)/python -m tests.campaigns.mutants try

# Without yattag, which has no wheel: only cosmic-ray's own reports need it.
$(VENV)/mutants: $(VENV)/tests requirements-mutants.lock
	@$(INSTALL) --but yattag $(VENV) requirements-mutants.lock
	@touch $@

bench: test-setup
	@$(BIN)/python -m benchmarks.report docs/performance.md

ccd: test-setup
	@$(BIN)/python -m benchmarks.ccd --queries $(or $(QUERIES),100000) --seed $(or $(SEED),2026)

examples: test-setup
	@$(BIN)/python -m tests.support.renew_examples

# A warning of Sphinx, a dead link and a file from another host are errors.
docs: test-setup $(VENV)/docs
	@$(BIN)/python docs/site/build.py app/guide
	@$(BIN)/python docs/site/links.py app/guide

$(VENV)/docs: $(VENV)/tests requirements-docs.lock
	@$(INSTALL) $(VENV) requirements-docs.lock
	@touch $@

figures: test-setup
	@$(BIN)/bench-dragon figures docs
	@$(BIN)/python docs/site/gallery.py

# The wheel is built from the sdist, and holds the guide; both pass the checks of a package index. A wheel is for one platform if, and only
# if, it holds compiled loops; on Linux it then needs no library beside those of manylinux.
dist: docs
	@rm -rf dist && mkdir -p build
	@$(BIN)/python -c 'from setuptools.build_meta import build_sdist; build_sdist("dist")' >build/sdist.log
	@$(PIP) wheel --no-build-isolation --no-deps --wheel-dir dist dist/*.tar.gz
	@$(BIN)/python -m venv --clear build/checks
	@$(INSTALL) build/checks requirements-dist.lock
	@build/checks/bin/twine check --strict dist/*
	@build/checks/bin/check-wheel-contents dist/*.whl
	@build/checks/bin/python -m tests.support.wheels dist/*.whl

wheels: dist
	@bash .ci/wheels $(PYTHONS)

# Processor time counts: on a busy machine the clock runs on.
install-time: setup
	@rm -rf build/install
	@$(PIP) wheel --no-build-isolation --no-deps --wheel-dir build/install .
	@$(PIP) download --dest build/install build/install/*.whl
	@$(PYTHON) -m venv build/install/venv
	@TIMEFORMAT='%U s user, %S s system, %R s on the clock'; \
	time build/install/venv/bin/python -m pip --quiet install --no-index --find-links build/install bench-dragon
	@! build/install/venv/bin/python -c 'import fastapi' 2>/dev/null

# The newest versions that fit the ranges of pyproject.toml, the tests' among them, on every Python and system; the files
# have names and versions only.
# Lines of packages that [tool.uv] overrides leave nowhere needed are dropped.
RESOLVE = $(BIN)/uv pip compile --universal --python-version 3.11 --upgrade --resolution $(or $(RESOLUTION),highest) \
	--no-header --no-annotate --quiet
lock: setup
	@mkdir -p build
	@$(RESOLVE) pyproject.toml --extra dev --group tools --output-file build/all.lock
	@$(RESOLVE) pyproject.toml --extra service --group tools --constraint build/all.lock --output-file build/requirements.lock
	@$(RESOLVE) pyproject.toml --extra ccd --constraint build/all.lock --output-file build/ccd.lock
	@$(RESOLVE) --group docs --constraint build/all.lock --output-file build/docs.lock
	@$(RESOLVE) --group dist --output-file build/requirements-dist.lock
	@$(RESOLVE) --group mutants --constraint build/all.lock --output-file build/mutants.lock
	@sed -i "/ == 'none'$$/d" build/*.lock
	@grep -vxFf build/requirements.lock build/all.lock >build/requirements-test.lock
	@grep -vxFf build/all.lock build/docs.lock >build/requirements-docs.lock
	@grep -vxFf build/all.lock build/mutants.lock >build/requirements-mutants.lock
	@grep -vxFf build/requirements.lock build/ccd.lock | grep -vxFf build/all.lock >build/requirements-ccd.lock
	@for file in requirements*.lock; do \
		{ sed -n '/^#/p' $$file; cat build/$$file; } >build/commented && mv build/commented $$file; done
	@$(BIN)/uv pip compile --universal --python-version 3.11 --no-deps --generate-hashes \
		--no-header --no-annotate --quiet requirements.lock --output-file requirements.hashes

# In a clone, whose locks are made anew. Tools of the tests hold typer back: the newest of all is tried by make wheels.
# The oldest versions have wheels for the oldest Python alone.
WHEELS_OF_ALL := tests/test_lock.py::test_there_is_a_wheel_of_every_locked_version
versions: setup
	@for resolution in lowest-direct highest; do \
		rm -rf build/versions && git clone --quiet . build/versions && \
		$(MAKE) --no-print-directory -C build/versions lock RESOLUTION=$$resolution && \
		$(MAKE) --no-print-directory -C build/versions test ARGS=--deselect=$(WHEELS_OF_ALL) || exit 1; done

clean:
	@rm -rf $(VENV) app/guide build dist *.egg-info core/kernels.*.so core/kernels/*.so core/kernels/{constants,records}.pxd core/words/*.mo .pytest_cache .hypothesis .mypy_cache .ruff_cache .benchmarks
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
