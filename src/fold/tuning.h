/* tuning.h -- every number that the steppers and the ladder are set by, once, with its reason.
 * Uses  vec.h        Used by  fold, motion
 *
 * Those of the relaxation and the ladder are measured on real patterns by many authors, each rung alone; docs/method.md
 * says what they are for. Those of straight motions are measured by `make bench` and `make stability`; docs/speed.md
 * says what was tried. */
#ifndef RG_TUNING_H
#define RG_TUNING_H

#include "base/vec.h"
#include <stdint.h>

/* --------------------------------------------------------------------------------------------- any stepper ---- */

/* A step has closed after so many corrections, or does not; off flat paper, where they converge to first order only,
 * after twice as many. */
static const int32_t CORRECTIONS = 12, CORRECTIONS_OFF_FLAT = 24;
/* So many corrections in a row that leave more than this part of the least there was lead nowhere. Where vertices move
 * as well, and equations nearly depend on each other, it goes up and down for three or four before it closes. */
static const double BETTER_CLOSED = 0.7;
static const int32_t MOST_POOR = 3, MOST_POOR_MOVING = 5;
/* While it is Newton's own rate, each leaves at most this part of what was open. One that leaves more has come down to
 * rounding, if it closes; if not, to what the matrix of another state, or a symmetry, does not reach. */
static const double STILL_CLOSES = 0.1;
/* More than this is open, radians, and nothing is near. */
static const double MOST_OPEN = 2.5;
/* Rounding leaves some 1e-15 at a vertex. What closes to the tolerance asked for is corrected down to this as long as
 * that is quick, since angles are off by more than closure is: by its ratio to the slowest mode. */
static const double ROUNDING = 1e-13;
/* Progress that is held, as one more row, is met to this; a percent is exact to a hundred times that. */
static const double SAME_PROGRESS = 1e-12;
/* A correction longer than this part of the step that it corrects has left the branch. At a start where directions are
 * right to first order only, more is allowed; and anywhere, a little: radians, where a step is long against what is
 * between branches, and where it is not. */
static const double FARTHEST_CORRECTION = 0.3, FARTHEST_AT_START = 0.7, LITTLE = 1e-3, LITTLE_STRAIGHT = 1e-6;
/* A way that this part of it is left over of, when the constraint has had its own, leads on. */
static const double LEAST_EFFICIENCY = 1e-5;
/* A step shorter than this part of the whole way is none. */
static const double SHORTEST = 1e-6;
/* So often creases that a step takes past half a turn are held and the step is made anew. */
static const int32_t ROUNDS = 6;
/* Within this part of its way a crease counts as arrived: the exit status's 1 %. */
static const double ARRIVED = 0.01;
/* Vertices that resist at least so hard against the hardest are named, so many at most. */
static const double AS_STRONG = 0.5;
static const int32_t MOST_BLAMED = 12;

/* --------------------------------------------------------------------------------------------- straight on ---- */

/* What solves leave, against what they begin with: directions, which make the path, and corrections, which the next one
 * goes on from: those gain as much at the least where Newton's own rate does not gain more. Where there is one
 * correction only, what it leaves is looked at anyway: the factor is used once. Of a node where closing says nothing of
 * where along its freedoms the sheet goes: this part of what it is set right by. */
static const double DIRECTION_SOLVED = 1e-10, CORRECTION_SOLVED = 1e-5, CORRECTION_SOLVED_NEAR = 1e-4, SOLVED_ONCE = 1;
static const double FREE_SOLVE_PART = 0.1;
/* A factor is kept while no crease has moved farther than this since it was made. It is off by as much, against slow
 * modes of 1e-4 or so; and with more equations than creases those that say the same thing twice no longer agree, which
 * the factor takes for a mode of that size, to be seen beside the square root of its beta. */
