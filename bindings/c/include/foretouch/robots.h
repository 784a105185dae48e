/* robots.h: robots that move by joint coordinates, and the question of a motion planner, in C99 and
 * C++: is the straight line from q0 to q1 free? What it is good for: docs/robots.md. Units, frames,
 * errors, memory and sizes of structs are as in foretouch.h. A configuration q has one number per
 * coordinate (rad or m), at most 1,000; t is 0 at q0 and 1 at q1. */
#ifndef FORETOUCH_ROBOTS_H
#define FORETOUCH_ROBOTS_H

#include <foretouch/foretouch.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ft_robot ft_robot; /* for any number of threads */
typedef struct ft_edges ft_edges; /* for one */

/* ---- Robots ---- */

enum {
  FT_JOINT_FIXED = 0,
  FT_JOINT_REVOLUTE = 1,   /* an angle between limits: beyond a turn it goes as q says */
  FT_JOINT_CONTINUOUS = 2, /* an angle without limits */
  FT_JOINT_PRISMATIC = 3,
  FT_JOINT_PLANAR = 4 /* a mobile base: x, y across the axis, and the angle about it */
};

/* How a joint moves against its parent: T_rest * T_joint(q). For a fixed one only the kind counts.
 */
typedef struct ft_robot_joint {
  int32_t kind;
  int32_t mimic_of;    /* a joint that this one follows; -1: none */
  double axis[3];      /* in the joint's frame; any length but 0 */
  double lower, upper; /* of revolute and prismatic ones; may be infinite */
  double mimic_factor; /* its coordinate is factor * (the other's) + offset */
  double mimic_offset;
} ft_robot_joint;

/* One joint per joint of the avatar, in order. `names`: the coordinates'; NULL: the joints'.
 * Errors: another number of joints, limits the wrong way round, an axis that is zero, a joint that
 * follows itself, or one that itself follows or does not move. */
FT_API ft_status ft_robot_create(const ft_avatar* avatar, const ft_robot_joint* joints,
                                 size_t joint_count, const char* const* names, ft_robot** robot);

typedef struct ft_urdf_options {
  uint32_t size;
  int32_t max_lss_per_link;         /* around a link's meshes; default 4 */
  const ft_import_options* import;  /* NULL: the defaults */
  const char* const* package_paths; /* where package://NAME/ is; besides, above the file */
  size_t package_count;
  int32_t use_visual; /* 1: the visual geometry; 0, the default: the collision one */
  int32_t reserved;   /* 0 */
} ft_urdf_options;

FT_API ft_status ft_urdf_options_init(ft_urdf_options* options, size_t size);
/* A URDF, or MuJoCo's MJCF where the importer reads it (docs/robots.md). Refuses by name floating
 * joints, limits the wrong way round, equal or absent, missing meshes and mimics of joints that are
 * not there. W is the frame of the root link, or MuJoCo's world. `options` may be NULL. */
FT_API ft_status ft_robot_create_from_urdf(const char* path, const ft_urdf_options* options,
                                           ft_robot** robot);
/* Makes another robot: this one with a tool, a link of its own that is fixed to `link`, with these
 * LSS in the frame of `link`. */
FT_API ft_status ft_robot_create_with_tool(const ft_robot* robot, int32_t link, const char* name,
                                           const ft_lss* lss, size_t lss_count, ft_robot** tooled);
/* Makes an avatar of the robot's links: for pair rules, names and queries by poses. Destroy it. */
FT_API ft_status ft_robot_avatar(const ft_robot* robot, ft_avatar** avatar);

typedef struct ft_robot_coordinate {
  uint32_t size;
  int32_t joint;
  const char* name; /* lives as long as the robot */
  double lower, upper;
  int32_t is_angle;    /* rad; else m */
  int32_t is_periodic; /* a whole turn leads to the same place */
} ft_robot_coordinate;

FT_API ft_status ft_robot_coordinate_count(const ft_robot* robot, size_t* count);
FT_API ft_status ft_robot_coordinates(const ft_robot* robot, ft_robot_coordinate* coordinates,
                                      size_t capacity, size_t* required);
/* The pose at q, as ft_avatar_rest_pose() has it. */
FT_API ft_status ft_robot_pose(const ft_robot* robot, const double* q, size_t coordinate_count,
                               double* rotations, double* translations, size_t capacity,
                               size_t* required);
/* The poses at `count` configurations, one after the other in q, and between two of them as many as
 * it takes to keep every joint's turn below a half turn: a step takes the shorter arc, which is
 * then the way that q says, as in an edge. `capacity` and `required` count poses, each as from
 * ft_robot_pose(). `at`: where each lies, i + t on the edge from configuration i to i + 1. Any of
 * the three arrays may be NULL. */
FT_API ft_status ft_robot_path(const ft_robot* robot, const double* q, size_t count,
                               size_t coordinate_count, double* rotations, double* translations,
                               double* at, size_t capacity, size_t* required);

/* How to judge own links, by configurations drawn within the robot's limits. */
typedef struct ft_robot_pair_options {
  uint32_t size;
  int32_t samples;              /* at least 1; default 10,000 */
  uint64_t seed;                /* the same configurations on every machine; default 1 */
  double always_share;          /* of these, for FT_PAIR_ALWAYS; default 0.95 */
  const ft_link_pair* left_out; /* by the user */
  size_t left_out_count;
} ft_robot_pair_options;

FT_API ft_status ft_robot_pair_options_init(ft_robot_pair_options* options, size_t size);
/* Rules of ft_robot_avatar(). Leaves out adjacent links and links that touch in nearly all samples.
 * Zeros may lie outside the limits, so touching there is no reason; that no sample touched proves
 * nothing, so such pairs are asked: ft_pair_rules_touches() has the counts. `options` may be NULL.
 */
