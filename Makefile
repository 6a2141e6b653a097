# make demo   the whole way once, from simulated pictures to demo/report.html
# make test   install and run the tests
# make hunt   the properties with random examples, ROUNDS times over
# make lint   style and types
# make dist   what is published: wheel and sdist in dist/, checked
# make bench  the speed of the reasoner, beside plain clingo
# make figures  the other numbers and the pictures of the README
# make tutorials  run the tutorials as they stand, and make their pictures
# make docs   the site, in site/index.html: opens with no network

PYTHON ?= python3
DOMAIN ?= structure_stability
OUT ?= demo
ROUNDS ?= 3
VENV := .venv
INSTALLED := $(VENV)/.installed

.PHONY: demo test hunt lint dist bench figures tutorials docs clean

$(INSTALLED): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(0 if sys.version_info >= (3, 11) else "SeeWhy needs Python 3.11 or newer, found " + sys.version.split()[0] + "; name one with make PYTHON=...")'
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/python -m pip install --quiet --constraint constraints.txt --editable '.[dev]'
	@touch $@

demo: $(INSTALLED)
	$(VENV)/bin/seewhy demo --domain $(DOMAIN) --out $(OUT)

# Compiled once, and not by each of the processes that tests start.
test: $(INSTALLED)
	PYTHONDONTWRITEBYTECODE= $(VENV)/bin/python -m pytest --numprocesses auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder

# What fails is tried first by the next hunt.
hunt: $(INSTALLED)
	for round in $$(seq $(ROUNDS)); do $(VENV)/bin/python -m pytest tests -m hypothesis --hypothesis-profile=random --numprocesses auto --maxprocesses 4 --dist loadfile || exit 1; done

lint: $(INSTALLED)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy
	$(VENV)/bin/lint-imports

# The laboratory's wheel lies apart: it is for checkouts, and not published.
dist: $(INSTALLED)
	rm -rf dist
	$(VENV)/bin/python -m build --no-isolation --outdir dist .
	$(VENV)/bin/python -m build --no-isolation --wheel --outdir dist/lab lab
	$(VENV)/bin/twine check --strict dist/*.whl dist/*.tar.gz dist/lab/*.whl

bench: $(INSTALLED)
	$(VENV)/bin/python -m pytest benchmarks --benchmark-enable --benchmark-only --benchmark-columns=min,median,ops,rounds --benchmark-sort=name

# The numbers and the pictures of the README.
figures: $(INSTALLED)
	$(VENV)/bin/seewhy data make structure_stability --count 2500 --seed 0 --out runs/pictures
	$(VENV)/bin/seewhy data show runs/pictures --rows 2 --columns 7 --out docs/pictures/contact_sheet.png
	$(VENV)/bin/seewhy check structure_stability --data runs/pictures
	$(VENV)/bin/python -m seewhy_lab count_structures runs/pictures
	$(VENV)/bin/seewhy train structure_stability --data runs/pictures --out runs/model
	$(VENV)/bin/seewhy evaluate runs/model --data runs/pictures
	$(VENV)/bin/seewhy data make traffic_signs --count 124 --seed 0 --size 96 --out runs/signs
	$(VENV)/bin/seewhy data show runs/signs --domain traffic_signs --rows 3 --columns 10 --out docs/pictures/signs.png
	$(VENV)/bin/seewhy ask runs/model runs/pictures/images/000056.png "what is making this structure unstable?" --picture docs/pictures/answer.svg
	$(VENV)/bin/seewhy data make tabletop --count 660 --seed 0 --out runs/tables
	$(VENV)/bin/seewhy train tabletop --data runs/tables --out runs/tables_model
	$(VENV)/bin/seewhy evaluate runs/tables_model --data runs/tables
	$(VENV)/bin/seewhy ask runs/tables_model runs/tables/images/000002.png "what would happen if the brown cube were removed?" --picture docs/pictures/table.svg

tutorials: $(INSTALLED)
	$(VENV)/bin/python docs/site/tutorials.py docs/start/your_own_*.md --folder runs/tutorials

docs: $(INSTALLED)
	$(VENV)/bin/python -m pip install --quiet --constraint constraints.txt --editable '.[docs]'
	NO_MKDOCS_2_WARNING=1 $(VENV)/bin/mkdocs build --strict

clean:
	rm -rf $(VENV) demo runs build dist site
