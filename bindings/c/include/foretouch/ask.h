/* ask.h: questions to a moving world at an instant, in C99 and C++: what a ray hits, what a moved
 * sphere, capsule or convex solid hits first, what a shape overlaps, what is nearest, what a point
 * is inside of; and what a shape that flies hits first while the bodies move. The instant may be
 * any that the world knows, also past ones and between poses. What they are good for, task by task:
 * docs/ask.md. Units, frames, errors, memory and sizes of structs are as in foretouch.h; time is as
 * in world.h. */
#ifndef FORETOUCH_ASK_H
#define FORETOUCH_ASK_H

#include <foretouch/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- What is met ---- */

/* Triangles that bend with several links. Vertex v is at the sum of weight times (the link's pose
 * applied to the point), over the shares from first_share[v] to before first_share[v + 1]; the
 * weights of a vertex add up to 1. */
typedef struct ft_skin {
  uint32_t size;
  uint32_t reserved; /* 0 */
  size_t vertex_count;
  const int32_t* first_share; /* one more than vertices; 0 first */
  const int32_t* share_links;
  const double* share_weights;   /* above 0 */
  const double* share_points;    /* the vertex in the link's frame, where it was bound; metres */
  const int32_t* triangles;      /* three vertices each */
  const int32_t* triangle_links; /* the link whose hit each is */
  size_t triangle_count;
} ft_skin;

/* Questions meet bodies of this avatar by the skin, as it is bent at the instant, if the bodies are
 * added after this call; links without triangles of it as they touch. First contacts and events go
 * on by LSS or triangles. The arrays are not kept. Errors: bad arrays; ft_last_error_index() is the
 * vertex or triangle. */
FT_API ft_status ft_avatar_set_skin(ft_avatar* avatar, const ft_skin* skin);

/* ---- Whom ---- */

/* A body, one of its links, or an object of it: of a mesh, or of what is still (FT_STILL_SCENE). */
typedef struct ft_ask_part {
  int32_t body;
  int32_t link;   /* or FT_EVERY_LINK */
  int32_t object; /* or FT_EVERY_OBJECT */
} ft_ask_part;

/* A body that is asked about at an instant of its own, with all that carries it: for what a player
 * saw who sees others late. */
typedef struct ft_ask_instant {
  int32_t body;
  int32_t reserved; /* 0 */
  int64_t time_us;
  double time_fraction; /* of one more microsecond, in [0, 1) */
} ft_ask_instant;

/* What a question is about: everything, unless it says less. */
typedef struct ft_ask_whom {
  uint32_t size;
  uint32_t groups;         /* bit g: bodies of group g; default all */
  int32_t asks_still;      /* 1, the default: what is still, too; 0: not */
  int32_t reserved;        /* 0 */
  const ft_ask_part* only; /* nothing but these; none: everything */
  size_t only_count;
  const ft_ask_part* without; /* not these */
  size_t without_count;
} ft_ask_whom;

FT_API ft_status ft_ask_whom_init(ft_ask_whom* whom, size_t size);

/* ---- At an instant ---- */

enum {
  FT_ASK_CAST = 0,    /* the shape moves along `direction`, up to `reach`: where does it touch? */
  FT_ASK_OVERLAP = 1, /* what does the shape touch where it is? */
  FT_ASK_NEAREST = 2  /* what is near the shape, up to `reach`? */
};

enum {
  FT_ASK_CLOSEST = 0, /* the first one along the way, or the nearest one */
  FT_ASK_ANY = 1,     /* whether there is one: some hit */
  FT_ASK_ALL = 2      /* each LSS and each triangle that is touched or near, nearest first */
};

typedef struct ft_question {
  uint32_t size;
  int32_t what;     /* FT_ASK_CAST, _OVERLAP or _NEAREST; default FT_ASK_CAST */
  int32_t which;    /* FT_ASK_CLOSEST, _ANY or _ALL; default FT_ASK_CLOSEST */
  int32_t reserved; /* 0 */
  /* Where it begins; solid. Both ends alike: a sphere. No radius either: a point, whose cast is a
   * ray. */
  ft_lss shape;
  double direction[3]; /* a cast's: any length but zero */
  double reach;        /* how far a cast moves, or nearest looks; up to 1e8 m */
  int64_t time_us;     /* the instant, */
  double time_fraction;
  const ft_ask_whom* whom;        /* NULL: everything */
  const ft_ask_instant* instants; /* these bodies at these instants, all others at time_us */
  size_t instant_count;
  /* Three numbers each, from shape.a: corners of the convex solid that takes the place of the axis,
   * whose ends are alike then; the radius is around it. None: the axis. Up to 1024. */
  const double* hull;
  size_t hull_count;
  /* 1: closed objects of meshes and of what is still are solid: what begins inside one touches it,
   * and an object that is not closed is unknown where its box holds the shape's place (a, or the
   * middle of the corners). 0, the default: surfaces count. */
  int32_t solids;
  int32_t reserved_end; /* 0 */
} ft_question;

FT_API ft_status ft_question_init(ft_question* question, size_t size);

