# make            the library and the command line        make demo      set up, build, fold a pattern, say where it is
# make test       set up, build, run every test           make check     everything a change must pass
# make bench      times, as CSV                           make install   prefix=/usr/local DESTDIR=
# make debian     a source package and what it builds     make abi       keep what the libraries show now
# make fuzz [seconds=600] [target=fold]    make mutants    make check-long   what takes longer than a change can wait for
# make asan (with coverage), tsan, valgrind, lint, werror, layers, equations, abi-check, outputs, format, pictures, figures, corpus [fresh=1],
#      chart, stability, uninstall, clean
# config=release|debug|asan|coverage|tsan|fuzz   GL=osmesa|egl|none (the first that is there)   GPL=1|0   CC=gcc|clang   WERROR=0|1
# V=1 shows whole commands
config  ?= release
GPL     ?= 1
WERROR  ?= 0
prefix  ?= /usr/local
bindir     ?= $(prefix)/bin
libdir     ?= $(prefix)/lib
includedir ?= $(prefix)/include
mandir     ?= $(prefix)/share/man
bashdir    ?= $(prefix)/share/bash-completion/completions
zshdir     ?= $(prefix)/share/zsh/site-functions
fishdir    ?= $(prefix)/share/fish/vendor_completions.d
VERSION := 0.1.0
SOVERSION := 0

# What the caller asked for, before a default is chosen: tools/setup installs for that.
setup := GL='$(GL)' GPL='$(GPL)' sh tools/setup
ifeq ($(GL),)
override GL := $(shell for gl in osmesa egl; do pkg-config --exists $$gl 2>/dev/null && echo $$gl && exit; done; echo osmesa)
endif
ifeq ($(filter $(GL),osmesa egl none),)
$(error GL is one of osmesa, egl, none)
endif
ifeq ($(filter $(config),release debug asan coverage tsan fuzz),)
$(error config is one of release, debug, asan, coverage, tsan, fuzz)
endif

# What is the same whatever parts are left out is in A, the rest in B.
A := build/$(config)$(if $(filter clang%,$(CC)),-clang)
B := $A$(if $(filter-out osmesa,$(GL)),-gl-$(GL))$(if $(filter 0,$(GPL)),-nogpl)

pkgs := libxml-2.0 jansson libpng zlib
gl_osmesa := osmesa
gl_egl    := egl gl
# OSMesa is opened when something is drawn, see render/gl.c.
pkgs += $(filter-out osmesa,$(gl_$(GL)))

# In lower case what the project needs; CPPFLAGS, CFLAGS, LDFLAGS, LDLIBS stay the caller's.
cppflags := -Iinclude -Isrc -D_XOPEN_SOURCE=700 -DRG_GL_$(GL)=1 -I/usr/include/suitesparse $(shell pkg-config --cflags $(pkgs) $(gl_$(GL)) 2>/dev/null)
cflags   := -std=c11 -fPIC -fvisibility=hidden -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes \
            -Wmissing-prototypes -Wvla -Wpointer-arith -Wwrite-strings
core_libs := -lcamd -lsuitesparseconfig -lpthread -lm
libs     := $(shell pkg-config --libs $(pkgs) 2>/dev/null) -lgif -ldl $(core_libs)
ifeq ($(GPL),1)
cppflags += -DRG_GPL=1
libs     := -lgsl -lgslcblas $(libs)
endif
ifeq ($(WERROR),1)
cflags   += -Werror
endif
optimise_release  := -O2 -g
optimise_debug    := -O0 -g
optimise_asan     := -O1 -g1
optimise_coverage := -O1 -g1
optimise_tsan     := -O1 -g1
optimise_fuzz     := -O1 -g1
CFLAGS   ?= $(optimise_$(config))
ldflags  :=
ifeq ($(config),asan)
# Lines are counted at the same time, see tools/checks.mk.
ldflags  += -fsanitize=address,undefined --coverage
cflags   += $(ldflags) -fno-sanitize-recover=all -fno-omit-frame-pointer
else ifeq ($(config),coverage)
ldflags  += --coverage
cflags   += --coverage
else ifeq ($(config),tsan)
ldflags  += -fsanitize=thread
cflags   += $(ldflags)
else ifeq ($(config),fuzz)
ldflags  += -fsanitize=address,undefined
cflags   += -fsanitize=fuzzer-no-link $(ldflags) -fno-sanitize-recover=all -fno-omit-frame-pointer
endif
# One short line a command; V=1 shows the whole of it.
Q := $(if $(filter 1,$(V)),,@)
say = $(if $Q,@printf '%-5s %s\n' '$1' '$2')
compile = $(CC) $(cppflags) $(CPPFLAGS) $(cflags) $(CFLAGS)
link    = $(CC) $(ldflags) $(LDFLAGS)

