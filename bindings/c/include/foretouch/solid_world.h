/* solid_world.h: solid avatars in a world in which other things move, in C99 and C++: doors push
 * them, what they hold is solid with them, two of them meet and neither passes; and what a shown
 * body presses against is reported from enter to leave. What it is good for: docs/solid.md. Units,
 * frames, errors, memory and sizes of structs are as in foretouch.h; time is as in world.h. */
#ifndef FORETOUCH_SOLID_WORLD_H
#define FORETOUCH_SOLID_WORLD_H

#include <foretouch/events.h>
#include <foretouch/solid.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Making ---- */

/* How far solid avatars reach in all that the world is asked and reports. */
enum {
  /* To the gap at which they stop (ft_solid_options.skin): they are found in contact with what they
   * press against. */
  FT_SOLID_REACH_SKIN = 0,
  /* To their surface: they are found to touch nothing but what crushes them. */
  FT_SOLID_REACH_SURFACE = 1
};

/* A solid world is an ft_world: all that world.h, events.h and triggers.h have is for it, too. Add
 * what moves by itself (doors, lifts, balls), push its poses, attach what hands hold. It is
 * followed from `begin_us` on, where its first tick begins: after each tick, ft_world_follow()
 * until there, then ft_world_events(). `options` may be NULL. Errors: as ft_world_create(), no
 * scene, an instant out of range. */
FT_API ft_status ft_solid_world_create(const ft_scene* still, int64_t begin_us, int32_t reach,
                                       const ft_world_options* options, ft_world** world);
/* Adds a solid avatar, which is there from its first target on. Ticks push its poses, and nothing
 * else does. Either of the options may be NULL. It reaches to its surface, whatever `reach` was,
 * if it has own links or touches by its triangles (ft_body_options). Errors: as ft_solid_create()
 * and ft_world_add_avatar(), `may_snap`, and FT_ERROR_MISMATCH if the world is not a solid world,
 * as for the next two. */
FT_API ft_status ft_solid_world_add(ft_world* world, const ft_avatar* avatar,
                                    const ft_solid_options* options, const ft_body_options* body,
                                    int32_t* number);

/* ---- A tick ---- */

/* Where the tracker says that a solid avatar is at the end of a tick. */
typedef struct ft_solid_target {
  int32_t body;
  int32_t reserved; /* 0 */
  const ft_pose* pose;
  const uint8_t* is_tracked; /* as of ft_solid_follow(); may be NULL */
} ft_solid_target;

/* One tick, from where the last one ended to `utime_us`. Avatars without a target in it keep their
 * last one. What is not a solid avatar moves as the world knows it. Allocates nothing once memory
 * has grown, as long as no hand takes or lets go. Errors, each of which names its body and changes
 * nothing: an instant that is not 1 us to 10 s after the last one; a target that is none, of no
 * solid avatar, or two of one; a body that waits for its poses and is not known until then; a solid
 * avatar that is carried; what moves in its hand (ft_carrier.moves_in_frame), or changes hands
 * within the tick; a tick that begins where the world has forgotten. If memory runs out in a tick,
 * all later ones are FT_ERROR_OUT_OF_MEMORY: the world is to be made anew. */
FT_API ft_status ft_solid_world_tick(ft_world* world, int64_t utime_us,
                                     const ft_solid_target* targets, size_t count);
/* Where the last tick ended, or `begin_us`. */
FT_API ft_status ft_solid_world_at(const ft_world* world, int64_t* utime_us);

/* ---- What a solid avatar shows ---- */

/* The last tick of a solid avatar that has had a target; else FT_ERROR_NO_STEP. Otherwise as
 * ft_solid_follow(), ft_solid_shown(), ft_solid_joints(), ft_solid_contacts() and ft_solid_way()
 * have them, with these differences. What is proven is proven of moving bodies, too: is_certified
 * and clearance are 0 while something crushes it. The contacts are those with what is still and
 * with own links. The times of the way are those of the world's poses: whole microseconds. Stores
 * 1 in *is_assumed if a body around it was silent, and was taken to hold still or to be nowhere;
 * it may be NULL. */
FT_API ft_status ft_solid_world_get_tick(const ft_world* world, int32_t body, ft_solid_tick* tick,
                                         int32_t* is_assumed);
FT_API ft_status ft_solid_world_shown(const ft_world* world, int32_t body, double* rotations,
                                      double* translations, size_t capacity, size_t* required);
FT_API ft_status ft_solid_world_joints(const ft_world* world, int32_t body, ft_solid_joint* joints,
                                       size_t capacity, size_t* required);
FT_API ft_status ft_solid_world_contacts(const ft_world* world, int32_t body,
                                         ft_solid_contact* contacts, size_t capacity,
                                         size_t* required);
FT_API ft_status ft_solid_world_way(const ft_world* world, int32_t body, size_t index, double* time,
                                    double* rotations, double* translations, size_t capacity,
                                    size_t* required);

/* A moving body that holds or pushes a solid avatar. */
typedef struct ft_solid_body_contact {
  uint32_t size;
  int32_t body;
  int32_t link;     /* the avatar's */
  int32_t lss;      /* of the link; those of tools in its hand come after its own */
  int32_t triangle; /* of a mesh; -1: none */
  int32_t object;   /* the triangle's; -1: none */
  double point[3];  /* on the body's surface, W */
  double normal[3]; /* unit, from it to the avatar, W */
  double gap;
  double push;       /* as ft_solid_contact.push; what the body's own motion adds is in it */
  double slip_speed; /* of the link's point along that surface, which moves, m/s */
} ft_solid_body_contact;

/* A body that nothing holds back has left the avatar no proven way: between the two nothing is
 * claimed from `since_us` on. Everything else stays proven. */
typedef struct ft_solid_crush {
  uint32_t size;
  int32_t body;
  int32_t link;    /* where it was met; while they overlap, the link that is deepest */
  /* 1: it ended at the tick's begin, where the two are proven apart, or where the body is no longer
   * asked about (silent: is_assumed); reported once. */
  int32_t is_over;
  int64_t since_us;
  /* At the tick's end: the largest depth of a link's axis below the body's surface, its radius at
   * most. To part them takes at least as much. 0: they do not overlap there. */
  double depth;
} ft_solid_crush;

enum {
  FT_SOLID_HOLDS_TOOL = 0, /* solid with it */
  /* It touched something where it was taken: nothing is claimed of it until it is apart from
   * everything at a tick's begin. */
  FT_SOLID_HOLDS_LOOSE = 1,
  FT_SOLID_HOLDS_LET_GO = 2 /* not held any more, but still touched: not asked until apart */
};
typedef struct ft_solid_held {
  uint32_t size;
  int32_t body;
  int32_t state;    /* FT_SOLID_HOLDS_* */
  int32_t reserved; /* 0 */
} ft_solid_held;

/* All of the last tick; what its hands hold is sorted by state. In arrays, the first element's size
 * applies to all. O(n). */
FT_API ft_status ft_solid_world_body_contacts(const ft_world* world, int32_t body,
                                              ft_solid_body_contact* contacts, size_t capacity,
                                              size_t* required);
FT_API ft_status ft_solid_world_crushes(const ft_world* world, int32_t body,
                                        ft_solid_crush* crushes, size_t capacity, size_t* required);
FT_API ft_status ft_solid_world_held(const ft_world* world, int32_t body, ft_solid_held* held,
                                     size_t capacity, size_t* required);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_SOLID_WORLD_H */
