/* person.h: what a person surely touched, may have touched, and cannot have touched between two
 * poses, whatever they did there, in C99 and C++. What a bound is, and which to take:
 * docs/person.md. Units, frames, errors, memory and sizes of structs are as in foretouch.h; t is 0
 * at the step's earlier pose and 1 at its later one. */
#ifndef FORETOUCH_PERSON_H
#define FORETOUCH_PERSON_H

#include <foretouch/foretouch.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- How far the person may be from the model ---- */

/* What a body is taken to do between two poses. */
enum {
  FT_BETWEEN_CONSTANT_RATE = 0, /* each joint at a constant rate, as ft_query_step() has it */
  FT_BETWEEN_CUBIC = 1,         /* a curve that needs no later pose */
  FT_BETWEEN_CUBIC_LATE = 2     /* a curve that needs the pose after the step */
};

/* A claim of yours about one link. INFINITY: nothing is claimed. */
typedef struct ft_link_bound {
  double error;        /* of a pose, m */
  double acceleration; /* of person minus model within a step, m/s^2 */
  /* Instead, if less: a length, m, and a share of how much the poses around the step bend. */
  double follow_floor, follow_share;
  double speed; /* of the person where poses were lost, m/s */
  /* After the last pose, of person minus model: m/s and m/s^2. */
  double ahead_speed, ahead_acceleration;
} ft_link_bound;

/* Claims nothing, and no error. */
FT_API ft_status ft_link_bound_init(ft_link_bound* bound);
/* Reads one bound per link from a file of format "foretouch-bounds", or takes those of a preset of
 * docs/person.md, as "preset:optical", for one way between poses of this rate.
 * Errors: those of the file; a name that is not a link's; no entry for that way and rate. */
FT_API ft_status ft_bounds_read(const char* path, const ft_avatar* avatar, int32_t between,
                                double rate_hz, ft_link_bound* bounds, size_t capacity,
                                size_t* required);

/* ---- Asking ---- */

typedef struct ft_brackets ft_brackets;

typedef struct ft_bracket_options {
  uint32_t size;
  int32_t fidelity;  /* default FT_FIDELITY_LINK; _EXACT: of triangles, which are never certain */
  double resolution; /* instants are as near to the true ones as this, m; default 1e-5 */
  const ft_ignored_pair* ignored;
  size_t ignored_count;
  const ft_pair_rules* self; /* own links; NULL, the default: not asked */
  /* Per answer, as ft_query_options has it: once it is spent, what is open is possible. Default
   * UINT64_MAX: without limit. */
  uint64_t work_budget;
} ft_bracket_options;

FT_API ft_status ft_bracket_options_init(ft_bracket_options* options, size_t size);
/* `options` may be NULL. For one thread; keeps scene and avatar alive, the rules are copied. */
FT_API ft_status ft_brackets_create(const ft_scene* scene, const ft_avatar* avatar,
                                    const ft_bracket_options* options, ft_brackets** brackets);

/* The two poses of a step of `seconds`, above 0, and those around them: NULL where there is none
 * before or after, or it is not known yet. */
typedef struct ft_posed_step {
  uint32_t size;
  int32_t between; /* FT_BETWEEN_* */
  const ft_pose* before;
  const ft_pose* from;
  const ft_pose* to;
  const ft_pose* after;
  double seconds_before, seconds, seconds_after;
} ft_posed_step;

FT_API ft_status ft_posed_step_init(ft_posed_step* step, size_t size);
/* Finds what follows from each link's bound. `bounds`: one per link. Allocates nothing once memory
 * has grown. A call that fails leaves the last answer, if its arguments were wrong. */
FT_API ft_status ft_brackets_answer(ft_brackets* brackets, const ft_posed_step* step,
                                    const ft_link_bound* bounds, size_t count);
/* Poses were lost between `from` and `to`: only `speed` and `error` of the bounds count. */
FT_API ft_status ft_brackets_answer_gap(ft_brackets* brackets, const ft_posed_step* step,
                                        const ft_link_bound* bounds, size_t count);
/* Looks ahead: t is 0 at the step's `to` and 1 after `horizon` seconds, at most 1e6. The model goes
 * on as it went. Links are excluded, or possible from `possible_from` on. */
FT_API ft_status ft_brackets_look_ahead(ft_brackets* brackets, const ft_posed_step* step,
                                        double horizon, const ft_link_bound* bounds, size_t count);

/* ---- The answer ---- */

enum {
  FT_BRACKET_UNCLAIMED = 0, /* no bound holds: nothing is claimed */
  FT_BRACKET_EXCLUDED = 1,  /* proven: the person touched nothing with it */
  FT_BRACKET_POSSIBLE = 2,
  FT_BRACKET_CERTAIN = 3 /* proven: the person touched something with it */
};

/* Nothing was touched on [0, possible_from) and (possible_until, 1]. If certain, something was
 * touched at certain_from and at certain_until, or, where certain_until comes first, at an instant
 * between the two, at which the link passed through a surface. */
typedef struct ft_link_bracket {
  uint32_t size;
  int32_t link;
  int32_t other;    /* an own link above `link`; -1: the scene */
  int32_t verdict;  /* FT_BRACKET_* */
  int32_t triangle; /* the scene's that is, or may be, touched first; -1: none, or not known */
  int32_t object;   /* the triangle's; -1: none */
  double possible_from, possible_until;
  double certain_from, certain_until;
  double growth; /* the largest distance between person and model, m */
} ft_link_bracket;

/* One per link, in order. FT_ERROR_NO_STEP before the first answer. */
FT_API ft_status ft_brackets_links(const ft_brackets* brackets, ft_link_bracket* links,
                                   size_t capacity, size_t* required);
/* Every asked pair of own links that is not excluded. */
FT_API ft_status ft_brackets_pairs(const ft_brackets* brackets, ft_link_bracket* pairs,
                                   size_t capacity, size_t* required);
FT_API void ft_brackets_destroy(ft_brackets* brackets);

#ifdef __cplusplus
}
#endif

#endif
