/* solid.h: the solid avatar in C99 and C++: tracked poses in, shown poses out, and what is shown
 * passes through nothing: each motion, from the last shown pose to the next, is proven free before
 * it is shown. What it is good for, and where it ends: docs/solid.md. Units, frames, errors, memory
 * and sizes of structs are as in foretouch.h. */
#ifndef FORETOUCH_SOLID_H
#define FORETOUCH_SOLID_H

#include <foretouch/foretouch.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One avatar's shown pose in one scene, and what it remembers. For one thread at a time; any number
 * of them may share a scene and an avatar, which it keeps alive. The answers depend on the sequence
 * of targets and on the options, not on time or threads. */
typedef struct ft_solid ft_solid;

/* ---- Options ---- */

/* What to do about tracked feet below the floor: calibration is often off by centimetres. */
enum {
  FT_SOLID_FLOOR_LIFT = 0, /* lifts the whole target, slowly, as far as the feet ask for */
  FT_SOLID_FLOOR_HOLD = 1  /* a floor is a surface like all others */
};

typedef struct ft_solid_options {
  uint32_t size;
  int32_t floor;    /* default FT_SOLID_FLOOR_LIFT */
  double skin;      /* gap that it keeps to surfaces where it can: 1e-5 to 0.1; default 2e-3 */
  double tolerance; /* of the proofs: 1e-6 to half the skin; default 5e-4 */
  /* How much faster than the tracked pose it may move to catch up (m/s, any point); default 2. */
  double catch_up;
  double up[3];               /* unit; default +Y */
  double most_lift;           /* of FT_SOLID_FLOOR_LIFT: 0 to 1; default 0.1 */
  double most_deviation;      /* farther off than this, whole or by a limb, for longer than */
  double most_limb_deviation; /* `patience` (seconds), it may snap if `may_snap`; */
  double patience;            /* defaults 0.5, 0.35 and 0.7 */
  double snap_notice;         /* seconds that a snap is announced before; default 0.25 */
  double placing_reach;       /* how far off a free place may be; default 2 */
  /* 1: it may appear at the tracked pose if that is free: a break of what is shown. Default 0. */
  int32_t may_snap;
  /* Motions tried for a way around, per tick and per target; 0: never. Defaults 64 and 2000. */
  int32_t around_per_tick, around_in_all;
  int32_t reserved;         /* 0 */
  uint64_t work_budget;     /* per tick, in evaluations of a pair: >= 1; default 200,000 */
  const double* visibility; /* one per link, 0 to 1e6: how much its error counts beyond its area; */
  size_t visibility_count;  /* none: hands 4, trunk and head 100, all others 1, by their names */
  const uint8_t* feet;      /* one per link: 1 for those that FT_SOLID_FLOOR_LIFT listens to; */
  size_t feet_count;        /* none: by their names */
  const ft_ignored_pair* ignored; /* what touches nothing: a hole in the promise */
  size_t ignored_count;
  const ft_pair_rules* self; /* own links stop each other, too; NULL: they do not. Not kept */
} ft_solid_options;

FT_API ft_status ft_solid_options_init(ft_solid_options* options, size_t size);
/* `options` may be NULL. Errors: options out of range; arrays, pairs or rules that do not fit the
 * avatar; ft_last_error() names the option. O(links^2). */
FT_API ft_status ft_solid_create(const ft_scene* scene, const ft_avatar* avatar,
                                 const ft_solid_options* options, ft_solid** solid);

/* ---- A tick ---- */

enum {
  FT_SOLID_PLACING = 0,   /* no free place found yet: shown is tracked, and nothing is proven */
  FT_SOLID_EQUAL = 1,     /* shown is tracked, bit for bit (lost joints and the lift apart) */
  FT_SOLID_FOLLOWING = 2, /* touches nothing, and catches up */
  FT_SOLID_SLIDING = 3,   /* surfaces keep it from the tracked pose, and it moved */
  FT_SOLID_HELD = 4,      /* surfaces keep it from the tracked pose, and it stays */
  FT_SOLID_AROUND = 5,    /* on a proven way around what is in between */
  FT_SOLID_SNAPPED = 6    /* appeared here, although no way leads there */
};
/* The state of one joint and its link. */
enum {
  FT_SOLID_JOINT_FREE = 0,    /* no contact moves it from its tracked place */
  FT_SOLID_JOINT_SLIDING = 1, /* in contact, and moved */
  FT_SOLID_JOINT_HELD = 2,    /* in contact, and did not move */
  FT_SOLID_JOINT_LOST = 3     /* not tracked: keeps its place on its parent, if surfaces let it */
};
/* Why a tick ended before it was as near to its target as surfaces let it. */
enum {
  FT_SOLID_LIMIT_NONE = 0,
  FT_SOLID_LIMIT_BUDGET = 1,   /* work_budget */
  FT_SOLID_LIMIT_CATCH_UP = 2, /* catch_up */
  FT_SOLID_LIMIT_INSIDE = 3    /* the scene was changed around it: it stays, unproven */
};

