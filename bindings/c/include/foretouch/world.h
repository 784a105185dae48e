/* world.h: a moving world in C99 and C++: avatars, rigid props and what they carry, each known at
 * instants of its own, and the first contact of every two that meet between two of these. What it
 * is good for, and where it ends: docs/moving.md. Units, frames, errors, memory and sizes of
 * structs are as in foretouch.h. World time is in whole microseconds since any epoch, within 2^53
 * of it. */
#ifndef FORETOUCH_WORLD_H
#define FORETOUCH_WORLD_H

#include <foretouch/foretouch.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Bodies, where they are known to be, and the last window's answer. For one thread at a time; any
 * number of worlds may share scenes and avatars, which they keep alive. Answers depend on the poses
 * alone: not on the order in which bodies' poses came, nor on time or threads. */
typedef struct ft_world ft_world;

/* ---- Making ---- */

typedef struct ft_world_options {
  uint32_t size;
  int32_t asks_meshes; /* 1: two meshes are asked whether they meet, and a mesh and what is still */
  double tolerance;    /* metres, of every contact: 1e-8 to 1e7; default 1e-3 */
  /* Work, counted as ft_query_options.work_budget, that two bodies may cost in one window, and a
   * body by itself in one span between its poses; default 100,000,000. Beyond it: undecided. */
  uint64_t work_per_pair;
  /* Work that all pairs of a window may cost together, shared by bodies; default UINT64_MAX. */
  uint64_t work_per_window;
  /* A body that may meet more than so many others in a window is crowded; two crowded ones are not
   * asked about each other, and each is listed as silent. Default UINT64_MAX. */
  uint64_t most_near;
} ft_world_options;

FT_API ft_status ft_world_options_init(ft_world_options* options, size_t size);
/* `still`: what never moves; NULL: nothing. `options` may be NULL. */
FT_API ft_status ft_world_create(const ft_scene* still, const ft_world_options* options,
                                 ft_world** world);

/* What a body is taken to do after its last known pose. */
enum {
  FT_SILENT_WAIT = 0, /* nothing: windows beyond it are refused until the next pose is there */
  FT_SILENT_HOLD_STILL = 1, /* it stays in that pose: a guess, and no proof */
  FT_SILENT_UNDECIDED = 2   /* unknown: nothing is claimed of it from then on */
};

typedef struct ft_body_options {
  uint32_t size;
  int32_t group;             /* 0 to 31, for ft_world_ask(); default 0 */
  int32_t when_silent;       /* default FT_SILENT_WAIT */
  int32_t fidelity;          /* FT_FIDELITY_LINK, or _EXACT: it touches by the avatar's triangles */
  const ft_pair_rules* self; /* asks whether own links touch, too; NULL: not asked. Not kept */
} ft_body_options;

FT_API ft_status ft_body_options_init(ft_body_options* options, size_t size);
/* An avatar, or a prop made of LSS: the LSS of its links touch, or its triangles. Stores the body's
 * number in *body: 0, 1, 2, ... in the order of adding. `options` may be NULL. Errors: options out
 * of range, rules of another avatar, FT_FIDELITY_EXACT of an avatar without triangles or beside
 * rules with pair radii, more than 100,000 bodies. */
FT_API ft_status ft_world_add_avatar(ft_world* world, const ft_avatar* avatar,
                                     const ft_body_options* options, int32_t* body);
/* A rigid prop: its triangles touch, in its own frame. It has one joint, 0, as poses and contacts
 * count. It meets avatars, and whatever ft_world_options.asks_meshes says besides. */
FT_API ft_status ft_world_add_mesh(ft_world* world, const ft_scene* mesh,
                                   const ft_body_options* options, int32_t* body);
FT_API ft_status ft_world_body_count(const ft_world* world, size_t* count);

/* Sets whether bodies of two groups are asked if they meet, 0 or 1; at first all are. */
FT_API ft_status ft_world_ask(ft_world* world, int32_t group, int32_t other, int32_t is_asked);
/* The same for bodies of a group and what is still. */
FT_API ft_status ft_world_ask_still(ft_world* world, int32_t group, int32_t is_asked);

/* ---- Time ---- */

/* The body's next pose: in W, or in the frame of what carries it and lets it move. A body is there
 * from its first pose on; before, nothing touches it. Allocates nothing once memory has grown, if
 * ft_world_forget_before() is called now and then. Errors: an unknown body (ft_last_error_index()),
 * an instant that is not after the last one or that is forgotten, not a pose of the body, a body
 * that is held fast; then nothing has changed. */
FT_API ft_status ft_world_push(ft_world* world, int32_t body, int64_t utime_us,
                               const ft_pose* pose);

/* What carries a body. */
typedef struct ft_carrier {
  uint32_t size;
  int32_t body, link;
  /* 0: what it carries keeps the place that it is attached at, and needs no poses until it is
   * detached. 1: its poses are in the frame of that link, and are pushed like all others. */
  int32_t moves_in_frame;
} ft_carrier;

/* From `utime_us` on, the body is carried; `pose` is its pose there, in the frame of the carrier's
 * link. The body and that link are not asked whether they meet. Errors: unknown bodies and links,
 * a body that would carry itself (FT_ERROR_BAD_HIERARCHY), an instant at which one of the two is
 * not known, or that is not after the last change. */
FT_API ft_status ft_world_attach(ft_world* world, int32_t body, const ft_carrier* carrier,
                                 int64_t utime_us, const ft_pose* pose);
/* From `utime_us` on, nothing carries it; `pose` is its pose there, in W. Errors: the same, and a
 * body that is not carried. */
FT_API ft_status ft_world_detach(ft_world* world, int32_t body, int64_t utime_us,
                                 const ft_pose* pose);

