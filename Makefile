# A thin front for CMake's presets and the scripts in ci/, compare/ and reference/. `make help` lists the targets.
#
# REFERENCE=off     leave LIGGGHTS, OpenFOAM and demvof out (what needs them is named as left out, and not judged)
# VERIFY=short      only the checks of that frequency        SCENE=s1   one scene (make reference, charts)
# OUT=dir           where results go (default: out)          JOBS=n     jobs: compiling, tests, runs beside each other
# GO_ON=yes         make verify keeps the runs that this very program has made, and goes on with those cut short; make faults the kinds that held
# PREFIX=dir        where make install puts it (default: /usr/local)
# SAMPLE=n          so many of the faults (make mutate)        FOR=n, INPUTS=n   seconds, or inputs, of each reader (make fuzz)
# LABELS=unit       those tests only (make test; default: unit|verification)
.DEFAULT_GOAL := help
SHELL := /bin/bash
# Debian's interpreter: another python3 on PATH has not got Debian's packages.
PYTHON := /usr/bin/python3
JOBS ?= $(shell nproc)
OUT ?= out
PREFIX ?= /usr/local
DESTDIR ?=
REFERENCE ?= on
LABELS ?= unit|verification
export JOBS

RELEASE := build/release
PYTEST_DIRS = $(wildcard ci/tests compare/tests reference/tests)
SOURCES = git ls-files -z '*.cpp' '*.hpp'

# $(call need,file): a target whose part of the project does not exist yet says so and fails.
need = @test -x $(1) || { echo "make $@: not available yet: this version has no $(1)" >&2; exit 1; }

.PHONY: help setup build install package verify test reference plots charts stability runout nightly faults mutate fuzz bench format tidy sanitize

help:  ## list the targets
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## */  make \1\t/' | expand -t 18
	@sed -n 's/^# \([A-Z]*=.*\)/  \1/p' $(MAKEFILE_LIST)

setup:  ## install what is missing (Debian packages; root or sudo)
	@ci/setup

build: setup  ## build the programs, the reference left out
	ci/build --programs release

install: build  ## programs, Python module, man pages and completion into PREFIX (default: /usr/local; DESTDIR is kept to)
	DESTDIR="$(DESTDIR)" cmake --install $(RELEASE) --prefix "$(PREFIX)"

package: build  ## a Debian package of the same, for this machine's processor: out/granvof_VERSION_ARCH.deb
	cd $(RELEASE) && cpack -G DEB -B "$(abspath $(OUT))"

verify: setup  ## run the scenes and check them: table, out/verify/report.html, exit code
	$(call need,compare/verify)
	ci/build --programs --reference=$(REFERENCE) release
	compare/verify --build-dir $(RELEASE) --out "$(OUT)" --jobs $(JOBS) $(if $(VERIFY),--frequency $(VERIFY)) \
	  $(if $(GO_ON),--go-on) $(if $(filter off,$(REFERENCE)),--without-canary)

test: setup  ## unit and verification tests (ctest), then the Python tests
	ci/build --reference=$(REFERENCE) release
	ctest --preset release --label-regex '^($(LABELS))$$' --parallel $(JOBS)
	$(PYTHON) -m pytest -q -p no:cacheprovider --import-mode=importlib $(PYTEST_DIRS)

reference: setup  ## run and record the DEM-VOF reference where missing or stale (SCENE=s1: one scene)
	$(call need,reference/record)
	ci/build --programs --reference=required release
	reference/record --build-dir $(RELEASE) $(SCENE)

plots: setup  ## plots and report from existing results, without running anything
	$(call need,compare/verify)
	compare/verify --plots-only --build-dir $(RELEASE) --out "$(OUT)"

charts: setup  ## error against cost of every method (compare/study.toml): runs what is missing, draws (SCENE=s1: one)
	ci/build --programs release
	$(RELEASE)/compare/granvof-compare charts --cache "$(OUT)/study" --out "$(OUT)/charts" $(if $(SCENE),--scene $(SCENE))
	$(PYTHON) compare/report/charts.py --charts "$(OUT)/charts"

runout: setup  ## why the run-out runs ahead late (compare/late-run-out.toml): s1, s2, dry-column, for the report after `make charts`
	ci/build --programs release
	for scene in s1 s2 dry-column; do $(RELEASE)/compare/granvof-compare ablate cases/$$scene.toml \
	  --study compare/late-run-out.toml --cache "$(OUT)/study" --out "$(OUT)/ablate/$$scene-run-out" || exit; done

stability: setup  ## where the methods hold and fail, by bisection (half an hour); out/stability, drawn by `make plots`
	ci/build --programs release
	compare/stability --build-dir $(RELEASE) --out "$(OUT)" --jobs $(JOBS)

nightly: setup  ## all stages of the nightly run, with history and trends
	$(call need,ci/nightly)
	ci/nightly

faults: setup  ## bad input, kills, full disks, damaged and foreign files (ci/faults.toml): tried and held, for the report
	ci/build --programs --reference=$(REFERENCE) release
	ci/faults --build-dir $(RELEASE) --jobs $(JOBS) --out "$(OUT)" $(if $(GO_ON),--go-on)

mutate: setup  ## small faults put into the code one at a time (ci/mutants): who notices each, for the report; goes on where it stopped
	ci/mutate --out "$(OUT)" --jobs $(JOBS) $(if $(SAMPLE),--sample $(SAMPLE))

fuzz: setup  ## any bytes at all into the readers of files, ten minutes each (FOR=n: n seconds; INPUTS=n: the same n inputs)
	ci/fuzz --out "$(OUT)" $(if $(INPUTS),--inputs $(INPUTS),$(if $(FOR),--seconds $(FOR)))

bench: setup  ## performance of the parts, and of whole runs against their targets (ci/targets.toml)
	ci/build --benchmarks release
	ci/bench $(RELEASE)

format:  ## clang-format all C++ sources in place
	$(SOURCES) | xargs -0 -r clang-format -i

tidy: setup  ## clang-tidy over all C++ sources that changed since it last found them clean
	ci/tidy --reference=$(REFERENCE)

sanitize: setup  ## unit tests under the address and undefined-behaviour sanitizers
	ci/build sanitize
	ctest --preset sanitize --label-regex '^unit$$' --parallel $(JOBS)