static const double SAME_FACTOR = 1e-4, SAME_FACTOR_OVERCONSTRAINED = 1e-6;
/* Where there are more equations than creases they must agree this well, or what is open at vertices holds the
 * sheet. */
static const double LOOSEST_OVERCONSTRAINED = 1e-6;

/* The first step off the flat state, as mean angle: far above rounding, where the branches are apart, and far below
 * where they bend. What has turned by less than the second, radians, is flat; what closes there with a crease farther
 * off than the third has not just left it: a whole turn closes, too. */
static const double FIRST_ANGLE = 0.01, IS_FLAT = 1e-9, FARTHEST_OFF_FLAT = RG_PI / 2;
/* So many starts are tried; each time creases on the wrong side, and those that turn by less than this part of the mean
 * on the right one, are asked for so much louder. Of those on the wrong side none counts for more than so many of the
 * mean, and one that turns by less than this part of it is locked. Between, so many slides along the branches of one
 * component, by this part of what the wish is. */
static const int32_t MOST_STARTS = 24, SLIDES = 12;
static const double LOUDER = 1.8, HARDLY_RIGHT = 0.02, HARDLY_TURNS = 1e-6, MOST_WRONG = 1e3, SLIDE_GAIN = 0.5;

/* The polynomial between nodes must close this much better than asked for. Where the sheet can go one way only its
 * angles are off by closure over the slowest mode, and could be exact: so much better there, and between fixed steps,
 * which are that exact. */
static const double READ_OFF_MARGIN = 0.5, READ_OFF_MARGIN_ONE_WAY = 1e-3;
/* And steps are planned for this part of that. */
static const double STEP_MARGIN = 0.3;
/* A prediction that closes to this is near enough for one factorisation there to serve the node. */
static const double GOOD_PREDICTION = 1e-5, POOR_PREDICTION = 1e-2;
/* The next step against this one. */
static const double LARGEST_GROWTH = 2.5, LARGEST_CUT = 0.2;
/* Every so many nodes it is asked again whether the sheet can go one way only: whether closing undoes all but this
 * part of what Adams's formula moves. */
static const int32_t ASK_AGAIN = 8;
static const double ONE_WAY = 1e-2;
/* Adams's formula moves less than this: rounding, which is not worth a correction. */
static const double SET_RIGHT_FROM = 1e-13;
/* And this far it may move along the paper's motions without the direction being asked for again. */
static const double SAME_DIRECTION = 1e-7;
/* What it should move, radians, for the motion to be true to some tenth of that: so many times the root of the
 * tolerance, as the tolerance is one of closure, and most who ask for little there do not ask for another motion. */
static const double GOOD_SET_RIGHT = 10, MOST_SET_RIGHT = 5e-4;
/* More than so many times that is no correction: the step was too long. */
static const double FARTHEST_SET_RIGHT = 10;
/* Where the sheet can go several ways nodes are put on a grid of so many parts of the way as soon as steps come down to
 * it, which makes them even; and the 60 frames that a motion has unless others are asked for lie on nodes. */
static const int32_t GRID = 59;
/* All creases this near to their targets, radians, are put there, if that closes: the wish has no direction at the end
 * itself. */
static const double LANDING = 0.01;
/* A wish points straight at its targets; so near to them, in progress, it no longer grows. */
static const double NEAREST_TARGET = 1e-3;
/* How strongly a limit pulls, per step; and how often again, where more than this is left, radians. */
static const double LIMIT_GAIN = 0.5, LITTLE_PULL = 1e-3;
static const int32_t MOST_PULLS = 12;
/* Past half a turn by more than this, radians, is beyond it. */
static const double PAST = 1e-9;
/* Steps at the most, whatever they are; and so many times what half a turn takes by the largest. */
static const double MOST_STRAIGHT_STEPS = 20000, MOST_STRAIGHT_WAYS = 8;
/* So many steps must gain this much of the way or, where they are small by order, this part of what they could or,
 * graded, of what lies behind or before them: a motion that only creeps is over. */