src   := $(sort $(wildcard src/*/*.c))
# Files that a part left out changes; `without` sees to it that no header does.
varying := $(shell grep -l '^ *\# *[a-z]*if.*RG_G\(PL\|L_[a-z]\)' src/*/*.c)
cmd   := $(filter-out tools/make_%,$(sort $(wildcard tools/*.c)))
tests := $(sort $(wildcard tests/test_*.c))
bench := tests/bench/speed.c $(filter-out tests/bench/speed.c,$(sort $(wildcard tests/bench/*.c)))
at_home = $(foreach f,$1,$(if $(filter $(varying),$f),$B,$A)/$(f:.c=.o))
lib_o := $(call at_home,$(src))
# The core: the rooms that know neither files nor pictures, and of them no part that a GPL library does. The same objects but for those.
above  := read save generate verify files render write chart
gpl    := src/linalg/rank.c
core   := $(filter-out $(above:%=src/%/%),$(src))
core_o := $(call at_home,$(filter-out $(gpl),$(core))) $(gpl:%.c=$A/core/%.o)
cmd_o := $(cmd:%.c=$A/%.o)
test_bin  := $(tests:%.c=$B/%)
example_bin := $(patsubst %.c,$B/%,$(sort $(wildcard docs/examples/*/*.c)))
bench_bin := $(bench:%.c=$B/%)

# As many jobs as there are processors, unless the caller chose.
jobs = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 2))

all: build
	@ln -sfn $B/rigami rigami

# Shared libraries: on macOS (not tried here) they are called otherwise, know where they are installed, and what they export is told by
# name alone, without versions.
ifeq ($(shell uname -s),Darwin)
so     := dylib
exports := darwin
so_at   = lib$1.$2.dylib
shared  = -dynamiclib -install_name $(libdir)/$(call so_at,$1,$(SOVERSION)) -compatibility_version $(SOVERSION) \
          -current_version $(VERSION) -Wl,-exported_symbols_list,$B/made/lib$1.exports
else
so     := so
exports := map
so_at   = lib$1.so.$2
shared  = -shared -Wl,-soname,$(call so_at,$1,$(SOVERSION)) -Wl,--no-undefined -Wl,--as-needed -Wl,--version-script=$B/made/lib$1.exports
endif

build: $B/librigami.a $B/librigami.$(so) $B/librigami-core.a $B/librigami-core.$(so) $B/rigami

# What the compiler had to say stays beside the object, until it is made anew: `make werror` asks for it.
remark = 2>$@.said; status=$$?; cat $@.said >&2; [ -s $@.said ] || rm -f $@.said; exit $$status
$A/%.o: %.c
	@mkdir -p $(@D)
	$(call say,cc,$<)
	$Q$(compile) -MMD -MP -c -o $@ $< $(remark)
ifneq ($A,$B)
$B/%.o: %.c
	@mkdir -p $(@D)
	$(call say,cc,$<)
	$Q$(compile) -MMD -MP -c -o $@ $< $(remark)
endif

# The page of write/html.c, as the elements of an array.
page := $(addprefix src/write/page/,head.html pose.js camera.js draw.js hands.js tail.html)
$A/made/write/page.h: $(page)
	@mkdir -p $(@D)
	$(call say,page,src/write/page)
	$Qcat $(page) | od -An -v -tu1 | sed 's/[0-9][0-9]*/&,/g' >$@

$A/src/write/html.o: $A/made/write/page.h
$A/src/write/html.o: cppflags += -I$A/made

