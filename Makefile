# make demo: light the example. make pencil2d [PROJECT=file.pclx]: open Pencil2D with the lamp tool.
# make test: check everything. Each installs first what it needs, in the versions of requirements/.
# make lock: renew those. make test-newest: check everything with the newest versions instead.
.PHONY: demo pencil2d install uninstall test test-newest test-slow check format tidy environment lock plugin schema clean

VENV ?= .venv
BIN := $(VENV)/bin
OUT ?= out/demo
SHEET ?= out/demo.png
PROJECT ?=
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

test: check
	@scripts/environment.sh test
	cmake --preset dev && cmake --build --preset dev
	LAMPBLACK_PYTHON=$(PYTHON_OF_WORKER) ctest --preset dev
	cmake --preset asan && cmake --build --preset asan --target protocol_codec_vectors protocol_codec_fuzz protocol_planes
	ctest --preset asan -R ^protocol_
	$(BIN)/pytest -m "not slow"

test-newest:
	NEWEST=1 $(MAKE) test VENV=build/newest

test-slow: test
	$(BIN)/pytest -m slow

CPP = $$(git ls-files 'pencil2d_plugin/*.h' 'pencil2d_plugin/*.cpp' 'tests/plugin/*.h' 'tests/plugin/*.cpp')

check: environment
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/clang-format --dry-run --Werror $(CPP)

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

plugin:
	@scripts/environment.sh plugin
	@cmake --preset release >/dev/null && cmake --build --preset release

clean:
	rm -rf .venv out build .pytest_cache .mypy_cache .ruff_cache

# Generates all that follows from the Python types of the scene and the messages. The vectors come first:
# the specification shows some of them as examples.
schema: environment
	$(BIN)/python protocol/make_vectors.py
	$(BIN)/python -m lampblack.protocol.documents
