/* fuzz.h -- what the targets of libFuzzer share. `tools/fuzz` builds and runs them.
 *
 * A target is handed bytes and does with them what a caller would. Beside what the sanitizers see, it aborts when a promise is broken:
 * a status that is none, a refusal without a reason, a number that is not finite, more time than `watch` allows. */
#ifndef FUZZ_H
#define FUZZ_H

#include "rigami.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/* Aborts, so that libFuzzer keeps the input. */
#define promise(kept) ((kept) ? (void)0 : broken(#kept, __FILE__, __LINE__))
void broken(const char *what, const char *file, int line);

/* Processor time, so that a busy machine finds nothing: more than `seconds` between the two is a hang. */
void watch_begin(void);
void watch_end(double seconds);

/* RG_OK, or a refusal that a user can do something with: a status that the callee may give, and one line of words. */
void sound(rg_status s, const rg_diag *why);

/* Numbers in a row, the same for the same start; a text gives a start too, so that an input carries its settings with it. */
typedef struct dice { uint64_t state; } dice;
dice dice_of(const uint8_t *data, size_t size);
uint64_t dice_next(dice *d);
static inline size_t dice_below(dice *d, size_t n) { return (size_t)(dice_next(d) % n); }

/* A file in memory, or in TMPDIR where there is no such place, that is gone when the target ends; `path` of that extension. */
const char *scratch(const char *name);
void scratch_write(const char *path, const uint8_t *data, size_t size);

/* Structure-aware: by the text's own pieces (numbers, values, elements, lines), */
size_t mutate_text(uint8_t *data, size_t size, size_t most, dice *d);
/* or as lines on a sheet, written anew as .opx or .fold; 0: these are none. */
size_t mutate_lines(uint8_t *data, size_t size, size_t most, dice *d);

#endif