static const int32_t MOST_CREEPING = 60;
static const double LEAST_WAY = 1e-3, LEAST_WAY_PART = 0.01;

/* ---------------------------------------------------------------------------------------------- relaxation ---- */

/* Progress below which creases may be beyond a limit or on the wrong side: the flat start, where the linear step must
 * be free to be wrong for a moment. */
static const double FREE_UNTIL = 0.03, WRONG_FROM = 0.02;
/* A crease this near its target (radians) slows down; how much of what is left it wishes for in a full step. */
static const double NEAR = 0.03, NEAR_PART = 0.9;
/* Part of the way back to where it wishes to be that the pattern goes in a step of the usual length, radians; in
 * shorter ones it is less. */
static const double USUAL_STEP = 5 * RG_DEG;
static const double RETURN = 0.5;
/* What a held crease gives way, against any other; how far beyond half a turn one may be, radians. */
static const double HELD_GIVES = 3e-4, BEYOND = 0.05 * RG_DEG;
/* How readily a crease on the wrong side of flat gives way: it stands by its wish, so that the others have to. */
static const double WRONG_GIVES = 0.25;
/* How readily a crease beyond its limit gives way, and the part of the way back it wishes for. */
static const double BEYOND_GIVES = 0.1, BACK = 0.3;
/* So many halvings end, from flat paper, in a step so short that it closes to tolerance as it is: what is wrong with
 * its direction is of second order there, and is worked off by the steps that follow. */
static const int32_t HALVINGS = 16;
/* What one changes by less than this part is out of its reach. */
static const double OUT_OF_REACH = 0.01;
/* Near a singular state a correction leaves a quarter of the residual; of what leads there no more than that is waited
 * for. */
static const int32_t CORRECTIONS_AT_END = 40, CORRECTIONS_TOWARDS = 20;
/* Whatever step is asked for: a longer one would find closed states that nothing leads to. */
static const double MOST_STEP = 10 * RG_DEG;
/* No facet shrinks below this part of its area; and what is left of the readiness of a vertex where none is left. */
static const double LEAST_AREA = 0.1, LEAST_READY = 1e-3;
/* Part of the wished progress that a step makes at least, where the constraint allows any. */
static const double LEAST_GAIN = 0.01;
/* Where its image is closed, a vertex is open by no more than so many times what directions are off their images, a sum
 * over its edges. If that is within tolerance, one vertex of each orbit tells all, and what is solved is one of each
 * orbit; of other drawings, steps and corrections are averaged. */
static const double OF_THE_DRAWING = 30;
/* Even corrections go on while they close at Newton's rate. Then creases give way this much less than vertices: what
 * closing by the creases does not reach, or what a drawing is uneven by and is then closed vertex by vertex, takes ways
 * of the pattern too small to be seen, while near flat creases would turn by its square root. */
static const double STIFF = 0.01;
/* Part of what is open that a solve may leave, in the metric of its preconditioner: the next correction mends it. */
static const double SOLVED = 1e-9;
static const double LEAST_STEP = 1e-7, LEAST_H = 1e-4;
/* A run that for so many steps of the usual length betters neither the mean nor the least by so much is stuck. */
static const double MOST_IDLE = 25;
static const double BETTER_MEAN = 0.002, BETTER_LEAST = 0.01;
/* So many steps of the usual length may pass before one is slow, and the whole way may take so many: it must be as far
 * as an even pace between the two. Of 690 runs that arrived none was slower than 1.5 times that, and one took 171. */
static const double SLOW_FROM = 30, MOST_STEPS = 180;
/* From so many steps the work of one is known. */
static const int32_t KNOWN_FROM = 5;
/* Where states between nodes are closed, it is damped by so much of what is open, radians (Yamashita and Fukushima, "On
 * the rate of convergence of the Levenberg-Marquardt method", 2001). A sheet may have more ways than its equations say,
 * as symmetric ones have: where it is closed some equations follow from others, and beside that they almost do. What is
 * off by d would be led astray by as much there, and to another place a little farther on. */
