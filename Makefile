# make demo: light the example. make pencil2d [PROJECT=file.pclx]: open Pencil2D with the lamp tool.
# make test: check everything. Each installs first what it needs, in the versions of requirements/.
# make docs: build the site of the documentation. make lock: renew the versions of requirements/.
# make test-newest: check everything with the newest versions instead.
.PHONY: dist dist-trixie demo pencil2d install uninstall environment lock plugin schema format tidy clean \
    check check-python check-types check-cpp check-docs docs pictures build-dev build-asan \
    test test-environment test-cpp test-asan test-python test-newest test-slow test-chaos \
    test-window test-trixie test-sid

VENV ?= .venv
BIN := $(VENV)/bin
OUT ?= out/demo
SHEET ?= out/demo.png
PROJECT ?=
WINDOW_TESTS ?= tests/window
PYTHON_OF_WORKER := $(abspath $(BIN)/python)
export VENV

ifneq ($(DISPLAY)$(WAYLAND_DISPLAY),)
# A copy, so that trying things out leaves the example as it is.
demo: plugin
	@mkdir -p out
	@cp -n examples/lamplighter.pclx examples/lamplighter.pclx.lampblack.json out/
	scripts/launch.sh $(abspath build/release/plugins) $(PYTHON_OF_WORKER) out/lamplighter.pclx
else
demo: environment
	$(BIN)/lampblack render examples/animation -o $(OUT) --scene examples/animation.scene.json \
	    --quality medium --contact-sheet $(SHEET)
	@echo "Lit frames:    $(abspath $(OUT))"
	@echo "Contact sheet: $(abspath $(SHEET))"
endif

pencil2d: plugin
	scripts/launch.sh $(abspath build/release/plugins) $(PYTHON_OF_WORKER) $(PROJECT)

install: plugin
	scripts/desktop.sh install build/release $(PYTHON_OF_WORKER)

uninstall:
	scripts/desktop.sh uninstall

# The checks and the builds go side by side. The tests, some of which watch the clock, go one kind after
# the other, and each kind shares the machine out by itself.
test: test-environment
	@$(MAKE) --no-print-directory -j2 check-python check-types check-cpp check-docs build-dev build-asan
	@$(MAKE) --no-print-directory test-cpp
	@$(MAKE) --no-print-directory test-asan
	@$(MAKE) --no-print-directory test-python

test-environment:
	@scripts/environment.sh test

build-dev build-asan: build-%: test-environment
	cmake --preset $* >/dev/null && cmake --build --preset $*

test-cpp: build-dev
	LAMPBLACK_PYTHON=$(PYTHON_OF_WORKER) ctest --preset dev

test-asan: build-asan
	ctest --preset asan

test-python: build-dev
	$(BIN)/pytest -m "not slow" -n 2 --dist loadgroup --no-loadscope-reorder --durations=30

test-newest:
	NEWEST=1 $(MAKE) test VENV=build/newest

# The plugin in the Pencil2D of this Debian; in that of Debian 13, and of Debian unstable (as root), where
# numpy's types are stricter, too.
# WINDOW_TESTS=tests/window/test_pencil2d_layer.py for some.
test-window: test-environment
	cmake --preset dev >/dev/null && cmake --build --preset dev --target $(IN_PENCIL2D)
	ctest --preset dev -R '^host_'
	$(BIN)/pytest -n 2 --dist loadgroup --no-loadscope-reorder $(WINDOW_TESTS)

test-trixie test-sid: test-%:
	scripts/debian_root.sh $* make test-window check-types

test-slow: test
	$(BIN)/pytest -m slow

test-chaos: build-dev
	LAMPBLACK_CHAOS_MINUTES=60 $(BIN)/pytest -m slow -o junit_family=xunit1 --junitxml=build/chaos.xml tests/render/test_chaos.py

IN_PENCIL2D = lampblack lampblack-window lampblackprobe host_gates host_window_changes host_view_and_camera host_unseen_dialogs host_in_pencil2d

CPP = $$(git ls-files 'pencil2d_plugin/*.h' 'pencil2d_plugin/*.cpp' 'tests/plugin/*.h' 'tests/plugin/*.cpp')

check: environment
	@$(MAKE) --no-print-directory -j2 check-python check-types check-cpp check-docs

check-python:
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

check-types:
	$(BIN)/mypy

check-cpp:
	$(BIN)/clang-format --dry-run --Werror $(CPP)

# Spelling, links, and words for every picture.
check-docs:
	$(BIN)/codespell $$(git ls-files)
	$(BIN)/pytest -q tests/unit/test_docs.py

format: environment
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(CPP)

tidy:
	cmake --preset dev
	clang-tidy --quiet -p build/dev $$(git ls-files 'pencil2d_plugin/*.cpp')

lock:
	scripts/lock.sh

environment:
	@scripts/environment.sh

# The last commit, as wheel, sdist and .deb, in dist/. dist-trixie: for Debian 13 (as root, in a clone).
dist:
	@scripts/environment.sh dist
	scripts/dist.sh

dist-trixie:
	scripts/debian_root.sh trixie make dist

plugin:
	@scripts/environment.sh plugin
	@cmake --preset release >/dev/null && cmake --build --preset release

# The site of the documentation, in build/site/. A dead link is an error.
docs:
	scripts/site.sh

# The pictures of the documentation; PICTURES="depth.jpg ..." for some. scripts/pictures says how each is made.
pictures: test-environment
	$(BIN)/python scripts/pictures $(PICTURES)

clean:
	rm -rf .venv out build .pytest_cache .mypy_cache .ruff_cache

# Generates all that follows from the Python types of the scene and the messages. The vectors come first:
# the specification shows some of them as examples.
schema: environment
	$(BIN)/python protocol/make_vectors.py
	$(BIN)/python -m lampblack.protocol.documents
	$(BIN)/python scripts/reference.py
	$(BIN)/python tests/architecture.py docs/images/architecture.svg