/* Stores in *utime_us until when all is known, or taken to be: the earliest last pose of the bodies
 * that wait for theirs; if none waits, the latest pose of all. In *waits_for the body with that
 * pose; -1: none waits. Either may be NULL. FT_ERROR_EMPTY if no body has a pose. O(bodies). */
FT_API ft_status ft_world_known_until(const ft_world* world, int64_t* utime_us, int32_t* waits_for);
/* Lets go of what no window from `utime_us` on needs. Earlier poses and windows are refused from
 * now on. */
FT_API ft_status ft_world_forget_before(ft_world* world, int64_t utime_us);
/* The same by memory: lets go of the oldest poses of all until ft_world_pose_bytes() is at most
 * `bytes`, or nothing is left before ft_world_known_until(). Stores in *utime_us the instant before
 * which it has forgotten; may be NULL. */
FT_API ft_status ft_world_forget_beyond(ft_world* world, size_t bytes, int64_t* utime_us);
/* The bytes that kept poses take: 56 n + 256 for a pose of n joints. */
FT_API ft_status ft_world_pose_bytes(const ft_world* world, size_t* bytes);
/* Lets go of poses before `utime_us` between others that say nearly the same: no point of any body,
 * of what it carries included, is ever farther than `metres` from where all poses that were pushed
 * have it, however often this is called. Answers about instants from `utime_us` on stay as they
 * are, to the bit. Nothing can be attached before it any more. Errors: metres that are not finite,
 * or below 0. */
FT_API ft_status ft_world_thin_before(ft_world* world, int64_t utime_us, double metres);

/* ---- The question ---- */

/* Finds the first contact, in the window, of every two links of different bodies that are asked, of
 * every link and what is still, and of own links where a body has rules. Allocates nothing once
 * memory has grown, as long as no body is added or carried in another way. Errors: a window without
 * length, that begins where the world has forgotten, or ends after ft_world_known_until(); carriers
 * whose chains are too deep together. After an error the last answer stays. */
FT_API ft_status ft_world_answer(ft_world* world, int64_t from_us, int64_t to_us);

/* In contacts, in place of a body: what is still. In place of a link, of a body that is undecided:
 * every link that has no contact of its own listed. */
#define FT_STILL_SCENE (-1)

/* One of two that meet. */
typedef struct ft_world_side {
  int32_t body;     /* or FT_STILL_SCENE */
  int32_t link;     /* 0 for a mesh and for what is still; or FT_EVERY_LINK */
  int32_t lss;      /* which of the link's LSS; -1: none */
  int32_t triangle; /* of the mesh, of what is still, or of the link; -1: none */
  int32_t object;   /* of a mesh's triangle, or of what is still; -1: none */
  int32_t reserved; /* 0 */
  double point[3];  /* witness point on its surface, W */
} ft_world_side;

/* The first contact of two links in a window. Sound: its time is never later than their first touch
 * there. FT_VERDICT_CONTACT: their separation is then at most the tolerance.
 * FT_VERDICT_STARTS_IN_CONTACT: they touch where the window begins, or where one of them appears or
 * is attached. FT_VERDICT_UNDECIDED: free until then, nothing claimed after it. */
typedef struct ft_world_contact {
  uint32_t size;
  int32_t verdict;
  int32_t reason;       /* for FT_VERDICT_UNDECIDED */
  int32_t is_assumed;   /* 1: it rests on a body that was silent, and was taken to hold still */
  int64_t time_us;      /* whole microseconds, rounded down, */
  double time_fraction; /* and a fraction of one more, in [0, 1) */
  double separation;    /* metres, then */
  double penetration;   /* metres, for FT_VERDICT_STARTS_IN_CONTACT; NaN: not known */
  double normal[3];     /* unit, from b to a, W */
  ft_world_side a, b;   /* a: the lower body, or of one body the lower link; what is still is b */
} ft_world_contact;

/* All contacts of the last window, earliest first; at equal times by a's body and link, then by
 * b's. Every pair that was asked and is not listed is proven clear while both are there; but
 * nothing is claimed of a silent body that is taken to be undecided, nor of what it carries. In
 * arrays, the first element's size applies to all. FT_ERROR_NO_STEP before the first answer, as for
 * the next two. O(n). */
FT_API ft_status ft_world_contacts(const ft_world* world, ft_world_contact* contacts,
                                   size_t capacity, size_t* required);

/* A body of which nothing was known in the rest of the window. */
typedef struct ft_silent_body {
  uint32_t size;
  int32_t body;
  int64_t since_us; /* its last pose, or the window's begin */
  int32_t taken_to; /* FT_SILENT_HOLD_STILL or _UNDECIDED */
  int32_t reserved; /* 0 */
} ft_silent_body;

/* Those of the last window, by body. */
FT_API ft_status ft_world_silent(const ft_world* world, ft_silent_body* bodies, size_t capacity,
                                 size_t* required);

/* Work of the last window, independent of machine load. */
typedef struct ft_world_counters {
  uint32_t size;
  uint32_t reserved;   /* 0 */
  uint64_t bodies;     /* whose swept boxes were found */
  uint64_t pairs;      /* of bodies, asked, whose boxes meet */
  uint64_t near_pairs; /* of these, with two LSS whose boxes meet */
  uint64_t spans;      /* asked, of a pair or of a body alone, from pose to pose */
  uint64_t nodes, leaves, candidates, cluster_steps, lane_steps, part_steps, advancements;
  uint64_t hierarchy_tests, plane_tests, leaf_tests, states, rung_tests; /* as ft_counters */
} ft_world_counters;

/* Fills as much of `counters` as counters->size covers. */
FT_API ft_status ft_world_get_counters(const ft_world* world, ft_world_counters* counters);
FT_API void ft_world_destroy(ft_world* world);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_WORLD_H */