$A/core/%.o: %.c
	@mkdir -p $(@D)
	$(call say,cc,$< (core))
	$Q$(compile) -URG_GPL -MMD -MP -c -o $@ $< $(remark)

$B/librigami.a: $(lib_o)
$B/librigami-core.a: $(core_o)
$B/librigami.a $B/librigami-core.a:
	@rm -f $@
	$(call say,ar,$@)
	$Qar rcs $@ $^

$B/made/lib%.exports: include/rigami.h tools/install/exports
	@mkdir -p $(@D)
	@CC='$(CC)' sh tools/install/exports $(exports) $* $(SOVERSION) >$@.part && mv $@.part $@

$B/librigami.$(so): $(lib_o) $B/made/librigami.exports
	$(call say,link,$@)
	$Q$(link) $(call shared,rigami) -o $@ $(lib_o) $(libs) $(LDLIBS)

# That this links says that no room of the core needs one above it.
$B/librigami-core.$(so): $(core_o) $B/made/librigami-core.exports
	$(call say,link,$@)
	$Q$(link) $(call shared,rigami-core) -o $@ $(core_o) $(core_libs) $(LDLIBS)

$B/rigami: $(cmd_o) $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -o $@ $^ $(libs) $(LDLIBS)

# What tests and times are compared with.
oracles := $(if $(filter 1,$(GPL)),-lspqr -lcholmod -lgsl -lgslcblas)

# Tests see the library's inside, so they link the archive.
$B/tests/test_%: $B/tests/test_%.o $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -o $@ $(filter %.o %.a,$^) -lcmocka $(oracles) $(libs) $(LDLIBS)

$B/tests/stability: $B/tests/stability.o $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -o $@ $^ -lcmocka $(libs) $(LDLIBS)

$B/tests/bench/%: $B/tests/bench/%.o $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -o $@ $^ $(oracles) $(libs) $(LDLIBS)

# What the embedder sees: the examples know nothing but rigami.h.
$B/docs/examples/%: $B/docs/examples/%.o $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -o $@ $^ $(libs) $(LDLIBS)

# ------------------------------------------------------------------------------------------------ test, demo

# A second make, because what pkg-config says is asked when a makefile is read: before tools/setup, it may say nothing.
test:
	@$(setup)
	@$(MAKE) --no-print-directory $(jobs) run-tests

demo:
	@$(setup)
	@$(MAKE) --no-print-directory $(jobs) run-demo

# Mesa and the libraries under it keep memory until the program ends.
run-tests: $(if $(filter release,$(config)),all,build) $(test_bin)
	@ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=tests/lsan.supp:print_suppressions=0 \
	 UBSAN_OPTIONS=print_stacktrace=1 RIGAMI=$B/rigami sh tools/run_tests $(test_bin)

run-demo: all
	@sh tools/run_demo $B/rigami

bench:
	@$(setup)
	@$(MAKE) --no-print-directory $(jobs) run-bench

run-bench: $(bench_bin)
	@for b in $(bench_bin); do $$b $(BENCH) || exit 1; done

# ----------------------------------------------------------------------------------------------------- check

# The parts of a check, the longest first: they go side by side, each has what it says kept in build/check.
parts := asan fuzz-smoke lint valgrind tsan install-check outputs tutorial without docs abi-check werror header equations layers

# tested=yes: make test was run already.
check:
	@$(setup) check
	@$(if $(tested),,$(MAKE) --no-print-directory $(jobs) run-tests)
	@$(MAKE) --no-print-directory $(jobs) everything >/dev/null
	@$(MAKE) --no-print-directory $(jobs) $(parts:%=part-%)
	@echo "check: all $(words $(parts)) parts passed"

# The parts find the release build made, so that none of them touches it while another one reads it.
part-%:
	@sh tools/check_part '$(MAKE) --no-print-directory $*' $*

