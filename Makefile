# `make` alone explains itself. Binaries appear in build/release/bin/.
.DEFAULT_GOAL := help
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c

PRESET ?= release
BUILD := build/$(PRESET)
JOBS ?= $(shell nproc)
# ccache, where there is one, makes a second build quick.
export CMAKE_CXX_COMPILER_LAUNCHER ?= $(shell command -v ccache)

SOURCES = $(shell git ls-files '*.cpp' '*.h')

.PHONY: help demo studio test programs build build-packages packages test-packages bench verify format lint

# What compiling does not need is installed meanwhile; several goals are reached one after the other.
MAKEFLAGS += $(if $(word 2,$(MAKECMDGOALS)),,--jobs=2)

help:  ## Show this list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-9s %s\n", $$1, $$2}'

demo: programs packages  ## Install, build, serve, and dance 24 s to a real song; results in out/demo/
	@scripts/demo.sh $(BUILD)/bin out/demo

studio: programs packages  ## Install, build, and open the studio in a browser: SONG=file begins with that song
	@scripts/photo_model.sh $(BUILD)/share/choreo/photo
	@$(BUILD)/bin/choreo studio $(if $(SONG),"$(SONG)")

test: build test-packages  ## Install, build and run every test (a few minutes)
	@# All that tests need is there now: what still can't be had is a failure.
	@CHOREO_SKIP_CODE=1 scripts/run_tests.sh $(BUILD)

programs: build-packages  ## Install what is missing and compile choreod and choreo
	@cmake --preset $(PRESET) $(if $(wildcard $(BUILD)/build.ninja),>/dev/null,)
	@cmake --build $(BUILD) -j $(JOBS) --target choreod choreo

build: programs  ## The same, and everything else but benchmarks: choreo-lab, tests (PRESET=release|develop|debug|asan|tsan)
	@cmake --build $(BUILD) -j $(JOBS)

packages: build-packages  ## Install the Debian packages that are missing
	@scripts/install_packages.sh demo video

build-packages:
	@scripts/install_packages.sh build run

test-packages: packages
	@scripts/install_packages.sh test

bench: build  ## Run the benchmarks; writes docs/performance.md
	@scripts/install_packages.sh bench
	@cmake --build $(BUILD) -j $(JOBS) --target choreo_bench
	@scripts/bench.sh $(BUILD)/bin

verify: build test-packages  ## Everything too long for `make test`: figures (CHOREO_RECORDINGS=folder), the studio in a browser, sanitizers, no gRPC, the installed package, the container (as root)
	@cmake --build $(BUILD) -j $(JOBS) --target choreo_bench
	@scripts/verify.sh $(BUILD)

format:  ## Format all sources in place
	@scripts/install_packages.sh lint
	@clang-format -i $(SOURCES)

lint: build test-packages  ## Check formatting and the API's conventions, and run clang-tidy over our sources
	@scripts/install_packages.sh lint
	@tests/proto/buf_test.sh lint
	@clang-format --dry-run -Werror $(SOURCES)
	@git ls-files '*.cpp' | xargs -P $(JOBS) -n 4 clang-tidy --quiet -p $(BUILD)
