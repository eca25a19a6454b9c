# pmpipe: one non-recursive Makefile. The directories are the lists: tools/*.c and tools/*.sh become programs, lib/*/ become tables and one library.
# make, demo, check, check-long, mutants, asan, fuzz, valgrind, bench, counts, counts-check, gallery, stability, atlas, hard-cases,
# measure, lint, install, uninstall, deb, deb-check, clean; PREFIX=... DESTDIR=... for install;
# PORTABLE=1 leaves out -march=native; DISPATCH=1 builds programs that choose among three sets of instructions when they start; WERROR=1 stops at a
# warning; B=dir builds elsewhere (programs then in B/bin).
ifeq ($(origin CC),default)
CC = gcc
endif
# gcc brings its OpenMP along, clang does not.
ifeq ($(findstring gcc,$(CC))$(filter clean uninstall,$(MAKECMDGOALS)),)
ifneq ($(shell printf '\043include <omp.h>\nint main(void) { return omp_get_max_threads() < 1; }\n' | \
	$(CC) -fopenmp $(CFLAGS) -x c -o /dev/null - $(LDLIBS) >/dev/null 2>&1 || echo no),)
$(error $(CC) -fopenmp does not link: install libomp-dev (for clang-19: libomp-19-dev), or use CC=gcc)
endif
endif
B ?= build
prefix ?= /usr/local
PREFIX ?= $(prefix)
VERSION := $(shell sed -n 's/^\#define PM_VERSION "\(.*\)"/\1/p' lib/base/base.h)
SOVERSION = 0

WARN = -Wall -Wextra -Wno-psabi -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla $(if $(WERROR),-Werror)
# Of other processors there are no levels: then DISPATCH=1 is PORTABLE=1.
levels := $(if $(filter x86_64%,$(shell $(CC) -dumpmachine)),x86-64 x86-64-v3 x86-64-v4)
wide := $(if $(findstring gcc,$(CC)),-mprefer-vector-width=512)
ARCH = $(if $(LEVEL),-march=$(LEVEL) $(if $(findstring v4,$(LEVEL)),$(wide)),$(if $(PORTABLE)$(DISPATCH),,-march=native $(wide)))
OPT ?= -O3
CFLAGS_ALL = -std=c11 -D_GNU_SOURCE -g $(OPT) $(ARCH) -ffp-contract=off -fno-math-errno -fno-trapping-math -fPIC -fopenmp \
	$(WARN) -Ilib -I$(B) -MMD -MP $(CFLAGS)
LDLIBS_ALL = -Wl,--as-needed -lfftw3 -lgsl -lgslcblas -lpng -ljansson -lm $(LDLIBS)
# Programs take the large libraries as archives where these are there: poisson-fft then starts in half the time (bench/start.c).
archive = $(or $(wildcard $(shell $(CC) -print-file-name=lib$(1).a)),-l$(1))
# So is libgomp, which reads OMP_WAIT_POLICY before any program of ours has a say, unless it is part of the program: threads that wait must sleep
# (mains/ below), because those that spin take the cores from the other stages of a pipe (40 times the time on a busy machine).
gomp := $(if $(findstring gcc,$(CC)),$(wildcard $(shell $(CC) -print-file-name=libgomp.a)))
openmp := $(if $(gomp),-pthread,-fopenmp)
# Regions of one thread without libgomp (lib/base/one-thread.c); the name is gcc's alone.
regions := --wrap=GOMP_parallel
LDLIBS_PROGRAM := $(foreach l,fftw3 gsl gslcblas jansson,$(call archive,$(l))) -Wl,--as-needed -lpng $(gomp) -lm $(LDLIBS)