FT_API ft_status ft_pair_rules_create_of_robot(const ft_robot* robot,
                                               const ft_robot_pair_options* options,
                                               ft_pair_rules** rules);
FT_API void ft_robot_destroy(ft_robot* robot);

/* ---- Edges ---- */

/* A rigid obstacle whose place may change between questions: ft_edges_place(). */
typedef struct ft_edge_prop {
  const ft_scene* scene;              /* in the prop's own frame */
  double rotation[4], translation[3]; /* of that frame in W: w, x, y, z; metres */
  int32_t is_absent;                  /* 1: it is not there, and has no place */
  int32_t reserved;                   /* 0 */
  const ft_ignored_pair* ignored;     /* links and objects of this prop's scene */
  size_t ignored_count;
} ft_edge_prop;

typedef struct ft_edge_options {
  uint32_t size;
  int32_t threads;           /* for lists, the calling one among them; default 1, at most 256 */
  double tolerance;          /* metres; default 1e-3 */
  double clearance;          /* metres, default 0: clear proves that the robot keeps more away */
  const ft_pair_rules* self; /* own links, of ft_robot_avatar(); NULL: not asked */
  const ft_ignored_pair* ignored;
  size_t ignored_count;
  const ft_edge_prop* props; /* obstacles beside the scene; default none */
  size_t prop_count;
  /* For ft_edges_clearance(), metres: how far its bounds may be apart, default 1e-3; how far it
   * looks, default infinity. */
  double clearance_tolerance, clearance_within;
} ft_edge_options;

FT_API ft_status ft_edge_options_init(ft_edge_options* options, size_t size);
/* Keeps what it needs of all that it is given. `options` may be NULL. */
FT_API ft_status ft_edges_create(const ft_robot* robot, const ft_scene* scene,
                                 const ft_edge_options* options, ft_edges** edges);

/* Moves a prop, by its place in ft_edge_options; nothing is built anew. A NULL rotation: it is not
 * there. Errors: no such prop, a rotation that is not unit, a place that is not finite or beyond
 * 10 km along an axis; then it is where it was. */
FT_API ft_status ft_edges_place(ft_edges* edges, size_t prop, const double* rotation,
                                const double* translation);

/* Sound: free_until is never late. In arrays, the first element's size applies to all. */
typedef struct ft_edge {
  uint32_t size;
  int32_t verdict;                  /* FT_VERDICT_* */
  int32_t reason;                   /* for FT_VERDICT_UNDECIDED */
  int32_t is_usable;                /* 1: clear, and both ends within limits */
  double free_until;                /* the robot keeps its clearance on [0, free_until); 1: clear */
  int32_t breach_at_0, breach_at_1; /* a joint beyond its limits at that end; -1: none */
} ft_edge;

/* q0 and q1 hold `count` configurations of `coordinate_count` numbers each, one after the other;
 * `answers` has room for `count`. An edge from q to q asks whether q is free. The answers are the
 * same for any number of threads. Errors, before any edge is asked: a coordinate_count that is not
 * the robot's, numbers that are not finite or beyond 1,000; the index is the edge's. */
FT_API ft_status ft_edges_answer(ft_edges* edges, const double* q0, const double* q1, size_t count,
                                 size_t coordinate_count, ft_edge* answers);

/* How near an edge comes to the scene and to the props that are there. Metres, W. */
typedef struct ft_clearance {
  uint32_t size;
  int32_t link, lss, triangle; /* what comes nearest; -1: nothing comes within clearance_within */
  int32_t prop;                /* whose scene has the triangle; -1: the scene */
  int32_t is_alone;            /* 1: no other place that was looked at is as near */
  double lower, upper;         /* never nearer than `lower`; at `t` no farther than `upper` */
  double t;
  double point_on_link[3], point_on_scene[3];
  double normal[3]; /* unit, from the scene to the link; 0: they meet */
} ft_clearance;

/* q0, q1 and errors are as for ft_edges_answer(). The options' clearance and own links have no part
 * in it. `slopes0` and `slopes1`, which may be NULL, have room for count * coordinate_count
 * numbers: how `upper` changes with q0 and q1; one way of several where is_alone is 0. */
FT_API ft_status ft_edges_clearance(ft_edges* edges, const double* q0, const double* q1,
                                    size_t count, size_t coordinate_count, ft_clearance* clearances,
                                    double* slopes0, double* slopes1);

typedef struct ft_path {
  uint32_t size;
  int32_t verdict;   /* of the first edge that is not clear, or clear */
  uint64_t edge;     /* which that is; the number of edges: all are clear */
  double free_until; /* `edge` plus how far that one is free; never late */
} ft_path;

/* How far the list of `count` configurations is free, at least two, an edge from each to the next.
 * Asks no edge behind the first that is not clear, but for those that other threads have begun. */
FT_API ft_status ft_edges_answer_path(ft_edges* edges, const double* q, size_t count,
                                      size_t coordinate_count, ft_path* path);

/* What the edge `index` of the last list meets first, or the first edge of the last path that is
 * not clear, with index 0. `toi` is the edge's; separation and points are of the robot grown by the
 * clearance. `other`, which may be NULL: an own link in the place of the scene; link -1: none.
 * FT_ERROR_NO_STEP before; FT_ERROR_MISMATCH if that edge is clear. */
FT_API ft_status ft_edges_contact(const ft_edges* edges, size_t index, ft_contact* contact,
                                  ft_other_link* other);
/* Stores the prop whose scene has that contact's triangle and object; -1: none. Errors as
 * above. */
FT_API ft_status ft_edges_contact_prop(const ft_edges* edges, size_t index, int32_t* prop);
FT_API void ft_edges_destroy(ft_edges* edges);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_ROBOTS_H */
