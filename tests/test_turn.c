/* pose/turn.h: quaternions turn as the matrix does, and do not jump from frame to frame. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "pose/turn.h"

/* Rotation about a unit vector, by its definition: what lies along u stays, what is across turns. */
static rg_vec3 turn_about(rg_vec3 u, double angle, rg_vec3 v)
{
    const rg_vec3 along = rg_vec3_scale(rg_vec3_dot(u, v), u), across = rg_vec3_sub(v, along);
    return rg_vec3_add(along, rg_vec3_axpy(cos(angle), across, rg_vec3_scale(sin(angle), rg_vec3_cross(u, v))));
}

static rg_mat3 matrix(rg_vec3 u, double angle)
{
    return (rg_mat3){{turn_about(u, angle, (rg_vec3){1, 0, 0}), turn_about(u, angle, (rg_vec3){0, 1, 0}),
                      turn_about(u, angle, (rg_vec3){0, 0, 1})}};
}

static rg_vec3 turned(rg_turn q, rg_vec3 v)
{
    const rg_vec3 u = {q.x, q.y, q.z}, t = rg_vec3_axpy(q.w, v, rg_vec3_cross(u, v));
    return rg_vec3_axpy(2, rg_vec3_cross(u, t), v);
}

/* Twice round about any axis: past half a turn, where the larger components take over from w, and past a whole one. */
static void it_turns_and_does_not_jump(void **state)
{
    (void)state;
    unsigned seed = 1125;
    enum { STEPS = 720 };
    for (int axis = 0; axis < 50; axis++) {
        rg_vec3 u = {noise(&seed), noise(&seed), noise(&seed)};
        if (axis < 3) u = (rg_vec3){axis == 0, axis == 1, axis == 2};
        u = rg_vec3_scale(1 / rg_vec3_length(u), u);
        rg_turn before = {0, 0, 0, 1};
        for (int k = 0; k <= STEPS; k++) {
            const double angle = 4 * RG_PI * k / STEPS;
            const rg_mat3 R = matrix(u, angle);
            const rg_turn q = rg_turn_from_matrix(&R, before);
            const rg_vec3 v = {1.25, -2.385, 0.7};
            below(rg_vec3_length(rg_vec3_sub(turned(q, v), rg_mat3_mul_vec(R, v))), 1e-14);
            near(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-15);
            near(q.w, cos(angle / 2), 1e-14);
            if (k > 0) near(q.x * before.x + q.y * before.y + q.z * before.z + q.w * before.w, cos(RG_PI * 2 / STEPS), 1e-12);
            before = q;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_turns_and_does_not_jump)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
