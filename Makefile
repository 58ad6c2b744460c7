# The first `make` in a fresh clone creates .venv, installs the locked versions and compiles core/kernels.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.PHONY: help setup serve test deep rounding libreoffice lint sweep-pitch sweep-kills job-kills soak fuzz bench ccd examples figures dist install-time lock clean

VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet --quiet
HOST ?= 127.0.0.1
PORT ?= 8000
# The tests start hundreds of processes: without bytecode each of them compiles all of app and core.
unexport PYTHONDONTWRITEBYTECODE
PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)

help:
	@echo 'make serve    the service on http://$(HOST):$(PORT) (HOST=, PORT=)'
	@echo 'make test     the tests (ARGS= for pytest)'
	@echo 'make deep     the tests with all cases and samples, of which make test runs some of each kind'
	@echo 'make rounding 10,000 computed gaps against 50-digit arithmetic and the bounds on rounding (ARGS="GAPS SEED")'
	@echo 'make libreoffice  grades the three workbooks as saved by LibreOffice (needs libreoffice-calc; ARGS=--renew: the small ones)'
	@echo 'make lint     ruff and mypy'
	@echo 'make sweep-pitch  the minimum pitch of 2,000 random dragons against a slow scan, 10 minutes (DRAGONS=, FIRST=)'
	@echo 'make sweep-kills  a sweep of 200,000 designs on a Dask cluster with 50 kills, half an hour (DESIGNS=, KILLS=, FIRST=)'
	@echo 'make job-kills  50 processes of the service killed at random while it works on jobs, 5 minutes (KILLS=, SEED=)'
	@echo 'make soak     each attack alone, then all in turn beside 64 clients, 8 minutes (SECONDS=, FOLDER= for its curve)'
	@echo 'make fuzz     10,000 requests from the service description and 12,000 odd ones (CASES=, MUTANTS=, SEED=)'
	@echo 'make bench    benchmarks against a plain SciPy baseline, into docs/performance.md'
	@echo 'make ccd      100,000 queries of continuous collision detection to every engine, into docs/dragon-ccd.md: some'
	@echo '              hours, continued after an interruption (QUERIES=, SEED=)'
	@echo 'make examples new answers for the examples in /docs'
	@echo 'make figures  the figures of README.md and docs/'
	@echo 'make dist     the sdist and the wheel in dist/, checked'
	@echo 'make install-time  how long pip takes to install the wheel of core and its command, downloads not counted'
	@echo 'make lock     new exact versions in requirements.lock'
	@echo 'make clean    remove everything that make created'

# Packages are installed while the kernels are compiled: both wait for the disk now and then.
setup:
	@$(MAKE) --silent --no-print-directory --jobs=2 $(VENV)/installed $(VENV)/compiled

# The locked pip first, which needs half the processor time of that of Python 3.11, and what the kernels need. Without
# bytecode: Python writes it at the first import, and most installed modules are never imported.
$(VENV)/tools: requirements.lock
	@PYTHON='$(PYTHON)' bash .ci/make-venv $(VENV)
	@echo 'Installing the locked packages into $(VENV) (one to four minutes, once)'
	@$(PIP) install --no-compile "$$(grep '^pip==' requirements.lock)"
	@grep -iE '^(cython|setuptools)==' requirements.lock | xargs $(PIP) install --no-deps --no-compile
	@touch $@

# uv takes a tenth of the time of pip; pip installs where uv does not run or fails, or where pip is configured for another
# index or a proxy, which uv does not read.
PLAIN_INDEX = ! $(BIN)/python -m pip config list | grep -oE '\.(index-url|no-index|proxy)='
UV = UV_HTTP_TIMEOUT=10 UV_HTTP_RETRIES=1 $(BIN)/uv pip install --quiet --system-certs

# What an interrupted run left is replaced, but never the tools, which compile the kernels meanwhile.
$(VENV)/installed: $(VENV)/tools
	@grep -viE '^(#|(cython|pip|setuptools|uv)==)' requirements.lock >$(VENV)/packages
	@{ $(PLAIN_INDEX) && \
		$(PIP) install --no-compile --only-binary :all: "$$(grep '^uv==' requirements.lock)" && \
		$(UV) --python $(BIN)/python --reinstall --no-deps -r $(VENV)/packages; \
	} >$(VENV)/uv.log 2>&1 || { \
		echo 'uv cannot install here ($(VENV)/uv.log): pip does, in some minutes'; \
		xargs -n 16 -P 3 $(PIP) install --no-deps --no-compile --force-reinstall <$(VENV)/packages; \
	}
	@touch $@