typedef struct ft_solid_tick {
  uint32_t size;
  int32_t state; /* FT_SOLID_PLACING to _SNAPPED */
  int32_t limit;
  /* 1: on the whole way from the pose shown before, the avatar touches nothing but what is ignored.
   * 0: while placing, or where the scene was changed around it. */
  int32_t is_certified;
  /* 1: it appeared where its way begins, which is free, but no way leads there: its first place,
   * one after it was inside, or a snap. The only breaks of what is shown. */
  int32_t has_appeared;
  int32_t reserved; /* 0 */
  double deviation; /* of shown from tracked, the largest of all links */
  double lift;      /* how far the target was lifted */
  /* Lower bound on the separation on the whole way; infinite if it did not move, 0 if not
   * certified. */
  double clearance;
  double snap_in_s;       /* seconds until it snaps, if nothing changes; below 0: it does not */
  uint64_t joint_count;   /* ft_solid_joints() */
  uint64_t contact_count; /* ft_solid_contacts() */
  uint64_t way_count;     /* ft_solid_way(); 0: it did not move */
  /* Work done, independent of the machine's load. */
  uint32_t queries, iterations, features, rows, around_queries, placing_queries;
  uint64_t work;
} ft_solid_tick;

/* One tick: the shown pose goes as near to `tracked` as surfaces let it. Fills as much of `tick` as
 * tick->size covers. `is_tracked`: per joint 0 if its tracker lost it, so that its place in
 * `tracked` means nothing (but must be legal); NULL: none is lost. A lost joint keeps its place on
 * its parent, a lost root where it is. `dt_s`: since the last tick, above 0 and at most 10. The
 * first pose is where the avatar begins; if it touches something there, at the nearest free place.
 * Allocates nothing once memory has grown to the scene's needs. After an error the shown pose and
 * the last tick stay. */
FT_API ft_status ft_solid_follow(ft_solid* solid, const ft_pose* tracked, const uint8_t* is_tracked,
                                 double dt_s, ft_solid_tick* tick);

/* The last tick's shown pose, to draw; otherwise like ft_avatar_rest_pose(). FT_ERROR_NO_STEP
 * before the first tick, as for the next three. */
FT_API ft_status ft_solid_shown(const ft_solid* solid, double* rotations, double* translations,
                                size_t capacity, size_t* required);

typedef struct ft_solid_joint {
  uint32_t size;
  int32_t state;    /* FT_SOLID_JOINT_* */
  double deviation; /* largest distance of its link's axes from where they are tracked */
} ft_solid_joint;

/* A place where a surface holds the shown pose from the tracked one. */
typedef struct ft_solid_contact {
  uint32_t size;
  int32_t link;
  int32_t lss;      /* which of the link's LSS */
  int32_t triangle; /* of the scene; -1: another own link is touched */
  int32_t object;   /* the triangle's; -1: none */
  int32_t other;    /* that own link; -1: none */
  double point[3];  /* on the surface that is touched, W */
  double normal[3]; /* unit, from that surface to the link, W */
  double gap;
  /* How hard the tracked pose presses: metres, >= 0. Times a stiffness (N/m) it is the force along
   * the normal with which a haptic device holds the hand. */
  double push;
  double slip_speed; /* of the link's point along the surface, m/s */
} ft_solid_contact;

/* The last tick's joints, in order, and its contacts, by link, LSS, triangle, other. In arrays, the
 * first element's size applies to all, and the library sets the others'. O(n). */
FT_API ft_status ft_solid_joints(const ft_solid* solid, ft_solid_joint* joints, size_t capacity,
                                 size_t* required);
FT_API ft_status ft_solid_contacts(const ft_solid* solid, ft_solid_contact* contacts,
                                   size_t capacity, size_t* required);
/* The way of the last tick, piece by piece: the pose that piece `index` ends with, otherwise like
 * ft_avatar_rest_pose(), and in *time (may be NULL) when it is reached, in (0, 1] of the tick (0:
 * it appeared there). Each piece is a motion as ft_query_step() answers them, from the pose before
 * it (the first: the one shown before); the last ends with the shown pose. FT_ERROR_OUT_OF_RANGE if
 * there are not as many.
 */
FT_API ft_status ft_solid_way(const ft_solid* solid, size_t index, double* time, double* rotations,
                              double* translations, size_t capacity, size_t* required);

/* ---- Breaks ---- */

/* Forgets the shown pose: the game teleported its user, or trackers were gone for long. The next
 * tracked pose is the first again. */
FT_API ft_status ft_solid_reset(ft_solid* solid);
/* The same, but the avatar begins at `place`, which must be outside of everything, say a spawn
 * point: the next tracked pose must be reached from there. Errors: not a pose of the avatar;
 * FT_ERROR_MISMATCH if it touches something; then nothing has changed. */
FT_API ft_status ft_solid_reset_at(ft_solid* solid, const ft_pose* place);
/* Goes on in another scene: a door has opened. Forgets the last tick's answer, but not the shown
 * pose. If that is inside something now, it stays there (FT_SOLID_LIMIT_INSIDE) until a tick finds
 * the nearest free place. Errors: as ft_solid_create(), and nothing has changed. */
FT_API ft_status ft_solid_change_scene(ft_solid* solid, const ft_scene* scene);
FT_API void ft_solid_destroy(ft_solid* solid);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_SOLID_H */
