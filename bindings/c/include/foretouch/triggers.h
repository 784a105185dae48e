/* triggers.h: volumes of a moving world that report what is in them, and how deep its bodies are in
 * each other, in C99 and C++. What they are good for: docs/moving.md, "Triggers" and "How deep, and
 * which way out". Units, frames, errors, memory and sizes of structs are as in foretouch.h; time is
 * as in world.h. */
#ifndef FORETOUCH_TRIGGERS_H
#define FORETOUCH_TRIGGERS_H

#include <foretouch/events.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Making ---- */

/* A trigger is a body of the world: it is there from its first pose on, may move, and may be
 * carried (ft_world_push(), ft_world_attach()). Its events come with those of ft_world_follow(). */
typedef struct ft_trigger_options {
  uint32_t size;
  int32_t group;       /* default 31. Triggers of one group do not meet each other, nor the scene */
  int32_t when_silent; /* default FT_SILENT_HOLD_STILL */
  int32_t by_link;     /* 0, the default: a body is inside while any of its links is. 1: each link
                        * enters and leaves by itself */
} ft_trigger_options;

FT_API ft_status ft_trigger_options_init(ft_trigger_options* options, size_t size);
/* Around the origin of the trigger's frame, along its axes. Stores the trigger's number, 0, 1, 2,
 * ..., in *trigger and that of its body in *body; either may be NULL, and so may `options`. Errors:
 * an extent that is not above 0 and within 10^7 m, options out of range, too many bodies; for a
 * mesh also (FT_ERROR_MISMATCH) an open edge, with its object, its ends and a triangle of it. */
FT_API ft_status ft_world_add_trigger_box(ft_world* world, const double half_extents[3],
                                          const ft_trigger_options* options, int32_t* trigger,
                                          int32_t* body);
FT_API ft_status ft_world_add_trigger_sphere(ft_world* world, double radius,
                                             const ft_trigger_options* options, int32_t* trigger,
                                             int32_t* body);
/* What is inside some object of a mesh. Each object is closed: every edge, by exact coordinates,
 * belongs to an even number of the object's triangles, turned any way. */
FT_API ft_status ft_world_add_trigger_mesh(ft_world* world, const ft_scene* closed,
                                           const ft_trigger_options* options, int32_t* trigger,
                                           int32_t* body);
/* Looks at this body, or at this link of it, instead of at all bodies; called again, at several.
 * `link` may be FT_EVERY_LINK. Before the trigger's first ft_world_follow(). */
FT_API ft_status ft_world_watch(ft_world* world, int32_t trigger, int32_t body, int32_t link);
/* Puts a trigger that has no pose where it stays, from an instant on: known for eleven days, and
 * then as `when_silent` says. The one joint of `pose` is the trigger's. */
FT_API ft_status ft_world_stand_trigger(ft_world* world, int32_t trigger, int64_t from_us,
                                        const ft_pose* pose);

/* ---- What is inside ---- */

/* A body is inside if a point of its volume is in the trigger's: also if it passes through between
 * two poses, and if all of it is inside. Sound: no body is inside, at any instant, unless it is
 * reported to be, or to be unresolved. Tight: one reported to be is, but for twice the tolerance.
 */
typedef struct ft_trigger_event {
  uint32_t size;
  int32_t kind; /* FT_EVENT_* */
  int32_t trigger, body;
  int32_t link;       /* the one that enters or leaves; or FT_EVERY_LINK */
  int32_t is_assumed; /* as ft_world_contact has it */
  int64_t time_us;
  double time_fraction;
  int64_t since_us; /* when what ends here began; else as the time */
  double since_fraction;
} ft_trigger_event;

/* The last ft_world_follow()'s, earliest first; at one instant what ends before what begins. In
 * arrays, the first element's size applies to all. FT_ERROR_NO_STEP before it. O(n). */
FT_API ft_status ft_world_trigger_events(const ft_world* world, ft_trigger_event* events,
                                         size_t capacity, size_t* required);

typedef struct ft_occupant {
  uint32_t size;
  int32_t trigger, body;
  int32_t link;          /* FT_EVERY_LINK, unless the trigger looks at each link by itself */
  int32_t is_unresolved; /* 1: nothing is known of whether it is inside */
  int32_t reserved;      /* 0 */
  int64_t since_us;
  double since_fraction;
} ft_occupant;

/* What is inside, or may be, where the last ft_world_follow() ended: by trigger, body and link. */
FT_API ft_status ft_world_occupants(const ft_world* world, ft_occupant* occupants, size_t capacity,
                                    size_t* required);

/* ---- How deep, and which way out ---- */

/* What is moved, and out of what. */
typedef struct ft_depth_question {
  uint32_t size;
  int32_t body;      /* the one that is moved */
  int32_t link;      /* or FT_EVERY_LINK */
  int32_t from_body; /* or FT_STILL_SCENE */
  int32_t from_link; /* or FT_EVERY_LINK */
  int32_t reserved;  /* 0 */
  int64_t time_us;
  double time_fraction; /* in [0, 1) */
} ft_depth_question;

/* No translation shorter than `lower` clears the body; moved by `way_out` it is proven clear, and
 * that is not longer than `upper`. Two that are apart: all zero, and certified. */
typedef struct ft_depth {
  uint32_t size;
  int32_t is_certified; /* 0: no way out could be certified; then `upper` is infinite */
  double lower, upper;  /* metres */
  double way_out[3];    /* W */
  int32_t pair_count;   /* of pieces that have, or may have, a point in common */
  int32_t is_assumed;   /* as ft_world_contact has it */
  int32_t link, lss;    /* of the deepest pair; -1: none */
  int32_t from_link, from_lss, from_triangle; /* the other side of that pair; -1: none */
  int32_t reserved;                           /* 0 */
} ft_depth;

/* The depth at an instant, of bodies where they are then. One of two must be made of LSS. Errors:
 * unknown bodies and links, two links that are one, a body that is not there or silent then. */
FT_API ft_status ft_world_depth(ft_world* world, const ft_depth_question* question,
                                ft_depth* depth);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_TRIGGERS_H */