enum {
  FT_ASK_CLEAR = 0,  /* nothing is hit or near, proven */
  FT_ASK_HIT = 1,    /* something is; what is unknown may be nearer */
  FT_ASK_UNKNOWN = 2 /* nothing that is known is; nothing is claimed of what is unknown */
};

/* Answers, and stores FT_ASK_CLEAR, _HIT or _UNKNOWN in *verdict, which may be NULL. Never missed,
 * never late: what the shape hits, where everything truly is at the instant, has a hit, no farther
 * than it is, and at most 1e-9 m nearer where doubles resolve it. Questions at the instant of the
 * last one, while nothing changes the world, are cheapest. Allocates nothing once memory has grown.
 * Errors name the field: a shape, direction or reach that is not finite, out of range, or without
 * length; unknown bodies and links; an instant that was forgotten. After an error the last
 * answer stays. */
FT_API ft_status ft_world_probe(ft_world* world, const ft_question* question, int32_t* verdict);

/* An LSS or a triangle that was hit or is near; or, without either, an object that is solid and
 * holds the shape's place, which is its point then. */
typedef struct ft_world_hit {
  uint32_t size;
  int32_t is_assumed; /* 1: it rests on a body that was silent, and was taken to hold still */
  ft_world_side what; /* its point: on its surface */
  double distance;    /* a cast's: along the way, free before; else how far apart; rounded down */
  double normal[3];   /* unit, to the shape, W; zero if none is reported */
  double weights[3];  /* a triangle's: the point as a sum of its corners; else zero */
} ft_world_hit;

/* What one of many questions found: its hits are the next hit_count of ft_world_hits(), after those
 * of the questions before it; so are its unknown ones of ft_world_unknown(). */
typedef struct ft_probed {
  int32_t verdict;
  uint32_t hit_count, unknown_count;
  int32_t reserved; /* 0 */
} ft_probed;

/* Many questions in one call, each answered as ft_world_probe() answers it, to the bit, whatever
 * their order; cheaper where they are at the same instants. All have the same size. If one is
 * refused, none is answered, and the message names it. `probed` has room for `count`. */
FT_API ft_status ft_world_probe_many(ft_world* world, const ft_question* questions, size_t count,
                                     ft_probed* probed);

/* The last ft_world_probe()'s hits, by distance, then by body, link, LSS and triangle; those of the
 * last ft_world_probe_many(), question after question. In arrays, the first element's size applies
 * to all. FT_ERROR_NO_STEP before the first answer. O(n). */
FT_API ft_status ft_world_hits(const ft_world* world, ft_world_hit* hits, size_t capacity,
                               size_t* required);

enum {
  FT_ASK_ASSUMED = 0,    /* silent, and taken to hold still: hits of it are assumed */
  FT_ASK_SILENT = 1,     /* nothing is known after its last pose; it was left out */
  FT_ASK_NOT_THERE = 2,  /* before its first pose; it was left out */
  FT_ASK_UNRESOLVED = 3, /* in a flight: more triangles, or steps, than are followed in motion */
  FT_ASK_OPEN =
      4 /* with solids: an object of it, or of what is still, has no inside: it is not closed */
};

/* A body that was asked about and is not known then; or an object that has no inside. */
typedef struct ft_unknown_body {
  uint32_t size;
  int32_t body;   /* or FT_STILL_SCENE */
  int32_t why;    /* FT_ASK_ASSUMED to FT_ASK_OPEN */
  int32_t object; /* for FT_ASK_OPEN, unless it is a link's surface; else FT_EVERY_OBJECT */
} ft_unknown_body;

/* What was unknown to the last ft_world_probe(), ft_world_probe_many() or ft_world_fly(), whichever
 * came last; by body, question after question. */
FT_API ft_status ft_world_unknown(const ft_world* world, ft_unknown_body* bodies, size_t capacity,
                                  size_t* required);

/* ---- Through a time ---- */

/* A sphere, capsule or convex solid on its way, at constant speed and without a turn. */
typedef struct ft_flight {
  uint32_t size;
  uint32_t reserved; /* 0 */
  ft_lss shape;      /* where it is at from_us */
  double way[3];     /* to where it is at to_us; zero: it waits */
  int64_t from_us, to_us;
  const ft_ask_whom* whom; /* NULL: everything */
  const double* hull;      /* as in ft_question */
  size_t hull_count;
} ft_flight;

FT_API ft_status ft_flight_init(ft_flight* flight, size_t size);

/* The first hit of all. */
typedef struct ft_flight_hit {
  uint32_t size;
  int32_t verdict; /* FT_ASK_CLEAR, _HIT or _UNKNOWN: the rest is zero unless FT_ASK_HIT */
  int64_t time_us; /* rounded down: nothing is hit before */
  double time_fraction;
  int32_t is_assumed; /* as in ft_world_hit, as all that follows */
  int32_t reserved;   /* 0 */
  ft_world_side what;
  double distance; /* along the way */
  double normal[3];
  double weights[3];
} ft_flight_hit;

/* By the bodies' true motion and the shape's own, not a cast against where they were. Never missed,
 * never late, in time as in place. Errors: as ft_world_probe(); a time without length. */
FT_API ft_status ft_world_fly(ft_world* world, const ft_flight* flight, ft_flight_hit* hit);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_ASK_H */