# The normal install, editable: it compiles core/kernels in place, or reports why it runs uncompiled.
$(VENV)/compiled: $(wildcard core/kernels/*.py core/kernels/*.pxd) setup.py pyproject.toml $(VENV)/tools
	@rm -f core/kernels.*.so core/kernels/*.so
	@$(PIP) install --no-build-isolation --no-deps -e .
	@ls core/kernels/*.so >/dev/null 2>&1 || printf '%s\n' \
		'No C compiler with the headers of Python was found. Everything works, but many times slower.' \
		'For full speed: apt install gcc python3-dev, then: make clean setup' >&2
	@touch $@

serve: setup
	@BENCH_DRAGON_DATA="$${BENCH_DRAGON_DATA:-data}" $(BIN)/bench-dragon serve --host $(HOST) --port $(PORT)

test: setup
	@$(BIN)/python tests/page/browser.py
	@$(BIN)/python -m pytest --numprocesses logical --dist worksteal $(ARGS)

deep: setup
	@DEEP=1 $(MAKE) --no-print-directory test

rounding: setup
	@$(BIN)/python -m tests.core.rounding_sweep $(or $(ARGS),10000)

libreoffice: setup
	@$(BIN)/python -m tests.app.grade.libreoffice $(ARGS)

lint: setup
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

sweep-pitch: setup
	@$(BIN)/python -m tests.core.sweep_pitch $(or $(DRAGONS),2000) $(or $(FIRST),0)

sweep-kills: setup
	@$(BIN)/python -m tests.app.sweeps.kills $(or $(DESIGNS),200000) $(or $(KILLS),50) $(or $(FIRST),0)

job-kills: setup
	@$(BIN)/python -m tests.app.jobs.kills $(or $(KILLS),50) $(or $(SEED),0)

soak: setup
	@$(BIN)/python -m tests.app.soak $(or $(SECONDS),300) $(or $(FOLDER),build)

fuzz: setup
	@$(BIN)/python -m tests.app.fuzz $(or $(CASES),10000) $(or $(MUTANTS),12000) $(or $(SEED),0)

bench: setup
	@$(BIN)/python -m benchmarks.report docs/performance.md

ccd: setup
	@$(BIN)/python -m benchmarks.ccd --queries $(or $(QUERIES),100000) --seed $(or $(SEED),2026)

examples: setup
	@$(BIN)/python -m tests.app.renew_examples

figures: setup
	@$(BIN)/bench-dragon figures docs

# The wheel is built from the sdist; both pass the checks of a package index.
dist: setup
	@rm -rf dist
	@$(BIN)/python -c 'from setuptools.build_meta import build_sdist; build_sdist("dist")' >build/sdist.log
	@$(PIP) wheel --no-build-isolation --no-deps --wheel-dir dist dist/*.tar.gz
	@$(BIN)/python -m venv --without-pip --clear build/checks
	@{ $(PLAIN_INDEX) && $(UV) --python build/checks/bin/python check-wheel-contents twine; } >build/uv.log 2>&1 || \
		$(PIP) --python build/checks/bin/python install --no-compile check-wheel-contents twine
	@build/checks/bin/twine check --strict dist/*
	@build/checks/bin/check-wheel-contents dist/*.whl

# Processor time counts: on a busy machine the clock runs on.
install-time: setup
	@rm -rf build/install
	@$(PIP) wheel --no-build-isolation --no-deps --wheel-dir build/install .
	@$(PIP) download --dest build/install build/install/*.whl
	@$(PYTHON) -m venv build/install/venv
	@TIMEFORMAT='%U s user, %S s system, %R s on the clock'; \
	time build/install/venv/bin/python -m pip --quiet install --no-index --find-links build/install bench-dragon
	@! build/install/venv/bin/python -c 'import fastapi' 2>/dev/null

# Versions are resolved in a separate, new environment; the file has names and versions only.
lock:
	@$(PYTHON) -m venv build/lock
	@build/lock/bin/python -m pip --quiet install --upgrade pip
	@build/lock/bin/python -m pip --quiet install -e '.[dev]'
	@{ sed -n '/^#/p' requirements.lock; build/lock/bin/python -m pip list --format=freeze \
		| grep -v '^bench-dragon=='; } > build/requirements.lock
	@mv build/requirements.lock requirements.lock
	@rm -rf build/lock

clean:
	@rm -rf $(VENV) build dist *.egg-info core/kernels.*.so core/kernels/*.so .pytest_cache .hypothesis .mypy_cache .ruff_cache .benchmarks
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
