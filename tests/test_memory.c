/* base/memory.c: sizes that overflow, memory that runs short, arrays that grow. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"

/* An allocator that counts what is out and refuses once `left` requests are through. */
typedef struct counted { int left, out; size_t asked; } counted;

static void *counted_resize(void *ctx, void *block, size_t bytes)
{
    counted *c = ctx;
    if (bytes == 0) {
        c->out -= block != NULL;
        free(block);
        return NULL;
    }
    c->asked = bytes;
    if (c->left-- <= 0) return NULL;
    void *p = realloc(block, bytes);
    c->out += p && !block;
    return p;
}

static void arrays_are_zeroed(void **state)
{
    (void)state;
    counted c = {100, 0, 0};
    rg_memory mem = {counted_resize, &c};
    unsigned char *p = rg_mem_array(&mem, 1237, 3);
    assert_non_null(p);
    assert_true(c.asked >= 1237 * 3);
    for (int i = 0; i < 1237 * 3; i++) assert_int_equal(p[i], 0);
    rg_mem_free(&mem, p);
    rg_mem_free(&mem, NULL);
    assert_int_equal(c.out, 0);
}

static void an_empty_array_is_a_block(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    void *p = rg_mem_array(&mem, 0, sizeof(double)), *q = rg_mem_array(&mem, 5, 0);
    assert_non_null(p);
    assert_non_null(q);
    rg_mem_free(&mem, p);
    rg_mem_free(&mem, q);
}

static void sizes_that_overflow_never_reach_the_allocator(void **state)
{
    (void)state;
    counted c = {100, 0, 0};
    rg_memory mem = {counted_resize, &c};
    /* The product of each pair wraps round to something small or to the largest size itself. */
    const size_t pair[][2] = {{SIZE_MAX, 2}, {SIZE_MAX / 2 + 1, 2}, {SIZE_MAX / 8 + 1, 8}, {SIZE_MAX, 1}, {1, SIZE_MAX}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        assert_null(rg_mem_array(&mem, pair[i][0], pair[i][1]));
        void *block = NULL;
        size_t room = 0;
        assert_int_equal(rg_mem_grow(&mem, &block, &room, pair[i][0], pair[i][1]), RG_ENOMEM);
        assert_null(block);
        assert_int_equal(room, 0);
    }
    assert_int_equal(c.asked, 0);
}

static void growing_keeps_what_is_there(void **state)
{
    (void)state;
    counted c = {1000, 0, 0};
    rg_memory mem = {counted_resize, &c};
    void *block = NULL;
    size_t room = 0, moves = 0;
    for (size_t n = 0; n < 5000; n++) {
        size_t before = room;
        assert_int_equal(rg_mem_grow(&mem, &block, &room, n + 1, sizeof(int32_t)), RG_OK);
        assert_true(room > n);
        moves += room != before;
        ((int32_t *)block)[n] = (int32_t)(7 * n + 3);
    }
    for (size_t n = 0; n < 5000; n++) assert_int_equal(((int32_t *)block)[n], (int32_t)(7 * n + 3));
    assert_true(moves < 25); /* by half each time, not one by one */
    assert_int_equal(c.out, 1);
    rg_mem_free(&mem, block);
    assert_int_equal(c.out, 0);
}

static void growing_that_fails_changes_nothing(void **state)
{
    (void)state;
    counted c = {1, 0, 0};
    rg_memory mem = {counted_resize, &c};
    void *block = NULL;
    size_t room = 0;
    assert_int_equal(rg_mem_grow(&mem, &block, &room, 4, 1), RG_OK);
    memcpy(block, "fold", 4);
    void *was = block;
    size_t had = room;
    assert_int_equal(rg_mem_grow(&mem, &block, &room, had + 1, 1), RG_ENOMEM);
    assert_ptr_equal(block, was);
    assert_int_equal(room, had);
    assert_memory_equal(block, "fold", 4);
    assert_int_equal(rg_mem_grow(&mem, &block, &room, had, 1), RG_OK); /* there is room: nobody is asked */
    rg_mem_free(&mem, block);
    assert_int_equal(c.out, 0);
}

