# make demo: light the example animation. make test: check everything. Both install first.
.PHONY: demo test test-slow check format install clean schema

BIN := .venv/bin
OUT ?= out/demo
SHEET ?= out/demo.png

demo: install
	$(BIN)/lampblack render examples/animation -o $(OUT) --scene examples/animation.scene.json \
	    --quality medium --contact-sheet $(SHEET)
	@echo "Lit frames:    $(abspath $(OUT))"
	@echo "Contact sheet: $(abspath $(SHEET))"

test: check
	$(BIN)/pytest -m "not slow"

test-slow: install
	$(BIN)/pytest -m slow

check: install
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: install
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

install:
	@scripts/install.sh

clean:
	rm -rf .venv out build .pytest_cache .mypy_cache .ruff_cache

schema: install
	$(BIN)/python -c "import json; from lampblack.scene import scene_schema; \
	    print(json.dumps(scene_schema(), indent=2))" > protocol/scene.schema.json
	$(BIN)/python -m lampblack.protocol.documents protocol