static const double DAMPING = 0.1;
/* Where creases are held and a correction leaves more than this part of what was open, it is damped so much less from
 * then on: what has to give way hardly does. */
static const double HARDLY_CLOSES = 0.5, LESS_DAMPING = 0.1;
/* A path is smooth where the middle of a part of a chord, closed, lies within this much of the chord from the middle of
 * its ends; so often it is halved to find out. */
static const double SMOOTH = 0.02;
static const int32_t MOST_HALVES = 4;
/* Nodes of a path, at most, however short its steps are. */
static const int32_t MOST_NODES = 12000;
/* A relaxation lands from a little nearer than a crease counts as arrived, and from where the pattern is within that
 * part of its reach. */
static const double LANDS_FROM = 0.007, RETURNED = 0.05;
/* Near a singular end what closes is homogeneous: each node is this much nearer to it, or less so where the path
 * between two would not be smooth, but no less than that, until they are that near; so many at most. */
static const double NEARER = 0.5, HARDLY_NEARER = 0.9, NEAR_ENOUGH = 0.04;
static const int32_t END_NODES = 20;
/* Part of the tolerance that it is closed to. */
static const double CLOSE_ENOUGH = 0.01;
/* Part of the wish for progress that must be left over for it to be held as one more row. */
static const double LEAST_LEFT = 1e-6;
/* A pattern that is kept moves so little. */
static const double LEAST_COMPLIANCE = 1e-6;
/* Ways of the pattern that count as none; and how far from where it should be a crease may end for the pattern to
 * close. */
static const double FIXED = 1e-12, END_OFF = 1 * RG_DEG;

/* ---------------------------------------------------------------------------------------- ends and attempts ---- */

/* Beyond half a turn, facets at a crease pass through each other: a motion ends before it is so by MOST_OVER, and one
 * that is so by more than OVERFOLD is second best. */
static const double MOST_OVER = 1 * RG_DEG, OVERFOLD = 0.1 * RG_DEG;
/* A pattern that has to be moved by more of the sheet's size to close is not the one drawn: what rounding of drawings
 * comes to. */
static const double ON_THE_PATTERN = 1e-4;
/* A crease that did less than this part of its way has not left flat. */
static const double LEFT_FLAT = 1e-6;

/* ------------------------------------------------------------------------------------------------- ladder ---- */

/* Work of one try, about seconds of a slow machine, by effort. Of 97 real patterns that fold none needs more than 3.9
 * for it. */
static const double MOST_WORK[] = {4, 8, 300};
/* Where no try folds, those that were ended early share so many times that; one that comes back from the folded end
 * if it has come so far. */
static const double MORE_WORK = 2, HALF_WAY = 0.5;
/* What folds straight on, triangulated, takes a hundred steps or so. */
static const int32_t MOST_STEPS_TRIANGULATED = 250;
/* Retraction: how often half the compliance is tried, and fewer cuts, of a relaxation and straight on. A facet that
 * bends by less (radians) may stay whole, if no vertex goes much farther. */
static const int32_t LESS_COMPLIANCE[] = {0, 2, 5}, FEWER_CUTS[] = {0, 3, 8}, FEWER_STRAIGHT[] = {0, 8, 24};
/* Work of such a try, against what it is to better: one that takes much more folds less plainly, or not. */
static const double RETRIED_WORK = 2;
static const double HARDLY_BENT = 10 * RG_DEG, LITTLE_MORE = 1.1;
/* Short of the end, what moves the pattern must come this much farther than what leaves it as it is. */
static const double WORTH_MOVING = 0.1;
/* A second try beside the first costs its memory as well: not for larger sheets. */
static const int32_t MOST_CREASES_AT_ONCE = 20000;

#endif