static void strings_are_copies(void **state)
{
    (void)state;
    counted c = {2, 0, 0};
    rg_memory mem = {counted_resize, &c};
    char text[] = "valley";
    char *copy = rg_mem_string(&mem, text), *empty = rg_mem_string(&mem, "");
    text[0] = 'g';
    assert_string_equal(copy, "valley");
    assert_string_equal(empty, "");
    assert_null(rg_mem_string(&mem, NULL));
    assert_null(rg_mem_string(&mem, text)); /* the third request is refused */
    rg_mem_free(&mem, copy);
    rg_mem_free(&mem, empty);
    assert_int_equal(c.out, 0);
}

static void the_default_is_there_when_none_is_given(void **state)
{
    (void)state;
    counted c = {1, 0, 0};
    rg_memory mine = {counted_resize, &c}, none = {NULL, NULL};
    assert_ptr_equal(rg_mem_default(&mine).ctx, &c);
    assert_true(rg_mem_default(NULL).resize == rg_mem_default(&none).resize);
    assert_true(rg_mem_default(NULL).resize != counted_resize);
}

static void arrays_are_made_together_or_not_at_all(void **state)
{
    (void)state;
    for (int left = 0; left <= 3; left++) {
        counted c = {left, 0, 0};
        rg_memory mem = {counted_resize, &c};
        double *x = (double *)&c;
        int16_t *i = (int16_t *)&c, (*pair)[2] = NULL;
        const rg_status s = RG_MEM_ARRAYS(&mem, RG_ARRAY(x, 11), RG_ARRAY(i, 0), RG_ARRAY(pair, 7));
        assert_int_equal(s, left < 3 ? RG_ENOMEM : RG_OK);
        assert_int_equal(c.out, left < 3 ? 0 : 3);
        assert_true((x != NULL) == (left == 3) && (i != NULL) == (left == 3) && (pair != NULL) == (left == 3));
        for (int k = 0; x && k < 11; k++) assert_true(x[k] == 0);
        for (int k = 0; pair && k < 7; k++) assert_true(pair[k][0] == 0 && pair[k][1] == 0);
        RG_MEM_FREE(&mem, x, i, pair);
        assert_int_equal(c.out, 0);
    }
}

static void copies_are_made_together_or_not_at_all(void **state)
{
    (void)state;
    double given[3] = {1.25, 2.385, -7};
    char word[] = "fold";
    for (int left = 0; left <= 2; left++) {
        counted c = {left, 0, 0};
        rg_memory mem = {counted_resize, &c};
        double *x = given;
        char *text = word;
        int32_t *none = NULL;
        const rg_status s = RG_MEM_COPIES(&mem, RG_ARRAY(x, 3), RG_ARRAY(none, 5), RG_ARRAY(text, sizeof word));
        assert_int_equal(s, left < 2 ? RG_ENOMEM : RG_OK);
        assert_null(none);
        assert_true((x != NULL) == (left == 2) && (text != NULL) == (left == 2));
        assert_true(x != given && text != word);
        if (x) assert_memory_equal(x, given, sizeof given);
        if (text) assert_string_equal(text, "fold");
        RG_MEM_FREE(&mem, x, none, text);
        assert_int_equal(c.out, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_are_zeroed),
        cmocka_unit_test(an_empty_array_is_a_block),
        cmocka_unit_test(sizes_that_overflow_never_reach_the_allocator),
        cmocka_unit_test(growing_keeps_what_is_there),
        cmocka_unit_test(growing_that_fails_changes_nothing),
        cmocka_unit_test(strings_are_copies),
        cmocka_unit_test(arrays_are_made_together_or_not_at_all),
        cmocka_unit_test(copies_are_made_together_or_not_at_all),
        cmocka_unit_test(the_default_is_there_when_none_is_given),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
