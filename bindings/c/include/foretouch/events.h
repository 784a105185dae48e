/* events.h: what happens in a moving world, in C99 and C++: which body enters which, leaves which,
 * when, where and how hard; and the parts of time in which two are in contact. What it is good
 * for: docs/moving.md, "From enter to leave". Units, frames, errors, memory and sizes of structs
 * are as in foretouch.h; time is as in world.h. */
#ifndef FORETOUCH_EVENTS_H
#define FORETOUCH_EVENTS_H

#include <foretouch/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Following ---- */

typedef struct ft_follow_options {
  uint32_t size;
  int32_t threads; /* 1 to 256, the calling one among them; default 1 */
  /* Where time is cut. 0, the default: at every pose of any body. Else at the multiples of so many
   * microseconds, up to 10^7: less work for many bodies with clocks of their own; what is after the
   * last multiple waits. */
  int64_t cut_us;
} ft_follow_options;

FT_API ft_status ft_follow_options_init(ft_follow_options* options, size_t size);
/* Follows the world from `from_us` on: nothing before is reported, and what is in contact there
 * starts inside. Called again, it begins anew: weigh the bodies again then. `options` may be
 * NULL. Errors: options or an instant out of range. */
FT_API ft_status ft_world_follow_from(ft_world* world, int64_t from_us,
                                      const ft_follow_options* options);
/* What a rigid body weighs, for the effective mass: `center[3]` (metres) and `inertia[9]` (kg m2,
 * row after row, about the centre) in the body's frame. Nothing moves a body that is not weighed.
 * FT_ERROR_NO_STEP before ft_world_follow_from(), as for all that follow. Errors: an unknown body,
 * one of several joints, a mass that nothing can have. */
FT_API ft_status ft_world_weigh(ft_world* world, int32_t body, double kg, const double* center,
                                const double* inertia);
/* The same for an avatar that is a ragdoll: its LSS weigh `kg` in all, at one density. */
FT_API ft_status ft_world_weigh_avatar(ft_world* world, int32_t body, double kg);

/* Finds everything that happens from where the last call ended until `until_us`; nothing if that is
 * not later. What it reports depends on the poses alone: not on threads, the order in which poses
 * came, or the calls, as long as each ends where time is cut (ft_world_known_until() is a pose).
 * Errors: as ft_world_answer(), a world that asks_meshes (FT_ERROR_MISMATCH), and more than 10^7
 * cuts in one call; then nothing has been followed. */
FT_API ft_status ft_world_follow(ft_world* world, int64_t until_us);
/* Stores from where and until where the last call followed. Either may be NULL. */
FT_API ft_status ft_world_followed(const ft_world* world, int64_t* from_us, int64_t* until_us);

/* ---- What happened ---- */

/* In the order of events of one instant: what ends comes before what begins. */
enum {
  FT_EVENT_LEAVE = 0,          /* a contact ends */
  FT_EVENT_UNRESOLVED_TO = 1,  /* it is known again what the two do */
  FT_EVENT_STARTS_INSIDE = 2,  /* they are in contact where they are known first */
  FT_EVENT_ENTER = 3,          /* they were free, and are in contact from here on */
  FT_EVENT_UNRESOLVED_FROM = 4 /* nothing is claimed of the two from here on; a contact ends, too */
};
/* Why a contact ends. */
enum {
  FT_LEAVE_APART = 0, /* they are apart: proven */
  FT_LEAVE_NOT_ASKED =
      1,             /* they are not asked any more: one carries the other, or ft_world_ask() */
  FT_LEAVE_MOVED = 2 /* one of them, or what carries it, is put elsewhere there, with a jump */
};
/* In an event of a body as a whole, in place of the other one: everything it is asked about. */
#define FT_EVERY_BODY (-2)

/* Two points, one of each side, that are near then. */
typedef struct ft_event_point {
  double point_a[3], point_b[3]; /* W */
  double separation;             /* metres; below zero where the two overlap */
} ft_event_point;

/* One thing that happens to two links, or to a link and an object of a mesh or of what is still. In
 * FT_EVENT_UNRESOLVED_* the points are zero, links may be FT_EVERY_LINK, and b.body may be
 * FT_EVERY_BODY: a body that is silent, and taken to be undecided. */
typedef struct ft_event {
  uint32_t size;
  int32_t kind;
  int32_t cause;         /* for FT_EVENT_LEAVE */
  int32_t reason;        /* for FT_EVENT_UNRESOLVED_*: FT_REASON_* */
  int64_t time_us;       /* whole microseconds; begins are rounded down, ends up, */
  double time_fraction;  /* and a fraction of one more, in [0, 1) */
  int64_t since_us;      /* when what ends here began; else as the time */
  double since_fraction; /* as time_fraction */
  double separation;     /* metres, then */
  double penetration;    /* metres: how deep the axis lies if it starts inside, or NaN */
  double normal[3];      /* unit, from b to a, W; zero if none is reported */
  double velocity[3];    /* of a's material point less b's, m/s in W */
  double approach_speed; /* m/s along the normal, above zero while the two approach */
  /* If these two points touch before the next pose of any body that they depend on, they do so at a
   * speed between these along this normal. A lower one below zero: a graze, perhaps. */
  double approach_lower, approach_upper;
  double effective_mass; /* kg along the normal; infinite if neither body was weighed */
  ft_world_side a, b;    /* as ft_world_contact has them */
  int32_t is_assumed;    /* as ft_world_contact has it */
  int32_t point_count;   /* of `points`: 0 to 4, the nearest first */
  ft_event_point points[4];
} ft_event;

/* All events of the last call, earliest first. In arrays, the first element's size applies to all.
 * FT_ERROR_NO_STEP before the first ft_world_follow(), as for the next one. O(n). */
FT_API ft_status ft_world_events(const ft_world* world, ft_event* events, size_t capacity,
                                 size_t* required);

/* What two do in a part of the time. Everything else is free: their separation is above zero
 * throughout. Contact: it is at most twice the tolerance throughout. */
typedef struct ft_part {
  uint32_t size;
  int32_t is_contact;   /* 1; 0: unresolved */
  int32_t reason;       /* why it is unresolved: FT_REASON_* */
  int32_t is_assumed;   /* 1: some of it, since it began, rests on a motion that is assumed */
  int32_t began_before; /* 1: it goes on from before the last call's time */
  int32_t goes_on;      /* 1: it ends where that time does */
  int64_t from_us;
  double from_fraction;
  int64_t to_us;
  double to_fraction;
  int64_t since_us; /* when it began: at its `from` or before */
  double since_fraction;
  ft_world_side a, b; /* where it began; points as known then */
} ft_part;

/* The parts of the last call's time in which two are not free, by pair, then by time. O(n). */
FT_API ft_status ft_world_parts(const ft_world* world, ft_part* parts, size_t capacity,
                                size_t* required);
/* The parts that have not ended, by pair: what is in contact now, and since when. O(n). */
FT_API ft_status ft_world_open_parts(const ft_world* world, ft_part* parts, size_t capacity,
                                     size_t* required);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_EVENTS_H */