# sh5 alone links HDF5, which costs 5 ms to start: lib/h5/ is no part of the library, and sh5 is no word of a sentence.
h5_include = $(patsubst -I%,-isystem %,$(or $(shell pkg-config --cflags-only-I hdf5 2>/dev/null),-I/usr/include/hdf5/serial))
h5_libs = $(or $(shell pkg-config --libs hdf5 2>/dev/null),-lhdf5_serial)
h5_obj := $(patsubst %.c,$(B)/%.o,$(sort $(wildcard lib/h5/*.c)))
alone := tools/sh5.c

tables := collision distribution effect green law kernel maxwell mollifier relax scene step
lib_src := $(sort $(filter-out lib/h5/% lib/world/mpi.c,$(wildcard lib/*/*.c)))
# The hierarchies of poisson-mg, of double and of single numbers (lib/poisson-mg/mg-number.h).
mg_twice := compact cycle full hierarchy level pyramid ranks relax sweep transfer
lib_obj := $(lib_src:%.c=$(B)/%.o) $(mg_twice:%=$(B)/lib/poisson-mg/mg-%-single.o) $(tables:%=$(B)/tables/%.o) $(B)/tables/atlas.o $(B)/tables/viewer-text.o
tool_src := $(sort $(wildcard tools/*.c))
word_src := $(filter-out $(alone),$(tool_src))
tool_obj := $(word_src:%.c=$(B)/%.o)
bin_dir := $(if $(filter build,$(B)),bin,$(B)/bin)
script_src := $(sort $(wildcard tools/*.sh))
tools := $(tool_src:tools/%.c=$(bin_dir)/%) $(script_src:tools/%.sh=$(bin_dir)/%)
unit_src := $(sort $(wildcard tests/unit/*.c))
unit := $(unit_src:%.c=$(B)/%)
bench_src := $(sort $(wildcard bench/*.c))
bench := $(bench_src:%.c=$(B)/%)

# Ranks of MPI are an object that the programs open under a launcher: they link no MPI, and start as fast without.
MPICC ?= mpicc
mpi_object := $(if $(shell command -v $(MPICC) 2>/dev/null),$(B)/pmpipe-mpi.so)

all: words $(B)/libpmpipe.so
# The programs alone, for the wheel of python/.
words: $(tools) $(bin_dir)/pmpipe $(mpi_object)

$(B)/pmpipe-mpi.so: lib/world/mpi.c lib/world/transport.h
	@mkdir -p $(@D)
	$(MPICC) -std=c11 -O2 -g -fPIC -shared $(WARN) -o $@ $<

$(B)/lib/poisson-mg/mg-%-single.o: lib/poisson-mg/mg-%.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_ALL) -DMG_SINGLE -c -o $@ $<

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_ALL) -c -o $@ $<

$(B)/tables/%.o: $(B)/tables/%.c
	$(CC) $(CFLAGS_ALL) -c -o $@ $<

# A table from a directory: lib/kernel/m4prime.c defines kernel_m4prime and is listed as "m4prime".
define table
$(B)/tables/$(1).c: $(wildcard lib/$(1)/*.c) lib/$(1) Makefile
	@mkdir -p $$(@D)
	@{ echo '#include "$(1)/$(1).h"'; echo '#include <string.h>'; \
	for n in $(sort $(basename $(notdir $(wildcard lib/$(1)/*.c)))); do echo "extern const struct pm_$(1) $(1)_$$$${n}" | tr - _; echo ';'; done; \
	echo 'const struct pm_$(1) *const pm_$(1)s[] = {'; \
	for n in $(sort $(basename $(notdir $(wildcard lib/$(1)/*.c)))); do echo "&$(1)_$$$${n}," | tr - _; done; echo 'NULL};'; \
	echo 'const char *const pm_$(1)_names[] = {'; \
	for n in $(sort $(basename $(notdir $(wildcard lib/$(1)/*.c)))); do echo "\"$$$${n}\","; done; echo 'NULL};'; \
	echo 'const struct pm_$(1) *pm_$(1)_find(const char *name) {'; \
	echo 'for (int i = 0; pm_$(1)s[i]; i++) if (!strcmp(pm_$(1)_names[i], name)) return pm_$(1)s[i];'; \
	echo 'pm_fail(PM_DATA, "no $(1) named %s", name); return NULL; }'; } > $$@
endef
$(foreach t,$(tables),$(eval $(call table,$(t))))

# The measured atlas, as plan reads it.
$(B)/tables/atlas.c: data/atlas/force.tsv data/atlas/step.tsv Makefile
	@mkdir -p $(@D)
	@awk -F'\t' 'BEGIN { print "#include \"planner/atlas.h\"" } \
	FNR == 1 { if (open) print "{0}};"; name = FILENAME ~ /force/ ? "force" : "step"; \
		print "const struct pm_atlas_" name " pm_atlas_" name "s[] = {"; open = 1; head = 0 } \
	/^#/ || NF < 5 { next } !head { head = 1; next } \
	{ texts = name == "force" ? 4 : 2; printf "{"; \
		for (i = 1; i <= NF; i++) { number = $$i ~ /^[-+0-9.]/ ? $$i : "NAN"; \
			if (i <= texts) printf "\"%s\", ", $$i; else printf "%s, ", number }; print "}," } \
	END { print "{0}};" }' data/atlas/force.tsv data/atlas/step.tsv > $@

# The page of sdraw -o run.html: its template, its style and its script, all files one after the other.
viewer_js := $(sort $(wildcard lib/viewer/*.js))
$(B)/tables/viewer-text.c: lib/viewer/page.html lib/viewer/page.css $(viewer_js) lib/viewer Makefile
	@mkdir -p $(@D)
	@{ echo '#include "viewer/viewer-text.h"'; \
	for kind in html css js; do echo "const char pm_viewer_$$kind[] ="; \
		case $$kind in js) cat $(viewer_js);; *) cat lib/viewer/page.$$kind;; esac | sed 's/[\\"?]/\\&/g; s/.*/"&\\n"/'; echo ';'; done; } > $@

$(B)/libpmpipe.a: $(lib_obj)
	@rm -f $@
	ar rcs $@ $^

$(B)/exports.map: lib/exports.txt
	@mkdir -p $(@D)
	@{ echo '{ global:'; sed 's/$$/;/' $<; echo 'local: *; };'; } > $@
$(B)/libpmpipe.so: $(lib_obj) $(B)/exports.map
	$(CC) -shared -fopenmp -Wl,$(regions) -Wl,-soname,libpmpipe.so.$(SOVERSION) -Wl,--version-script=$(B)/exports.map -o $@ $(lib_obj) $(LDLIBS_ALL)

$(B)/tables/tools.c: $(word_src) $(wildcard tools) Makefile
	@mkdir -p $(@D)
	@{ echo '#include "stage/apply.h"'; for n in $(basename $(notdir $(word_src))); do echo "extern const struct pm_tool tool_$$n;" | tr - _; done; \
	echo 'const struct pm_tool *const pm_tools[] = {'; \
	for n in $(basename $(notdir $(word_src))); do echo "&tool_$$n," | tr - _; done; echo 'NULL};'; } > $@

# The main of each program is generated; cycle, plan, modes, again and the unit tests link every tool that can be a word.
$(B)/mains/%.c: Makefile
	@mkdir -p $(@D)
	@n=$$(echo $* | tr - _); printf '%s\n' '#include <stdlib.h>' '#include "stage/stage.h"' "extern const struct pm_tool tool_$$n;" \
		'__attribute__((constructor(101))) static void sleepers(void)' '{' '	setenv("OMP_WAIT_POLICY", "passive", 0);' '}' \
		'int main(int argc, char **argv)' '{' "	return pm_main(&tool_$$n, argc, argv);" '}' > $@
$(B)/mains/%.o: $(B)/mains/%.c
	$(CC) $(CFLAGS_ALL) -c -o $@ $<
.PRECIOUS: $(B)/mains/%.c $(B)/mains/%.o $(B)/tests/%.o $(B)/bench/%.o

# What each program is made of.
parts = $(B)/mains/$(1).o $(if $(filter cycle plan modes again,$(1)),$(tool_obj) $(B)/tables/tools.o,$(B)/tools/$(1).o) $(if $(filter sh5,$(1)),$(h5_obj)) \
	$(B)/libpmpipe.a
$(h5_obj): CFLAGS_ALL += $(h5_include)
ifeq ($(and $(DISPATCH)$(LEVEL),$(levels)),)
define program
$(bin_dir)/$(1): $(call parts,$(1))
	@mkdir -p $$(@D)
	$$(CC) $$(openmp) -Wl,$$(regions) $$(CFLAGS) -o $$@ $$^ $$(LDLIBS_PROGRAM) $(if $(filter sh5,$(1)),$$(h5_libs))
endef
else
# All that a program needs from this tree is built for each level of x86-64 and linked to one object, whose only name is its main (packaging/dispatch.c).
entry = main_$(subst -,_,$(LEVEL))
define program
$(B)/whole/$(1).o: $(call parts,$(1))
	@mkdir -p $$(@D)
	ld -r $$(regions) -o $$@.part $$^
	objcopy --redefine-sym main=$$(entry) --keep-global-symbol=$$(entry) $$@.part $$@ && rm $$@.part
$(bin_dir)/$(1): $(B)/dispatch.o $(levels:%=$(B)/%/whole/$(1).o)
	@mkdir -p $$(@D)
	$$(CC) $$(openmp) $$(CFLAGS) -o $$@ $$^ $$(LDLIBS_PROGRAM) $(if $(filter sh5,$(1)),$$(h5_libs))
endef
whole: $(tool_src:tools/%.c=$(B)/whole/%.o)
.PHONY: whole $(levels)
$(levels):
	+$(MAKE) -s B=$(B)/$@ LEVEL=$@ DISPATCH= whole
$(foreach l,$(levels),$(eval $(tool_src:tools/%.c=$(B)/$(l)/whole/%.o): $(l) ;))
$(B)/dispatch.o: packaging/dispatch.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_ALL) -c -o $@ $<
endif
$(foreach p,$(basename $(notdir $(tool_src))),$(eval $(call program,$(p))))

# A program in shell is one file: what it reads from lib/ is put in.
one_file = awk 'function put(file,  line) { while ((getline line < file) > 0) out(line); close(file) } \
	function out(line,  part) { if (line ~ /^\. lib\//) { split(line, part, " "); put(part[2]) } else if (line !~ /^\# shellcheck (shell|source)=/) { \
		sub(/@VERSION@/, "$(VERSION)", line); print line } } { out($$0) }'
shell_parts := $(wildcard lib/shell/*.sh lib/command/*.sh) lib/base/base.h Makefile
$(script_src:tools/%.sh=$(bin_dir)/%): $(bin_dir)/%: tools/%.sh $(shell_parts)
	@mkdir -p $(@D)
	$(one_file) $< > $@.part
	@chmod +x $@.part && mv $@.part $@

# The command `pmpipe`, with what was built: the compiler, the instructions of the processor (as /proc/cpuinfo names them), the libraries.
$(bin_dir)/pmpipe: lib/command/pmpipe.sh $(shell_parts)
	@mkdir -p $(@D)
	@simd=$$($(CC) $(ARCH) $(CFLAGS) -dM -E -x c /dev/null | \
		sed -nE 's/^\#define __(AVX512F|AVX512DQ|AVX512VL|AVX2|AVX|FMA|BMI2|SSE4_2)__ 1/\1/p' | tr A-Z a-z | sort | tr '\n' ' '); \
	libraries=$$(for l in fftw3 gsl jansson libpng hdf5; do echo "$$l $$(pkg-config --modversion $$l 2>/dev/null || echo '(unknown)'),"; \
		done | tr '\n' ' '); $(one_file) $< | awk -v simd="$${simd% }" -v levels='$(if $(DISPATCH),$(levels))' -v libraries="$${libraries%, }" \
		-v build="$$($(CC) --version | sed 1q | tr -d \'\&), $(OPT)" \
		'{ sub(/@SIMD@/, simd); sub(/@LEVELS@/, levels); sub(/@BUILD@/, build); sub(/@LIBRARIES@/, libraries); print }' > $@.part
	@chmod +x $@.part && mv $@.part $@

# Measuring programs link every tool; so do the unit tests, from one library that they share: sixty copies of it are 1.5 GB, sanitized 4.
$(filter-out %/counts,$(bench)): $(B)/%: $(B)/%.o $(tool_obj) $(B)/tables/tools.o $(B)/libpmpipe.a
	$(CC) -fopenmp $(CFLAGS) -o $@ $^ $(LDLIBS_PROGRAM)
$(B)/libwhole.so: $(lib_obj) $(tool_obj) $(B)/tables/tools.o
	$(CC) -shared -fopenmp $(CFLAGS) -Wl,$(regions) -Wl,-Bsymbolic-functions -o $@ $^ $(LDLIBS_ALL)
$(unit): $(B)/%: $(B)/%.o $(B)/libwhole.so
	$(CC) -fopenmp $(CFLAGS) -Wl,-rpath,'$$ORIGIN/../..' -o $@ $^ $(LDLIBS_ALL)
$(B)/bench/h5-datasets.o: CFLAGS_ALL += $(h5_include)
$(B)/bench/h5-datasets: LDLIBS_PROGRAM += $(h5_libs)
# Of the library no more than these loops need: half of it, for a check that is to be quick.
counts_rooms := base current far fft green green-parts james kernel mesh mollifier poisson poisson-fft poisson-mg push step step-parts stream transfer world
counts_obj := $(foreach r,$(counts_rooms),$(filter $(B)/lib/$(r)/%.o,$(lib_obj))) $(patsubst %,$(B)/tables/%.o,green kernel law mollifier step)
$(B)/counts.a: $(counts_obj)
	@rm -f $@
	ar rcs $@ $^
$(B)/bench/counts: $(B)/bench/counts.o $(B)/counts.a
	$(CC) -fopenmp $(CFLAGS) -o $@ $^ $(LDLIBS_PROGRAM)
unit: $(unit)
unit-objects: $(unit:%=%.o)
benches: $(bench)

demo:
	sh pipelines/demo.sh
check:
	sh tests/check.sh
check-long:
	PM_LONG=1 sh tests/check.sh
# Plants the errors of tests/mutants.tsv, one at a time, in copies of the tree, and says which the tests catch: some ten seconds each on two cores.
mutants:
	bash tests/mutants.sh

# The sanitizers see the unit tests and the tests that feed the tools what they do not like. Those of gcc and of clang see different things:
# make asan CC=clang asan_build=build/asan-clang. What clang makes there serves the fuzzers too.
SANITIZERS = address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g1 -DPM_SANITIZED
SANITIZE = -fsanitize=$(if $(findstring clang,$(CC)),fuzzer-no-link,address),$(SANITIZERS) $(if $(findstring clang,$(CC)),,-Wno-format-truncation)
asan_tests ?= $(wildcard tests/tool/contract.bats tests/tool/cut-stream.bats tests/tool/examples.bats tests/hard/pipe-contract.bats)
asan_build ?= build/asan
# The leak checker of clang 14 crashes where it meets the threads of libomp (Tracer caught signal 11): leaks are looked for by gcc's.
asan_leaks = $(if $(findstring clang,$(CC)),ASAN_OPTIONS=detect_leaks=0)
# unit-objects: the unit tests are only compiled, and LEAVE_OUT='.*' keeps them from being run.
asan_unit ?= unit
asan:
	+$(MAKE) B=$(asan_build) OPT=-O1 CFLAGS='$(SANITIZE)' all $(asan_unit)
	B=$(asan_build) PM_SANITIZED=1 LSAN_OPTIONS=suppressions=$(CURDIR)/tests/leaks.txt:print_suppressions=0 $(asan_leaks) bash tests/run.sh $(asan_tests)
# Fuzzing (docs/reliability.md), SECONDS for each harness; FUZZ="reader table" runs these alone. The inputs that were found stay in build/asan-clang/fuzz/.
fuzz_src := $(sort $(wildcard tests/fuzz/*.c))
fuzzers := $(fuzz_src:%.c=$(B)/%)
fuzz_cc := $(if $(findstring clang,$(CC)),$(CC),clang)
fuzz: all
	@printf 'int LLVMFuzzerTestOneInput(void) { return 0; }\n' | $(fuzz_cc) -fsanitize=fuzzer,address -x c -o /dev/null - 2>/dev/null || \
		{ echo 'fuzz: a clang with libFuzzer is needed (apt install clang libomp-dev; for clang-19 libclang-rt-19-dev, libomp-19-dev)'; exit 1; }
	+$(MAKE) B=build/asan-clang CC='$(fuzz_cc)' OPT=-O1 CFLAGS='-fsanitize=fuzzer-no-link,$(SANITIZERS)' fuzzers
	B=build/asan-clang bash tests/fuzz/run.sh $(or $(SECONDS),60) $(FUZZ)
fuzzers: $(fuzzers)
$(B)/tests/fuzz/sentence: $(tool_obj) $(B)/tables/tools.o
$(fuzzers): $(B)/%: $(B)/%.o $(B)/libpmpipe.a
	$(CC) -fopenmp $(CFLAGS) -fsanitize=fuzzer $(fuzz_wrap) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(LDLIBS_PROGRAM)
$(B)/tests/fuzz/sentence: fuzz_wrap = -Wl,--wrap=pm_replace_open,--wrap=pm_h5_pipe_open
valgrind:
	+$(MAKE) B=build/valgrind OPT=-O1 PORTABLE=1 unit
	B=build/valgrind PM_WRAP='valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite' bash tests/run.sh unit

gallery: all
	bash docs/gallery.sh
# The tables of docs/stability.md: three minutes.
stability: all
	bash docs/stability.sh
# The figures of docs/accuracy/ and the tables of data/atlas/, measured anew: four minutes, on a machine at rest.
atlas: all
	bash docs/accuracy/atlas.sh
# The measured column of docs/hard-cases.md.
hard-cases: all unit
	bash docs/hard-cases.sh
bench: all benches
	bash bench/run.sh

# Instructions of the hot loops in a build that is the same on every machine of a kind: written to bench/counts.tsv, or compared with it.
counts counts-check:
	+$(MAKE) -s B=build/portable PORTABLE=1 build/portable/bench/counts
	CC=$(CC) bash bench/counts.sh $(if $(findstring check,$@),--check) build/portable/bench/counts
measure:
	@bash tests/measure.sh

# What compilers, mandoc and shellcheck have to say; all must be silent.
lint: all man
	+$(MAKE) -s B=build/gcc CC=gcc WERROR=1 all unit benches
	+$(if $(shell command -v clang),$(MAKE) -s B=build/clang CC=clang WERROR=1 all unit benches,@echo 'lint: no clang here')
	$(if $(shell command -v mandoc),mandoc -T lint -W warning $(man),@echo 'lint: no mandoc here')
	$(if $(shell command -v shellcheck),shellcheck -x .ci/run $(script_src) lib/command/pmpipe.sh lib/command/completion.bash \
		$(wildcard pipelines/*.sh tests/*.sh tests/fuzz/*.sh bench/*.sh docs/*.sh docs/accuracy/*.sh),@echo 'lint: no shellcheck here')

# Manual pages are printed by the programs; that of a word is called pmpipe-WORD where it is installed, because other packages have some of these names.
man := $(tools:$(bin_dir)/%=$(B)/man/%.1) $(B)/man/pmpipe.1
man: $(man)
$(B)/man/%.1: $(bin_dir)/%
	@mkdir -p $(@D)
	$< --man > $@.part && mv $@.part $@
$(B)/man/pmpipe.1: $(tools)
$(B)/pmpipe.pc: lib/pmpipe.pc.in # always: the last install may have had another PREFIX
	sed 's|@PREFIX@|$(PREFIX)|; s|@VERSION@|$(VERSION)|' $< > $@

D = $(DESTDIR)$(PREFIX)
# What a word or a program outside may include (docs/library.md): complete, so that each of these includes no other of ours. lib/exports.txt lists what
# the shared library exports: every function and table declared in them, and no more.
public := $(addprefix lib/,base/base.h stream/frame.h stream/declare.h stream/run.h stream/wire.h stage/stage.h \
	kernel/kernel.h law/law.h mollifier/mollifier.h green/green.h mesh/grid.h mesh/gradient.h transfer/transfer.h \
	fft/fft-plans.h poisson-fft/poisson-fft.h poisson-fft/influence.h poisson-mg/multigrid.h poisson-mg/mg.h poisson-mg/mg-variable.h far/pp.h)
public:
	@echo $(public)
# The words go to libexec/pmpipe, where `pmpipe WORD` finds them: Debian has other programs called cycle, diffuse, field, pp and stack. WITH_WORDS=1 puts them
# on PATH too, with their manual pages and completion.
words = $(notdir $(tools))
completions = $(D)/share/bash-completion/completions
install: all man $(B)/libpmpipe.a $(B)/pmpipe.pc
	install -d $(D)/bin $(D)/libexec/pmpipe $(D)/lib/pkgconfig $(D)/share/man/man1 $(completions) $(D)/share/zsh/site-functions \
		$(D)/share/fish/vendor_completions.d $(D)/share/pmpipe $(D)/share/doc/pmpipe/methods
	install $(bin_dir)/pmpipe $(D)/bin
	install $(tools) $(D)/libexec/pmpipe
	$(if $(mpi_object),install -D -m 644 $(mpi_object) $(D)/lib/pmpipe/pmpipe-mpi.so)
	install -m 644 $(B)/man/pmpipe.1 $(D)/share/man/man1
	for w in $(words); do sed "/^.SH NAME/{n;s/^/pmpipe\\\\-/;}" $(B)/man/$$w.1 > $(D)/share/man/man1/pmpipe-$$w.1 || exit 1; done
	install -m 644 lib/command/completion.bash lib/command/completion.zsh lib/command/completion.fish $(D)/share/pmpipe
	ln -sf ../../pmpipe/completion.bash $(completions)/pmpipe
	ln -sf ../../pmpipe/completion.zsh $(D)/share/zsh/site-functions/_pmpipe
	ln -sf ../../pmpipe/completion.fish $(D)/share/fish/vendor_completions.d/pmpipe.fish
	$(if $(WITH_WORDS),for w in $(words); do ln -sf ../libexec/pmpipe/$$w $(D)/bin/$$w && ln -sf pmpipe-$$w.1 $(D)/share/man/man1/$$w.1 && \
		ln -sf pmpipe $(completions)/$$w || exit 1; done)
	install -m 644 $(B)/libpmpipe.a $(D)/lib
	install $(B)/libpmpipe.so $(D)/lib/libpmpipe.so.$(VERSION)
	ln -sf libpmpipe.so.$(VERSION) $(D)/lib/libpmpipe.so.$(SOVERSION)
	ln -sf libpmpipe.so.$(SOVERSION) $(D)/lib/libpmpipe.so
	for h in $(public); do install -D -m 644 $$h $(D)/include/pmpipe/$${h#lib/} || exit 1; done
	install -m 644 lib/pmpipe-read.h $(D)/include/pmpipe
	install -m 644 $(B)/pmpipe.pc $(D)/lib/pkgconfig
	install -m 644 README.md NEWS COPYING $(wildcard docs/*.md) docs/read.py $(D)/share/doc/pmpipe
	install -m 644 $(wildcard docs/methods/*.md) $(D)/share/doc/pmpipe/methods
	install -D -m 644 -t $(D)/share/doc/pmpipe/notes $(wildcard docs/notes/*.md)
# A word on PATH is removed where it is a link to ours.
uninstall:
	ours() { [ "$$(readlink "$$1")" != "$$2" ] || rm -f "$$1"; }; for w in $(words); do ours $(D)/bin/$$w ../libexec/pmpipe/$$w; \
		ours $(D)/share/man/man1/$$w.1 pmpipe-$$w.1; ours $(completions)/$$w pmpipe; done
	rm -f $(D)/bin/pmpipe $(D)/share/man/man1/pmpipe.1 $(words:%=$(D)/share/man/man1/pmpipe-%.1) $(completions)/pmpipe
	rm -f $(D)/share/zsh/site-functions/_pmpipe $(D)/share/fish/vendor_completions.d/pmpipe.fish
	rm -rf $(D)/libexec/pmpipe $(D)/lib/pmpipe $(D)/share/pmpipe
	rm -f $(D)/lib/libpmpipe.a $(D)/lib/libpmpipe.so $(D)/lib/libpmpipe.so.$(SOVERSION) $(D)/lib/libpmpipe.so.$(VERSION) $(D)/lib/pkgconfig/pmpipe.pc
	rm -rf $(D)/include/pmpipe $(D)/share/doc/pmpipe

# Packages of Debian from the files that git knows, in build/deb: packaging/debian has the rules. deb-check: they are made, checked by lintian, installed
# and removed on a bare machine (tests/deb.sh; BARE=DIRECTORY is one that debootstrap made, else it makes one, as root).
deb:
	+sh tests/deb.sh build
deb-check:
	+sh tests/deb.sh build check

clean:
	rm -rf $(B) bin

.PHONY: $(B)/pmpipe.pc all words public unit unit-objects benches demo check check-long mutants asan fuzz fuzzers valgrind bench counts counts-check \
	gallery stability atlas hard-cases measure lint man install uninstall deb deb-check clean
-include $(lib_obj:.o=.d) $(h5_obj:.o=.d) $(tool_obj:.o=.d) $(B)/tools/sh5.d $(unit:=.d) $(bench:=.d) $(fuzzers:=.d)
