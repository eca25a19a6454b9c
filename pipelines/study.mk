# A study driven by make: make -f pipelines/study.mk [-j] DIR=study. Every file is made by one sentence from the files it needs, so what exists is not computed
# again: after a change of a rule or a parameter make runs what follows from it, and after a crash the rest. Law: gravity, G M = a = 1, direct sums, leapfrog.
# The study: energy error of an ellipse after a quarter of an orbit against the step, for two eccentricities. Expected: order 2 at both (2 +- 0.05 in table.tsv).
# SPDX-License-Identifier: GPL-3.0-or-later
DIR ?= study
eccentricities := 0.2 0.4
steps := 80 160 320
runs := $(foreach e,$(eccentricities),$(foreach n,$(steps),$(DIR)/run-$e-$n.tsv))
export PATH := $(abspath $(dir $(lastword $(MAKEFILE_LIST)))../bin):$(PATH)
export LC_ALL := C
export OMP_NUM_THREADS := 1
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:

$(DIR)/table.tsv: $(runs)
	@for e in $(eccentricities); do for n in $(steps); do awk -F'\t' -v e=$$e -v n=$$n 'NR == 1 { for (i = 1; i <= NF; i++) c[$$i] = i; next } \
		{ d = ($$c["energy"] + 0.5) / 0.5; printf "%s\t%d\t%.6g\n", e, n, d < 0 ? -d : d }' $(DIR)/run-$$e-$$n.tsv; done; done | \
	awk 'BEGIN { print "eccentricity\tsteps\terror\torder" } \
		{ print $$0 "\t" ($$1 == e ? sprintf("%.3f", log(last / $$3) / log($$2 / n)) : "-"); e = $$1; n = $$2; last = $$3 }' > $@
	@cat $@

# The number of steps of an orbit is the last part of the name, the eccentricity the one before.
$(DIR)/run-%.tsv: $(DIR)/ellipse-%.pm
	cycle -n $$(($(lastword $(subst -, ,$*)) / 4)) 'push kick/2 drift | pp | push kick/2' -i $< | sel --last | diag --pair > $@

.SECONDARY:
$(DIR)/ellipse-%.pm:
	@mkdir -p $(DIR)
	pinit kepler --eccentricity $(firstword $(subst -, ,$*)) --dt $$(awk 'BEGIN { printf "%.17g", 8 * atan2(1, 1) / $(lastword $(subst -, ,$*)) }') -o $@
