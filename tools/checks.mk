# Further checks: fuzzing, mutants, coverage, threads, memory, and what compilers and linters say. Included by the Makefile.

# ------------------------------------------------------------------------------------------------ fuzz
# seconds=N: of each target.   target=NAME: only that one.
fuzz_c   := $(sort $(wildcard tests/fuzz/read_*.c)) tests/fuzz/convert.c tests/fuzz/fold.c
fuzz_bin := $(fuzz_c:%.c=$B/%)
fuzz_help := $(addprefix $B/tests/fuzz/,fuzz.o text.o lines.o)

$B/tests/fuzz/%: $B/tests/fuzz/%.o $(fuzz_help) $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -fsanitize=fuzzer -o $@ $^ $(libs) $(LDLIBS)
$B/tests/fuzz/%.o: cppflags += -Itests/fuzz

fuzz-targets: $(fuzz_bin) $B/rigami

fuzz:
	@$(setup) check
	@$(MAKE) --no-print-directory $(jobs) config=fuzz CC=clang fuzz-targets
	@sh tools/fuzz build/fuzz-clang $(or $(seconds),600) $(target)
.PHONY: fuzz fuzz-targets
