# pmpipe: one non-recursive Makefile. The directories are the lists: tools/*.c become programs, lib/*/ become tables and one library.
# make, make check, make asan, make install PREFIX=... DESTDIR=...; PORTABLE=1 leaves out -march=native; B=dir builds elsewhere.
CC ?= gcc
B ?= build
PREFIX ?= /usr/local
VERSION := $(shell sed -n 's/^\#define PM_VERSION "\(.*\)"/\1/p' lib/base/base.h)

WARN = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla $(if $(WERROR),-Werror)
ARCH = $(if $(PORTABLE),,-march=native $(if $(findstring gcc,$(CC)),-mprefer-vector-width=512))
OPT ?= -O3
CFLAGS_ALL = -std=c11 -D_GNU_SOURCE -g $(OPT) $(ARCH) -ffp-contract=off -fno-math-errno -fno-trapping-math -fPIC -fopenmp $(WARN) -Ilib -I$(B) -MMD -MP $(CFLAGS)
LDLIBS_ALL = -Wl,--as-needed -lfftw3 -lgsl -lgslcblas -lpng -ljansson -lm $(LDLIBS)

tables := law kernel mollifier scene step
lib_src := $(sort $(wildcard lib/*/*.c))
lib_obj := $(lib_src:%.c=$(B)/%.o) $(tables:%=$(B)/tables/%.o)
tool_src := $(sort $(wildcard tools/*.c))
tool_obj := $(tool_src:%.c=$(B)/%.o)
tools := $(tool_src:tools/%.c=bin/%)
ifneq ($(B),build)
tools := $(tool_src:tools/%.c=$(B)/bin/%)
endif
unit_src := $(sort $(wildcard tests/unit/*.c))
unit := $(unit_src:%.c=$(B)/%)

all: $(tools) $(B)/libpmpipe.so

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

$(B)/libpmpipe.a: $(lib_obj)
	@rm -f $@
	ar rcs $@ $^

$(B)/libpmpipe.so: $(lib_obj)
	$(CC) -shared -fopenmp -Wl,-soname,libpmpipe.so.0 -o $@ $^ $(LDLIBS_ALL)

$(B)/tables/tools.c: $(tool_src) $(wildcard tools) Makefile
	@mkdir -p $(@D)
	@{ echo '#include "stage/stage.h"'; for n in $(basename $(notdir $(tool_src))); do echo "extern const struct pm_tool tool_$$n;" | tr - _; done; \
	echo 'const struct pm_tool *const pm_tools[] = {'; for n in $(basename $(notdir $(tool_src))); do echo "&tool_$$n," | tr - _; done; echo 'NULL};'; } > $@

# The main of each program is generated; cycle and the unit tests link every tool.
$(B)/mains/%.c: Makefile
	@mkdir -p $(@D)
	@n=$$(echo $* | tr - _); printf '#include "stage/stage.h"\nextern const struct pm_tool tool_%s;\nint main(int argc, char **argv)\n{\n\treturn pm_main(&tool_%s, argc, argv);\n}\n' $$n $$n > $@
$(B)/mains/%.o: $(B)/mains/%.c
	$(CC) $(CFLAGS_ALL) -c -o $@ $<
.PRECIOUS: $(B)/mains/%.c $(B)/mains/%.o $(B)/tests/%.o

bin_dir := $(if $(filter build,$(B)),bin,$(B)/bin)
$(bin_dir)/cycle: $(B)/mains/cycle.o $(tool_obj) $(B)/tables/tools.o $(B)/libpmpipe.a
	@mkdir -p $(@D)
	$(CC) -fopenmp $(CFLAGS) -o $@ $^ $(LDLIBS_ALL)
$(bin_dir)/%: $(B)/mains/%.o $(B)/tools/%.o $(B)/libpmpipe.a
	@mkdir -p $(@D)
	$(CC) -fopenmp $(CFLAGS) -o $@ $^ $(LDLIBS_ALL)

$(B)/tests/unit/%: $(B)/tests/unit/%.o $(tool_obj) $(B)/tables/tools.o $(B)/libpmpipe.a
	$(CC) -fopenmp $(CFLAGS) -o $@ $^ $(LDLIBS_ALL)
unit: $(unit)

clean:
	rm -rf $(B) bin

.PHONY: all unit clean
-include $(shell find $(B) -name '*.d' 2>/dev/null)