# What gcc said of all files when they were compiled, and what clang says of them.
werror: everything
	@! cat $(wildcard $(addsuffix .said,$(lib_o) $(cmd_o) $(test_bin:=.o) $(bench_bin:=.o) $(example_bin:=.o))) /dev/null | grep .
	@printf '%s\n' $(src) $(cmd) $(tests) $(bench) $(wildcard docs/examples/*/*.c tests/fuzz/*.c) | \
	    xargs -n 20 clang $(cppflags) -I$A/made -Itests/fuzz $(filter-out -f%,$(cflags)) -Werror -fsyntax-only
	@echo "no warnings from gcc and clang"

everything: build $(test_bin) $(bench_bin) $(example_bin)

# Builds with a part left out, each asked to do what it still can.
without: build
	@! grep -n '^ *# *[a-z]*if.*RG_G\(PL\|L_[a-z]\)' src/*/*.h tools/*.[ch]
	@$(MAKE) --no-print-directory GPL=0 build
	@$(MAKE) --no-print-directory GL=none build
	@sh tools/smoke $A$(if $(filter-out osmesa,$(GL)),-gl-$(GL))-nogpl/rigami $(GL)
	@sh tools/smoke $A-gl-none/rigami none
	@sh tools/check_same $B/rigami $A$(if $(filter-out osmesa,$(GL)),-gl-$(GL))-nogpl/rigami

# What other programs make of our files; they are asked where they are there.
outputs: build
	@sh tools/check_outputs $B/rigami

layers:
	@sh tools/check_layers

equations:
	@sh tools/check_equations

# What docs/tutorial.md and docs/troubleshooting.md say that the program says.
tutorial: build
	@sh tools/check_messages
	@sh tools/check_tutorial $B/rigami

header:
	@! grep -n '.\{121\}' include/rigami.h
	@clang -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -Iinclude -fsyntax-only tests/header.cpp
	@clang -x c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -Iinclude -fsyntax-only tests/header.cpp
	@echo "rigami.h is C++ too"

# build/docs: the reference, out of rigami.h, and the tour; anything that Doxygen has to say fails.
docs:
	@mkdir -p build/docs
	@if ! command -v doxygen >/dev/null; then echo "SKIPPED: no doxygen"; exit 0; fi; \
	VERSION=$(VERSION) doxygen docs/Doxyfile >build/docs/log 2>&1 || { cat build/docs/log; exit 1; }; \
	test ! -s build/docs/log || { cat build/docs/log; exit 1; }; \
	echo "build/docs/html/index.html, without a warning"
.PHONY: docs

# What the shared libraries show and need, against what is kept in tests/abi; abi: keeps what there is.
abi-check: build
	@CC='$(CC)' sh tools/check_abi $B
abi: build
	@CC='$(CC)' sh tools/check_abi $B --write

# build/package: the Debian source package, laid out; debian: and built, and looked through.
debian-source:
	@sh tools/make_package $(VERSION)
debian:
	@sh tools/make_package $(VERSION) build
.PHONY: abi abi-check debian debian-source

format:
	clang-format -i $(wildcard include/*.h src/*/*.[ch] tools/*.[ch] tests/*.[ch] tests/bench/*.[ch])

pictures: all
	@sh tools/make_pictures $B/rigami

# docs/chart, docs/stability: measured anew, each in a minute or two.
chart: build
	@sh tools/make_charts $B/rigami
stability: $B/tests/stability
	@mkdir -p docs/stability
	@$< docs/stability
.PHONY: chart stability

figures: $B/rigami
	@sh tools/make_figures $B/rigami

# Which real crease patterns fold. Goes on where it was interrupted; fresh=1 begins anew.
corpus: $B/rigami
	@sh tools/corpus $B/rigami $(if $(filter 1,$(fresh)),--fresh)

# --------------------------------------------------------------------------------------------------- install

cmakedir = $(libdir)/cmake/rigami
installed = $(bindir)/rigami $(includedir)/rigami.h \
            $(foreach l,rigami rigami-core,$(libdir)/lib$l.a $(libdir)/$(call so_at,$l,$(VERSION)) $(libdir)/$(call so_at,$l,$(SOVERSION)) \
                $(libdir)/lib$l.$(so) $(libdir)/pkgconfig/$l.pc) $(cmakedir)/rigamiConfig.cmake $(cmakedir)/rigamiConfigVersion.cmake \
            $(mandir)/man1/rigami.1 $(mandir)/man1/rigami-fold.1 $(mandir)/man3/librigami.3 \
            $(bashdir)/rigami $(zshdir)/_rigami $(fishdir)/rigami.fish
empty :=
# What an installed file says of its surroundings: $(call filled,NAME,WHAT,LIBS,CFLAGS), for sed.
filled = -e 's|@prefix@|$(prefix)|' -e 's|@libdir@|$(libdir:$(prefix)%=$${prefix}%)|' -e 's|@includedir@|$(includedir:$(prefix)%=$${prefix}%)|' \
         -e 's|@name@|$1|' -e 's|@what@|$2|' -e 's|@version@|$(VERSION)|' -e 's|@libs@|$(strip $3)|' -e 's|@cflags@|$(addprefix $(empty) ,$4)|'

install: build $B/rigami-fold.1
	install -d $(sort $(dir $(addprefix $(DESTDIR),$(installed))))
	install -m 755 $B/rigami $(DESTDIR)$(bindir)/rigami
	install -m 644 include/rigami.h $(DESTDIR)$(includedir)/rigami.h
	for l in rigami rigami-core; do \
	    install -m 644 $B/lib$$l.a $(DESTDIR)$(libdir)/lib$$l.a && \
	    install -m 755 $B/lib$$l.$(so) $(DESTDIR)$(libdir)/$(call so_at,$$l,$(VERSION)) && \
	    ln -sf $(call so_at,$$l,$(VERSION)) $(DESTDIR)$(libdir)/$(call so_at,$$l,$(SOVERSION)) && \
	    ln -sf $(call so_at,$$l,$(SOVERSION)) $(DESTDIR)$(libdir)/lib$$l.$(so) || exit 1; \
	done
	sed $(call filled,rigami,,$(libs),) rigami.pc.in >$(DESTDIR)$(libdir)/pkgconfig/rigami.pc
	sed $(call filled,rigami-core,: folds without files and pictures,$(core_libs),-DRIGAMI_CORE) rigami.pc.in >$(DESTDIR)$(libdir)/pkgconfig/rigami-core.pc
	sed -e 's|@version@|$(VERSION)|' -e 's|@includedir@|$(includedir)|' -e 's|@core_libs@|$(core_libs)|' -e 's|@libs@|$(strip $(libs))|' \
	    -e 's|@so_before@\(.*\)@so_after@|$(call so_at,\1,$(SOVERSION))|' \
	    tools/install/rigamiConfig.cmake.in >$(DESTDIR)$(cmakedir)/rigamiConfig.cmake
	sed -e 's|@version@|$(VERSION)|' tools/install/rigamiConfigVersion.cmake.in >$(DESTDIR)$(cmakedir)/rigamiConfigVersion.cmake
	install -m 644 docs/rigami.1 $B/rigami-fold.1 $(DESTDIR)$(mandir)/man1
	install -m 644 docs/librigami.3 $(DESTDIR)$(mandir)/man3
	install -m 644 tools/install/rigami.bash $(DESTDIR)$(bashdir)/rigami
	install -m 644 tools/install/rigami.zsh $(DESTDIR)$(zshdir)/_rigami
	install -m 644 tools/install/rigami.fish $(DESTDIR)$(fishdir)/rigami.fish
# The loader keeps a list of what there is; a package does so when it is unpacked.
	@if [ -z '$(DESTDIR)' ] && [ "$$(id -u)" = 0 ] && command -v ldconfig >/dev/null; then ldconfig; fi

# Its options are those that the program says it has.
$B/rigami-fold.1: docs/rigami-fold.1 tools/install/manual.awk $B/rigami
	@$B/rigami help fold | awk -f tools/install/manual.awk docs/rigami-fold.1 - >$@

uninstall:
	rm -f $(addprefix $(DESTDIR),$(installed))

# Programs with nothing but the installed files: C, C++, CMake, Python, examples, completion.
install-check: build
	@CC='$(CC)' MAKE='$(MAKE)' sh tools/check_install $B

clean:
	rm -rf build rigami

.PHONY: all build test demo run-tests run-demo bench run-bench check werror everything without layers equations outputs header format pictures figures corpus install uninstall install-check clean
include tools/checks.mk
.SECONDARY:
-include $(shell find $A $B -name '*.d' 2>/dev/null)
