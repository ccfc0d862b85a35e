# SPDX-License-Identifier: GPL-3.0-or-later
# The short way to build, run and test; CMake and its presets do the work.

PRESET ?= release
# More for CMake's configure step, as in: make build CMAKE_FLAGS=-DCLERESTORY_WERROR=ON
CMAKE_FLAGS ?=
BUILD := build/$(PRESET)

.NOTPARALLEL:
.PHONY: demo test build tests configure setup format tidy clean

demo: setup build
	$(BUILD)/clerestory daylight samples/office/office.toml -o build/demo
	@test -s build/demo/workplane.png
	@echo "The map of the daylight factor is $(CURDIR)/build/demo/workplane.png"

test: setup tests
	ctest --preset $(PRESET)

build tests: $(if $(CMAKE_FLAGS),configure,$(BUILD)/build.ninja)

# The program alone.
build:
	cmake --build --preset $(PRESET) --parallel $(shell nproc) --target clerestory

# The program and all that tests it.
tests:
	cmake --build --preset $(PRESET) --parallel $(shell nproc)

configure: setup
	cmake --preset $(PRESET) $(CMAKE_FLAGS)

$(BUILD)/build.ninja: | setup
	cmake --preset $(PRESET) $(CMAKE_FLAGS)

# Installs the Debian packages that are missing.
setup:
	@scripts/setup.sh

format:
	scripts/format.sh

tidy: $(BUILD)/build.ninja
	scripts/tidy.py $(BUILD)

clean:
	rm -rf build
