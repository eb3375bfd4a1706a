/* tuning.h -- every number that the relaxed stepper and the ladder are set by, once, with its reason.
 * Uses  vec.h        Used by  fold, motion
 *
 * Measured on real patterns by many authors, each rung alone; docs/method.md says what they are for. */
#ifndef RG_TUNING_H
#define RG_TUNING_H

#include "base/vec.h"
#include <stdint.h>

/* ---------------------------------------------------------------------------------------------- relaxation ---- */

/* Progress below which creases may be beyond a limit or on the wrong side: the flat start, where the linear step must be
 * free to be wrong for a moment. */
static const double FREE_UNTIL = 0.03, WRONG_FROM = 0.02;
/* A crease this near its target (radians) slows down; how much of what is left it wishes for in a full step. */
static const double NEAR = 0.03, NEAR_PART = 0.9;
/* Part of the way back to where it wishes to be that the pattern goes in a step of the usual length, radians; in shorter ones it is less. */
static const double USUAL_STEP = 5 * RG_DEG;
static const double RETURN = 0.5;
/* What a held crease gives way, against any other; how far beyond half a turn one may be, radians. */
static const double HELD_GIVES = 3e-4, BEYOND = 0.05 * RG_DEG;
/* How readily a crease on the wrong side of flat gives way: it stands by its wish, so that the others have to. */
static const double WRONG_GIVES = 0.25;
/* How readily a crease beyond its limit gives way, and the part of the way back it wishes for. */
static const double BEYOND_GIVES = 0.1, BACK = 0.3;
/* So many halvings end, from flat paper, in a step so short that it closes to tolerance as it is: what is wrong with its
 * direction is of second order there, and is worked off by the steps that follow. */
static const int32_t ROUNDS = 6, HALVINGS = 16, CORRECTIONS = 12;
/* So many corrections in a row that leave more than this part of the least there was lead nowhere. Where equations nearly depend on each
 * other it goes up and down for three or four before it closes. */
static const double BETTER_CLOSED = 0.7;
static const int32_t MOST_POOR = 5;
/* What one changes by less than this part is out of its reach. */
static const double OUT_OF_REACH = 0.01;
/* More than this is open, radians, and nothing is near. */
static const double MOST_OPEN = 2.5;
/* Near a singular state a correction leaves a quarter of the residual; of what leads there no more than that is waited for. */
static const int32_t CORRECTIONS_AT_END = 40, CORRECTIONS_TOWARDS = 20;
/* Whatever step is asked for: a longer one would find closed states that nothing leads to. */
static const double MOST_STEP = 10 * RG_DEG;
/* No facet shrinks below this part of its area; and what is left of the readiness of a vertex where none is left. */
static const double LEAST_AREA = 0.1, LEAST_READY = 1e-3;
/* Part of the wished progress that a step makes at least, where the constraint allows any. */
static const double LEAST_GAIN = 0.01;
/* A correction this much longer than the step it corrects, plus a little, has left the branch. At the free start, where
 * directions are right to first order only, more is allowed. */
static const double FARTHEST_CORRECTION = 0.3, FARTHEST_AT_START = 0.7, LITTLE = 1e-3;
/* Where its image is closed, a vertex is open by no more than so many times what directions are off their images, a sum over its
 * edges. If that is within tolerance, one vertex of each orbit tells all, and what is solved is one of each orbit; of other
 * drawings, steps and corrections are averaged. */
static const double OF_THE_DRAWING = 30;
/* Even corrections go on while each leaves at most this part of what was open. Then creases give way this much less than
 * vertices: what closing by the creases does not reach, or what a drawing is uneven by and is then closed vertex by vertex, takes
 * ways of the pattern too small to be seen, while near flat creases would turn by its square root. */
static const double STILL_CLOSES = 0.1, STIFF = 0.01;
/* Part of what is open that a solve may leave, in the metric of its preconditioner: the next correction mends it. */
static const double SOLVED = 1e-9;
static const double LEAST_STEP = 1e-7, LEAST_H = 1e-4;
/* A run that for so many steps of the usual length betters neither the mean nor the least by so much is stuck. */
static const double MOST_IDLE = 25;
static const double BETTER_MEAN = 0.002, BETTER_LEAST = 0.01;
/* So many steps of the usual length may pass before one is slow, and the whole way may take so many: it must be as far as an even pace
 * between the two. Of 690 runs that arrived none was slower than 1.5 times that, and one took 171. */
