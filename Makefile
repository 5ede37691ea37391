# The front door. Each target installs and fetches what it needs first; what is there already is
# neither installed nor fetched again.
.NOTPARALLEL:
.DEFAULT_GOAL := help
.PHONY: help demo test check check-scale build bench asan fuzz tsan test-headset test-windows tidy format format-check python web web-test web-page-test web-serve install install-all clean setup setup-web setup-windows

PREFIX ?= /usr/local
SECONDS ?= 60
sources = $(shell find apps assets bench examples include src tests tools -name '*.h' -o -name '*.c' -o -name '*.cpp')

help: ## List these targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

demo: setup ## Strokes on three objects, corrected and measured: a table under build/demo
	@scripts/build release nade_cli nade_share
	@scripts/demo

test: setup ## Style, the optimised build, and all its tests
	@scripts/test

check: setup-windows setup-web ## What takes longer: clang-tidy, sanitizers, npm, the page, Windows, a Slurm cluster, Debian 13 with g++ 14 and a headset (root)
	@scripts/check

check-scale: setup ## workflows/snakemake on this machine and on a Slurm cluster on it (root); 680 MB of packages
	@scripts/build release nade_cli
	@scripts/check_scale

build: setup ## The library and the command line, optimised, in build/release
	@scripts/build release

bench: setup ## Medians and 99th percentiles on this machine
	@scripts/bench

asan: setup ## The tests under the address and undefined-behaviour sanitizers
	@scripts/build asan
	@ctest --preset asan -j "$$(nproc)"

fuzz: setup ## Looks for input that breaks the library, each kind for SECONDS=60: make fuzz SECONDS=1800
	@scripts/fuzz '$(SECONDS)'

tsan: setup ## Two hands on one mesh, on two threads, under the thread sanitizer
	@scripts/build tsan
	@ctest --preset tsan

test-headset: setup ## All of it in a Debian 13 system, with g++ 14, and `nade xr` on the OpenXR runtime there (root)
	@scripts/test_xr --all

test-windows: setup-windows ## nade.exe and the C libraries for Windows, built here and run with wine
	@scripts/build release
	@scripts/test_windows

tidy: setup ## clang-tidy over our sources
	@scripts/build release
	@scripts/tidy

format: setup ## Lay out the sources as .clang-format says
	@clang-format -i $(sources)

format-check: setup ## Whether `make format` would change anything
	@clang-format --dry-run --Werror $(sources)

python: ## A wheel for pip, in build/python; needs Eigen and python3
	@scripts/install_packages --python
	@scripts/build library nade_c
	@python/build_wheel build/library/src/c/libnade.so build/python

web: setup-web ## The npm package and the page, for browsers, in build/web
	@scripts/web package
	@scripts/web site

web-test: setup-web ## The package's tests, in Node: against the C library, memory, sizes
	@scripts/web package
	@scripts/web test

web-page-test: web ## The page's tests, in a browser: needs chromium
	@scripts/web test-page

web-serve: web ## Shows the page on this machine, and prints its address
	@scripts/web serve

install: ## The library for C++ and C into PREFIX, /usr/local if not given; needs Eigen alone
	@scripts/install_packages --library
	@scripts/build library
	@cmake --install build/library --prefix '$(PREFIX)'

install-all: build ## All of it into PREFIX: nade, what it comes with, and every library
	@cmake --install build/release --prefix '$(PREFIX)'

clean: ## Remove what was built; what was installed and fetched stays
	@rm -rf build

setup:
	@scripts/install_packages
	@scripts/fetch_assets

setup-web: setup
	@scripts/install_packages --web

setup-windows: setup
	@scripts/install_packages --windows
