# Further checks: coverage, threads, memory, what linters say, fuzzing, mutants. Included by the Makefile; docs/reliability.md says what
# each of them promises.

# ------------------------------------------------------------------------------------- addresses, and coverage

# Lines that the tests must run through, percent: of src/, and of the readers, which see what others write.
floor         := 90
floor_readers := 95

# One build and one run for both: the tests under the sanitizers are also those whose lines are counted. What was counted before is taken away.
asan:
	@$(MAKE) --no-print-directory $(jobs) config=asan all-tests
	@find build/asan -name '*.gcda' -exec rm -f {} +
	@GCOV_ERROR_FILE=/dev/null $(MAKE) --no-print-directory config=asan run-tests
	@$(MAKE) --no-print-directory config=asan coverage-table
all-tests: build $(test_bin)

coverage-table:
	@for o in $(lib_o); do gcov -n -o $$o $$o 2>/dev/null; done | sh tools/check_coverage $(floor) $(floor_readers)

# ------------------------------------------------------------------------------------------- threads, memory

# Those in which several threads fold: tries that race, and folds that share what they know. tsan_tests=all: every one, in a quarter of an hour.
tsan_tests ?= test_attempt test_stepping test_threads
tsan_bin    = $(if $(filter all,$(tsan_tests)),$(test_bin),$(tsan_tests:%=$B/tests/%))

tsan:
	@$(MAKE) --no-print-directory $(jobs) config=tsan run-tsan
run-tsan: $(tsan_bin)
	@TSAN_OPTIONS=halt_on_error=1 sh tools/run_tests $(tsan_bin)

# Locks and what they guard, as valgrind sees them; what glibc does with stacks of threads that ended is not ours.
helgrind: $B/tests/test_threads
	@valgrind --tool=helgrind -q --error-exitcode=9 --suppressions=tests/helgrind.supp $B/tests/test_threads

# Under valgrind a test takes some thirty times as long: those of reading, planarising, the mesh and the constraint.
valgrind_tests ?= bad read_cp read_dxf read_fold read_svg opx ori xml json number mesh constraint coupled limit loop turn pose project
valgrind: build
	@sh tools/check_valgrind $B/rigami
valgrind-long: build $(valgrind_tests:%=$B/tests/test_%)
	@sh tools/check_valgrind $B/rigami $(valgrind_tests:%=$B/tests/test_%)

# ------------------------------------------------------------------------------------------------------ lint

lint: $A/made/write/page.h
	@sh tools/check_lint quick $(cppflags) -I$A/made -std=c11
lint-deep: $A/made/write/page.h
	@sh tools/check_lint deep $(cppflags) -I$A/made -std=c11

# ------------------------------------------------------------------------------------------------------ fuzz

# seconds=N: of each target.   target="NAME ...": only those.
fuzz_c    := $(sort $(wildcard tests/fuzz/read_*.c)) tests/fuzz/convert.c tests/fuzz/fold.c
fuzz_bin  := $(fuzz_c:%.c=$B/%)
fuzz_help := $(addprefix $B/tests/fuzz/,fuzz.o text.o lines.o)

$B/tests/fuzz/%: $B/tests/fuzz/%.o $(fuzz_help) $B/librigami.a
	$(call say,link,$@)
	$Q$(link) -fsanitize=fuzzer -o $@ $^ $(libs) $(LDLIBS)
$B/tests/fuzz/%.o: cppflags += -Itests/fuzz
# What numbers are compared with tells a fuzzer nothing of the input, and takes half of the time.
ifeq ($(config),fuzz)
$A/src/linalg/%.o $A/src/kinematics/%.o: cflags += -fno-sanitize-coverage=trace-cmp
endif

fuzz-targets: $(fuzz_bin)

fuzz:
	@$(setup) check
	@sh tools/fuzz can || exit 0; \
	 $(MAKE) --no-print-directory $(jobs) build && $(MAKE) --no-print-directory $(jobs) config=fuzz CC=clang fuzz-targets && \
	 sh tools/fuzz build/fuzz-clang $B/rigami $(or $(seconds),600) $(target)
# As much as a change can wait for, and the same each time.
fuzz-smoke:
	@$(MAKE) --no-print-directory fuzz seconds=smoke

# --------------------------------------------------------------------------------------------------- mutants

mutants:
	@$(setup) check
	@$(MAKE) --no-print-directory $(jobs) CC=gcc build/release/librigami.a $(tests:%.c=build/release/%)
	@$(MAKE) --no-print-directory $(jobs) CC=gcc config=coverage build/coverage/librigami.a $(tests:%.c=build/coverage/%)
	@CC=gcc tools/mutants $(MUTANTS)

# --------------------------------------------------------------------------------------------------- at length

# The whole table of tests/test_faults.c: 20 moments of each signal, 20 sizes of memory.
faults-long: build $B/tests/test_faults
	@RIGAMI_FAULTS=20 RIGAMI=$B/rigami $B/tests/test_faults

# What does not fit into the time that a change can wait for. Hours.
check-long: check
	@for part in debian lint-deep "tsan tsan_tests=all" valgrind-long faults-long "fuzz seconds=60" mutants; do \
	    echo "== $$part"; $(MAKE) --no-print-directory $(jobs) $$part >build/check.log 2>&1 || \
	        { cat build/check.log; echo "check-long: $$part FAILED"; exit 1; }; \
	    grep '^SKIPPED' build/check.log; tail -n 1 build/check.log; \
	done
	@echo "check-long: all parts passed"

.PHONY: asan all-tests coverage-table tsan run-tsan helgrind valgrind valgrind-long faults-long lint lint-deep fuzz fuzz-targets fuzz-smoke mutants check-long