static const double SLOW_FROM = 30, MOST_STEPS = 180;
/* From so many steps the work of one is known. */
static const int32_t KNOWN_FROM = 5;
/* Where states between nodes are closed, it is damped by so much of what is open, radians (Yamashita and Fukushima, "On the rate of
 * convergence of the Levenberg-Marquardt method", 2001). A sheet may have more ways than its equations say, as symmetric ones
 * have: where it is closed some equations follow from others, and beside that they almost do. What is off by d would be led astray
 * by as much there, and to another place a little farther on. */
static const double DAMPING = 0.1;
/* Where creases are held and a correction leaves more than this part of what was open, it is damped so much less from then on: what has to
 * give way hardly does. */
static const double HARDLY_CLOSES = 0.5, LESS_DAMPING = 0.1;
/* A path is smooth where the middle of a part of a chord, closed, lies within this much of the chord from the middle of its ends; so often
 * it is halved to find out. */
static const double SMOOTH = 0.02;
static const int32_t MOST_HALVES = 4;
/* Nodes of a path, at most, however short its steps are. */
static const int32_t MOST_NODES = 12000;
/* Within this part of its way a crease counts as arrived: the exit status's 1 %. A relaxation lands from a little nearer, and from where
 * the pattern is within that part of its reach. */
static const double ARRIVED = 0.01, LANDS_FROM = 0.007, RETURNED = 0.05;
/* Near a singular end what closes is homogeneous: each node is this much nearer to it, or less so where the path between two would not
 * be smooth, but no less than that, until they are that near; so many at most. */
static const double NEARER = 0.5, HARDLY_NEARER = 0.9, NEAR_ENOUGH = 0.04;
static const int32_t END_NODES = 20;
/* Progress of a state that is read off is exact to this. */
static const double SAME_PROGRESS = 1e-9;
/* Part of the tolerance that it is closed to. */
static const double CLOSE_ENOUGH = 0.01;
/* Part of the wish for progress that must be left over for it to be held as one more row. */
static const double LEAST_LEFT = 1e-6;
/* A pattern that is kept moves so little. */
static const double LEAST_COMPLIANCE = 1e-6;
/* Ways of the pattern that count as none; and how far from where it should be a crease may end for the pattern to close. */
static const double FIXED = 1e-12, END_OFF = 1 * RG_DEG;

/* ---------------------------------------------------------------------------------------- ends and attempts ---- */

/* Beyond half a turn, facets at a crease pass through each other: a motion ends before it is so by MOST_OVER, and one that is so by more than
 * OVERFOLD is second best. */
static const double MOST_OVER = 1 * RG_DEG, OVERFOLD = 0.1 * RG_DEG;
/* A pattern that has to be moved by more of the sheet's size to close is not the one drawn: what rounding of drawings comes to. */
static const double ON_THE_PATTERN = 1e-4;
/* A crease that did less than this part of its way has not left flat. */
static const double LEFT_FLAT = 1e-6;

/* ------------------------------------------------------------------------------------------------- ladder ---- */

/* Work of one try, about seconds of a slow machine, by effort. Of 97 real patterns that fold none needs more than 3.9 for it. */
static const double MOST_WORK[] = {4, 8, 300};
/* What folds straight on, triangulated, takes a hundred steps or so. */
static const int32_t MOST_STEPS_TRIANGULATED = 250;
/* Retraction: how often half the compliance is tried, and fewer cuts, of a relaxation and straight on. A facet that bends by less
 * (radians) may stay whole, if no vertex goes much farther. */
static const int32_t LESS_COMPLIANCE[] = {0, 2, 5}, FEWER_CUTS[] = {0, 3, 8}, FEWER_STRAIGHT[] = {0, 8, 24};
/* Work of such a try, against what it is to better: one that takes much more folds less plainly, or not. */
static const double RETRIED_WORK = 2;
static const double HARDLY_BENT = 10 * RG_DEG, LITTLE_MORE = 1.1;
/* Short of the end, what moves the pattern must come this much farther than what leaves it as it is. */
static const double WORTH_MOVING = 0.1;
/* A second try beside the first costs its memory as well: not for larger sheets. */
static const int32_t MOST_CREASES_AT_ONCE = 20000;

#endif
