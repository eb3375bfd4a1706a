# make            the library and the command line        make demo      set up, build, fold a pattern, say where it is
# make test       set up, build, run every test           make check     everything a change must pass
# make bench      ratios of speed                         make install   prefix=/usr/local DESTDIR=
# config=release|debug|asan|coverage   GL=osmesa|egl|none   GPL=1|0   CC=gcc|clang   WERROR=0|1
config  ?= release
GL      ?= osmesa
GPL     ?= 1
WERROR  ?= 0
prefix  ?= /usr/local
VERSION := 0.1.0
SOVERSION := 0

B := build/$(config)$(if $(filter-out osmesa,$(GL)),-gl-$(GL))$(if $(filter 0,$(GPL)),-nogpl)$(if $(filter clang%,$(CC)),-clang)

pkgs := libxml-2.0 jansson libpng
gl_osmesa := osmesa
gl_egl    := egl gl
ifeq ($(filter $(GL),osmesa egl none),)
$(error GL is one of osmesa, egl, none)
endif
pkgs += $(gl_$(GL))

CPPFLAGS += -Iinclude -Isrc -D_POSIX_C_SOURCE=200809L -DRG_GL_$(GL)=1 $(shell pkg-config --cflags $(pkgs) 2>/dev/null)
CFLAGS   ?= -O2 -g
CFLAGS   += -std=c11 -fPIC -fvisibility=hidden -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes \
            -Wmissing-prototypes -Wvla -Wpointer-arith -Wwrite-strings
LDLIBS   += $(shell pkg-config --libs $(pkgs) 2>/dev/null) -lpthread -lm
ifeq ($(GPL),1)
CPPFLAGS += -DRG_GPL=1 -I/usr/include/suitesparse
LDLIBS   := -lcholmod -lsuitesparseconfig -lgsl -lgslcblas $(LDLIBS)
endif
ifeq ($(WERROR),1)
CFLAGS   += -Werror
endif
ifeq ($(config),debug)
CFLAGS   += -O0
else ifeq ($(config),asan)
CFLAGS   += -O1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS  += -fsanitize=address,undefined
else ifeq ($(config),coverage)
CFLAGS   += -O0 --coverage
LDFLAGS  += --coverage
endif

src   := $(sort $(wildcard src/*/*.c))
cmd   := $(sort $(wildcard tools/rigami.c tools/cmd_*.c))
tests := $(sort $(wildcard tests/test_*.c))
bench := $(sort $(wildcard tests/bench/*.c))
lib_o := $(src:%.c=$B/%.o)
cmd_o := $(cmd:%.c=$B/%.o)

all: $B/librigami.a $B/librigami.so $B/rigami
	@ln -sfn $B/rigami rigami

$B/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<

$B/librigami.a: $(lib_o)
	@rm -f $@
	ar rcs $@ $^

$B/librigami.so: $(lib_o)
	$(CC) $(LDFLAGS) -shared -Wl,-soname,librigami.so.$(SOVERSION) -Wl,--no-undefined -o $@ $^ $(LDLIBS)

$B/rigami: $(cmd_o) $B/librigami.a
	$(CC) $(LDFLAGS) -o $@ $^ $(LDLIBS)

# Tests see the library's inside, so they link the archive.
$B/tests/test_%: $B/tests/test_%.o $B/librigami.a $B/rigami
	$(CC) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) -lcmocka $(if $(filter 1,$(GPL)),-lgsl -lgslcblas) $(LDLIBS)

$B/tests/bench/%: $B/tests/bench/%.o $B/librigami.a
	$(CC) $(LDFLAGS) -o $@ $^ $(LDLIBS)

clean:
	rm -rf build rigami

.PHONY: all clean
.SECONDARY:
-include $(shell find build -name '*.d' 2>/dev/null)
