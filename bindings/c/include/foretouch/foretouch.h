/* foretouch.h: Foretouch in C99 and C++: what an articulated body meets between two poses, when,
 * where and along which normal. One page about its use: docs/c-api.md. Headers of their own have
 * the avatar that passes through nothing, foretouch/solid.h, worlds in which everything may move,
 * foretouch/world.h, and both together, foretouch/solid_world.h.
 *
 * Units and frames. Metres, radians, doubles; right-handed world W, +Y up; t is normalised, 0 at
 * the earlier pose and 1 at the later. Quaternions are unit, in the order w, x, y, z. To convert
 * from an engine's conventions: ft_positions_from_floats() and its three sisters.
 *
 * Errors. Every function that can fail returns an ft_status: FT_OK, or the kind of error; then
 * ft_last_error() names the place and the expectation. A function that fails writes only the
 * required count, if it has one, and NULL in place of a handle or text. The library trusts no
 * argument: it refuses NULL, NaN, wrong sizes, counts beyond the limits and handles of another
 * kind. It cannot check two things, so the caller must ensure them: pointers point to as many
 * elements as the counts say, and no handle is used after it was destroyed. Nothing aborts; no C++
 * exception escapes.
 *
 * Memory. ft_*_create*() makes handles and ft_*_destroy() releases them, in any order: a query or
 * clip keeps its scene and avatar alive. The caller owns all arrays, in both directions; the
 * library keeps no pointer into them. A function that fills an array takes its capacity in elements
 * and stores the number of elements in *required (which may be NULL). With too little room it
 * writes nothing else and returns FT_ERROR_BUFFER_TOO_SMALL; capacity 0 with a NULL array only asks
 * for the number.
 *
 * Threads. Scenes, avatars and clips never change: any number of threads may use one. A query is
 * for one thread at a time: make one per thread and avatar. ft_last_error() is per thread.
 *
 * Versions. A struct's first field is its size, which the ft_*_init() function of the struct or the
 * caller sets. Fields are only ever added at the end, with zero for their default: a smaller size
 * comes from an older program, whose missing fields have defaults; a larger one comes from a newer
 * program, and is accepted if all fields unknown here are zero. Structs without a size never
 * change. */
#ifndef FORETOUCH_FORETOUCH_H
#define FORETOUCH_FORETOUCH_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#if defined(FT_BUILDS_LIBRARY)
#define FT_API __declspec(dllexport)
#else
#define FT_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define FT_API __attribute__((visibility("default")))
#else
#define FT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions ---- */

/* The version of this header and those beside it. Every new function or field increments it;
 * programs built with an older header still work. A change that would break them changes the
 * library's soname instead. */
#define FT_ABI_VERSION 11

/* The running library's version, "0.1.0", a text that lives for ever, and its FT_ABI_VERSION. */
FT_API const char* ft_version(void);
FT_API uint32_t ft_abi_version(void);

typedef struct ft_scene ft_scene;
typedef struct ft_avatar ft_avatar;
typedef struct ft_clip ft_clip;
typedef struct ft_pair_rules ft_pair_rules;
typedef struct ft_query ft_query;
typedef struct ft_near ft_near;

typedef int32_t ft_status;
enum {
  FT_OK = 0,
  /* Errors of the call itself. */
  FT_ERROR_NULL_ARGUMENT = 1, /* NULL for a required pointer. */
  FT_ERROR_WRONG_HANDLE = 2,  /* Not a handle of this kind. */
  FT_ERROR_STRUCT_SIZE = 3,   /* A size that no version of the struct has, or its newer fields. */
  FT_ERROR_ABI_VERSION = 4,   /* The library is older than the header. */
  FT_ERROR_BUFFER_TOO_SMALL = 5, /* *required is the room needed. */
  FT_ERROR_NO_STEP = 6,          /* No step has been answered yet. */
  FT_ERROR_OUT_OF_MEMORY = 7,
  FT_ERROR_INTERNAL = 8, /* A bug in Foretouch. */
  /* Errors of the input. */
  FT_ERROR_FILE_NOT_FOUND = 100,
  FT_ERROR_FILE_UNREADABLE = 101,
  FT_ERROR_FILE_UNWRITABLE = 102,
  FT_ERROR_SYNTAX = 103,         /* The text breaks the format's grammar. */
  FT_ERROR_LIMIT_EXCEEDED = 104, /* Larger, deeper or longer than the stated limit. */
  FT_ERROR_NON_FINITE = 105,     /* NaN or infinity instead of a number. */
  FT_ERROR_OUT_OF_RANGE = 106,   /* A finite number outside its legal range. */
  FT_ERROR_UNKNOWN_NAME = 107,
  FT_ERROR_DUPLICATE_NAME = 108,
  FT_ERROR_BAD_HIERARCHY = 109,  /* A parent after its child. */
  FT_ERROR_EMPTY = 110,          /* No joints, no frames, no triangles. */
  FT_ERROR_MISMATCH = 111,       /* Two inputs do not fit each other. */
  FT_ERROR_IMPORT_FAILED = 112,  /* The importer refused the file. */
  FT_ERROR_IMPORT_CRASHED = 113, /* The importer died or ran into its limits. */
  FT_ERROR_DEVICE_FAILED = 114   /* Embree refused to work. */
};

/* The status as a stable word, "file-not-found"; "unknown" for any other number. Never fails. */
FT_API const char* ft_status_name(ft_status status);
/* One line about this thread's last call that failed, with file, place and expectation; "" if none
 * has. UTF-8, at most 1023 bytes. The text lives until the thread's next call that fails. */
FT_API const char* ft_last_error(void);
/* The joint, link, frame, triangle or body at fault in that call; -1 if none. */
FT_API int64_t ft_last_error_index(void);

/* FT_ERROR_ABI_VERSION if `header_version` is newer than the library. */
FT_API ft_status ft_check_abi(uint32_t header_version);
/* Call this once, before everything else: does the library found at run time know this header? */
#define FT_CHECK_ABI() ft_check_abi(FT_ABI_VERSION)

/* ---- Scenes: static triangles ---- */

typedef struct ft_scene_arrays {
  uint32_t size;
  uint32_t reserved;       /* 0 */
  const double* positions; /* x, y, z per vertex, W, metres, |coordinate| <= 1e7 */
  size_t vertex_count;
  const uint32_t* indices;         /* 3 per triangle; NULL: three vertices per triangle, in order */
  size_t triangle_count;           /* 1 to 50,000,000 */
  const int32_t* objects;          /* the object of each triangle; NULL: object 0 */
  const char* const* object_names; /* UTF-8; NULL: "object 0" and so on */
  size_t object_count;             /* 0 counts as 1 if `objects` is NULL */
} ft_scene_arrays;

/* Writes the defaults, here zeroes, and the size, at most `size` bytes. So do all ft_*_init(). */
FT_API ft_status ft_scene_arrays_init(ft_scene_arrays* arrays, size_t size);

/* Triangles are two-sided. Keeps those without area; drops and counts those that are not finite
 * (ft_scene_info). O(n log n). Errors: bad arrays, no finite triangle. */
FT_API ft_status ft_scene_create(const ft_scene_arrays* arrays, ft_scene** scene);

/* FT_UP_FILE: as the file itself says, else Y. */
enum { FT_UP_FILE = -1, FT_UP_Y = 0, FT_UP_Z = 1 };

typedef struct ft_import_options {
  uint32_t size;
  /* The up axis, in place of what the file says; default FT_UP_FILE. Z: (x, y, z) becomes
   * (x, z, -y). */
  int32_t up;
  double scale; /* metres per unit, in place of the file's; default 0: as the file says, else 1 */
  /* The importing process' limit; default 8 GiB. It uses at most half of the machine's memory. */
  uint64_t memory_limit_bytes;
  double time_limit_s; /* that process' limit, too; default 60 */
  /* Path of the program foretouch-import. NULL: $FORETOUCH_IMPORTER; else in the library's folder;
   * else in libexec/foretouch of the library's prefix, beside the running program, and where
   * Foretouch was installed. */
  const char* importer;
} ft_import_options;

FT_API ft_status ft_import_options_init(ft_import_options* options, size_t size);

/* Reads OBJ, PLY, STL, glTF, FBX, Collada, 3DS, OFF, X or IQM, in a caged child process: a file
 * that crashes the importer is an error here. Or a scene that `foretouch scene bake` wrote: in
 * milliseconds, without that process. `options` may be NULL. */
FT_API ft_status ft_scene_create_from_file(const char* path, const ft_import_options* options,
                                           ft_scene** scene);

typedef struct ft_scene_info {
  uint32_t size;
  int32_t object_count;
  uint64_t triangles;          /* kept */
  uint64_t dropped_non_finite; /* dropped: a vertex with NaN or infinity */
  uint64_t zero_area;          /* kept */
  uint64_t duplicates;         /* kept */
  double box_min[3], box_max[3];
} ft_scene_info;

/* Fills as much of `info` as info->size covers. */
FT_API ft_status ft_scene_get_info(const ft_scene* scene, ft_scene_info* info);
/* Stores an object's name in *name; it lives as long as the scene. */
FT_API ft_status ft_scene_object_name(const ft_scene* scene, int32_t object, const char** name);
/* NULL is legal. Do not call while another thread uses this handle. */
FT_API void ft_scene_destroy(ft_scene* scene);

/* ---- Avatars: joints, and LSS (capsules) that bound the links that move with them ---- */

/* A line-swept sphere in its link's frame, metres. a = b: a sphere. */
typedef struct ft_lss {
  double a[3], b[3], radius;
} ft_lss;

/* A triangle of a link's surface, in the link's frame, metres. */
typedef struct ft_triangle {
  double vertices[9];
} ft_triangle;

typedef struct ft_avatar_arrays {
  uint32_t size;
  uint32_t reserved;        /* 0 */
  size_t joint_count;       /* 1 to 4096 */
  const char* const* names; /* unique UTF-8 */
  const int32_t* parents;   /* index of an earlier joint; -1: a root, placed in W */
  const double* offsets;    /* rest translation in the parent's frame, x, y, z per joint */
  const double* rotations;  /* rest rotation, w, x, y, z per joint; NULL: none */
  const ft_lss* lss;        /* at least one */
  const int32_t* lss_links; /* the joint that each LSS moves with */
  size_t lss_count;
  /* For FT_FIDELITY_EXACT: each triangle within one of its link's LSS. NULL: none. */
  const ft_triangle* triangles;
  const int32_t* triangle_links;
  size_t triangle_count;
} ft_avatar_arrays;

FT_API ft_status ft_avatar_arrays_init(ft_avatar_arrays* arrays, size_t size);
/* O(joints + LSS + triangles). Errors: bad arrays; ft_last_error_index() is the joint. */
FT_API ft_status ft_avatar_create(const ft_avatar_arrays* arrays, ft_avatar** avatar);

/* Reads an avatar file (docs/formats.md). `meshes`: how to read the triangles that it refers to,
 * scale and up included; NULL: does not read them, and queries refuse exact fidelity. */
FT_API ft_status ft_avatar_create_from_file(const char* path, const ft_import_options* meshes,
                                            ft_avatar** avatar);
/* The same from text in memory, without meshes; errors name `name` as the file. */
FT_API ft_status ft_avatar_create_from_text(const char* text, size_t length, const char* name,
                                            ft_avatar** avatar);

FT_API ft_status ft_avatar_joint_count(const ft_avatar* avatar, size_t* count);
/* Stores the name in *name; it lives as long as the avatar. */
FT_API ft_status ft_avatar_joint_name(const ft_avatar* avatar, int32_t joint, const char** name);
/* -1: a root. */
FT_API ft_status ft_avatar_joint_parent(const ft_avatar* avatar, int32_t joint, int32_t* parent);
/* FT_ERROR_UNKNOWN_NAME if no joint has this name. O(joints). */
FT_API ft_status ft_avatar_find_joint(const ft_avatar* avatar, const char* name, int32_t* joint);
/* Rotations (4 per joint) and translations (3 per joint) of the rest pose; either may be NULL.
 * `capacity` and `required` are in joints. */
FT_API ft_status ft_avatar_rest_pose(const ft_avatar* avatar, double* rotations,
                                     double* translations, size_t capacity, size_t* required);
FT_API void ft_avatar_destroy(ft_avatar* avatar);

/* ---- Poses and clips ---- */

/* Every joint in its parent's frame; roots in W. */
typedef struct ft_pose {
  uint32_t size;
  uint32_t joint_count; /* the avatar's */
  const double*
      rotations; /* w, x, y, z per joint, norm within 1e-3 of 1; replace the rest rotations */
  const double* translations; /* x, y, z per joint; replace the offsets; NULL: the offsets */
} ft_pose;

FT_API ft_status ft_pose_init(ft_pose* pose, size_t size);

/* Axes and units of an engine's floats, and their conversion; quaternions in the order
 * x, y, z, w. */
enum {
  FT_AXES_Y_UP_RIGHT = 0, /* metres, as here: Godot, OpenXR, glTF */
  FT_AXES_Y_UP_LEFT = 1,  /* metres, left-handed: Unity. Negates z */
  FT_AXES_Z_UP_LEFT = 2   /* centimetres, left-handed: Unreal. (x, y, z) becomes (x, z, y) / 100 */
};

/* `count` triples or quadruples; NULL with count 0 is legal. Passes non-finite numbers on. O(n). */
FT_API ft_status ft_positions_from_floats(const float* xyz, size_t count, int32_t axes,
                                          double* positions);
FT_API ft_status ft_positions_to_floats(const double* positions, size_t count, int32_t axes,
                                        float* xyz);
FT_API ft_status ft_rotations_from_floats(const float* xyzw, size_t count, int32_t axes,
                                          double* wxyz);
FT_API ft_status ft_rotations_to_floats(const double* wxyz, size_t count, int32_t axes,
                                        float* xyzw);

typedef struct ft_clip_options {
  uint32_t size;
  int32_t up;       /* the file's, as in ft_import_options */
  double scale;     /* as in ft_import_options */
  double yaw_deg;   /* then turned about +Y, */
  double origin[3]; /* then moved. */
  /* Since FT_ABI_VERSION 11. */
  const char* skeleton; /* for an .amc: its .asf; NULL: the one beside it. For others: NULL */
  double row_rate_hz;   /* poses per second of an .amc or a WebXR session; 0: as the file has it */
} ft_clip_options;

FT_API ft_status ft_clip_options_init(ft_clip_options* options, size_t size);
/* Reads a BVH clip, the first animation of a model (.glb, .gltf, .fbx, .dae, .x) at 30 poses per
 * second, or motions of Acclaim (.amc), Xsens (.mvnx) and WebXR (.json). Its joints drive those of
 * the avatar that have the same name; the others keep their rest pose. Error if no name matches.
 * `options` may be NULL. */
FT_API ft_status ft_clip_create_from_file(const char* path, const ft_avatar* avatar,
                                          const ft_clip_options* options, ft_clip** clip);

typedef struct ft_clip_info {
  uint32_t size;
  int32_t matched_joints; /* joints of the avatar that the clip drives */
  uint64_t frame_count;
  double frame_time_s;
} ft_clip_info;

FT_API ft_status ft_clip_get_info(const ft_clip* clip, ft_clip_info* info);
/* Frame `frame` as a pose of the avatar; otherwise like ft_avatar_rest_pose(). */
FT_API ft_status ft_clip_pose(const ft_clip* clip, size_t frame, double* rotations,
                              double* translations, size_t capacity, size_t* required);
FT_API void ft_clip_destroy(ft_clip* clip);

/* ---- Pair rules: which own links are asked whether they touch each other ---- */

enum {
  FT_PAIR_ASKED = 0,
  FT_PAIR_ADJACENT = 1,     /* one moves the other: between the two is no other link with LSS */
  FT_PAIR_REST_OVERLAP = 2, /* their LSS overlap in the rest pose */
  FT_PAIR_ALWAYS = 3,       /* they touch in nearly all usual poses */
  FT_PAIR_USER = 4          /* the user wants it so */
};

/* Two links, in either order. */
typedef struct ft_link_pair {
  int32_t a, b;
} ft_link_pair;

/* A pair that is left out: a hole in the proof, so it has a reason. */
typedef struct ft_left_out_pair {
  int32_t a, b;
  int32_t reason; /* FT_PAIR_ADJACENT to FT_PAIR_USER */
} ft_left_out_pair;

/* Two LSS whose sum of radii counts as `radius`: less than it is. */
typedef struct ft_pair_radius {
  int32_t a, lss_a, b, lss_b;
  double radius; /* metres, > 0 */
} ft_pair_radius;

typedef struct ft_pair_rule_options {
  uint32_t size;
  int32_t use_pair_radii; /* 1: LSS that overlap at rest count with smaller radii, if they can */
  double rest_skin;       /* metres that these are then apart at rest; default 2e-3 */
  double always_share;    /* of the usual poses, for FT_PAIR_ALWAYS; default 0.95 */
  const double* usual_rotations;    /* w, x, y, z per joint and pose, pose by pose */
  const double* usual_translations; /* x, y, z per joint and pose; NULL: the offsets */
  size_t usual_count;               /* poses that the avatar usually takes; 0: none */
  const ft_link_pair* left_out;     /* by the user */
  size_t left_out_count;
} ft_pair_rule_options;

FT_API ft_status ft_pair_rule_options_init(ft_pair_rule_options* options, size_t size);
/* Leaves out what the enumeration above names; `options` may be NULL. Rules belong to this avatar.
 * Errors: bad options, and rules that leave no pair to ask. O(LSS^2) per pose. */
FT_API ft_status ft_pair_rules_create(const ft_avatar* avatar, const ft_pair_rule_options* options,
                                      ft_pair_rules** rules);
/* All pairs are asked but these, which are left out, and only these LSS have radii of their own. */
FT_API ft_status ft_pair_rules_create_exactly(const ft_avatar* avatar,
                                              const ft_left_out_pair* left_out,
                                              size_t left_out_count, const ft_pair_radius* radii,
                                              size_t radius_count, ft_pair_rules** rules);
/* The other way round: only these pairs are asked, all others are left out (FT_PAIR_USER). Errors:
 * no pair, links that are not there or have no LSS; the index is the link. */
FT_API ft_status ft_pair_rules_create_asking(const ft_avatar* avatar, const ft_link_pair* asked,
                                             size_t asked_count, ft_pair_rules** rules);
/* Reads a file of pair rules (docs/formats.md). */
FT_API ft_status ft_pair_rules_create_from_file(const char* path, const ft_avatar* avatar,
                                                ft_pair_rules** rules);

typedef struct ft_pair_rules_info {
  uint32_t size;
  uint32_t reserved; /* 0 */
  uint64_t pairs;    /* pairs of different links that both have LSS */
  uint64_t asked;    /* how many of these are asked */
  uint64_t left_out, radii;
} ft_pair_rules_info;

FT_API ft_status ft_pair_rules_get_info(const ft_pair_rules* rules, ft_pair_rules_info* info);
/* Sorted by a, then by b; a < b. */
FT_API ft_status ft_pair_rules_left_out(const ft_pair_rules* rules, ft_left_out_pair* pairs,
                                        size_t capacity, size_t* required);
FT_API ft_status ft_pair_rules_radii(const ft_pair_rules* rules, ft_pair_radius* radii,
                                     size_t capacity, size_t* required);
/* In how many of the usual poses two links touch: every pair of links with LSS, by a, then by b.
 * Rules that were not derived from poses have none. */
typedef struct ft_pair_touches {
  int32_t a, b;
  int64_t touches;
} ft_pair_touches;
FT_API ft_status ft_pair_rules_touches(const ft_pair_rules* rules, ft_pair_touches* pairs,
                                       size_t capacity, size_t* required);
FT_API void ft_pair_rules_destroy(ft_pair_rules* rules);

/* ---- Queries: what does each link meet first? ---- */

/* What counts as a link's surface. 1, 2 and 3 were LIMB, AVATAR and ELLIPSOID, volumes around
 * several links: they are refused, and the error says why. */
enum {
  FT_FIDELITY_LINK = 0, /* its LSS */
  FT_FIDELITY_EXACT = 4 /* its triangles, and LSS that contain no triangle */
};
enum {
  FT_SCOPE_EVERY_LINK = 0,      /* every link's own first contact */
  FT_SCOPE_FIRST_OF_AVATAR = 1, /* the links that touch first; others: undecided, after_first */
  FT_SCOPE_EVERY_OBJECT = 2     /* also every link's own first contact with each object
                                   (ft_query_objects); FT_FIDELITY_LINK or _EXACT, no budget */
};
#define FT_EVERY_OBJECT (-1)

/* A link, or a link and one object, whose contacts the query ignores. */
typedef struct ft_ignored_pair {
  int32_t link, object; /* FT_EVERY_OBJECT: ignores the link altogether */
} ft_ignored_pair;

/* One link's own tolerance and fidelity, if links differ. */
typedef struct ft_link_policy {
  double tolerance;
  int32_t fidelity; /* FT_FIDELITY_LINK or FT_FIDELITY_EXACT */
  int32_t reserved; /* 0 */
} ft_link_policy;

#define FT_EVERY_LINK (-1)
#define FT_UNCHANGED (-1)

/* A link's policy for one object, if objects differ. Later policies win; what one leaves out stays
 * as earlier ones set it, or else as for all links. A link's tolerance is the least of those that
 * it has with the objects that it does not ignore. */
typedef struct ft_object_policy {
  int32_t link;     /* or FT_EVERY_LINK */
  int32_t object;   /* or FT_EVERY_OBJECT */
  double tolerance; /* metres, 1e-9 to 1e7; 0: unchanged */
  int32_t fidelity; /* FT_FIDELITY_LINK or _EXACT, only for FT_EVERY_OBJECT; or FT_UNCHANGED */
  int32_t ignore;   /* 1: ignores contacts; 0: no longer ignores them; or FT_UNCHANGED */
} ft_object_policy;

typedef struct ft_query_options {
  uint32_t size;
  int32_t fidelity;     /* default FT_FIDELITY_LINK */
  double tolerance;     /* metres, 1e-9 to 1e7; default 1e-3 */
  uint64_t work_budget; /* per step, in evaluations of a pair (about 10 ns); default UINT64_MAX */
  double deadline_us;   /* per step, by the clock, >= 0; default infinity. Not reproducible */
  int32_t scope;        /* default FT_SCOPE_EVERY_LINK */
  int32_t reserved;     /* 0 */
  const ft_ignored_pair* ignored;
  size_t ignored_count;
  const ft_link_policy* policies; /* one per link, replace tolerance and fidelity; or none */
  size_t policy_count;
  const ft_object_policy* object_policies; /* in order, over all options above; or none */
  size_t object_policy_count;              /* with tolerance or fidelity: not beside policies */
  /* 1: a link that begins within the tolerance of the scene without touching it, and does not
   * approach it, goes on; its first contact is the next one within a quarter of the separation that
   * it began with. So an avatar that was stopped at `toi` can leave again. FT_FIDELITY_LINK or
   * _EXACT. */
  int32_t pass_separating;
  int32_t reserved_end; /* 0 */
} ft_query_options;

FT_API ft_status ft_query_options_init(ft_query_options* options, size_t size);
/* A query of one avatar in one scene; `options` may be NULL. Checks the options. */
FT_API ft_status ft_query_create(const ft_scene* scene, const ft_avatar* avatar,
                                 const ft_query_options* options, ft_query** query);
/* Changes the options and forgets the last step's answer, but not its pose. */
FT_API ft_status ft_query_set_options(ft_query* query, const ft_query_options* options);
/* Asks whether own links touch, too; NULL: no longer. The rules stay when options change, which
 * must then be FT_FIDELITY_LINK or _EXACT (without radii), and not FT_SCOPE_FIRST_OF_AVATAR.
 * Forgets the last step's answer, but not its pose. The query keeps no handle of the rules. */
FT_API ft_status ft_query_set_pair_rules(ft_query* query, const ft_pair_rules* rules);

/* Answers the motion from one pose to another: every joint turns at constant rate on the shorter
 * arc, translations are linear, links follow down the chain. `from` NULL: from where the last step
 * ended (FT_ERROR_NO_STEP if there was none). Allocates nothing once memory has grown to the
 * scene's needs. A step that fails leaves the query unchanged. Cost: docs/performance.md. */
FT_API ft_status ft_query_step(ft_query* query, const ft_pose* from, const ft_pose* to);

enum {
  FT_VERDICT_CLEAR = 0,             /* proven: touches nothing on [0, 1] */
  FT_VERDICT_CONTACT = 1,           /* free on [0, toi); at toi within the tolerance */
  FT_VERDICT_STARTS_IN_CONTACT = 2, /* touches at t = 0; toi is 0 */
  FT_VERDICT_UNDECIDED = 3          /* free on [0, free_until), nothing claimed after it */
};
enum {
  FT_REASON_NONE = 0,
  FT_REASON_WORK_BUDGET = 1, /* or the deadline */
  FT_REASON_RESOLUTION = 2,  /* doubles cannot resolve the tolerance at these coordinates */
  FT_REASON_GAP = 4,         /* in events only: a body is silent, and where it is is unknown */
  FT_REASON_AFTER_FIRST = 3  /* FT_SCOPE_FIRST_OF_AVATAR: another link's contact is earlier */
};
enum { FT_FEATURE_VERTEX = 0, FT_FEATURE_EDGE = 1, FT_FEATURE_FACE = 2 };

/* What one link meets first. Sound: toi and free_until never exceed the true time of contact. In
 * arrays, the first element's size applies to all, and the library sets the others'. Triangles have
 * no inside, so how deep they are at the start is not known: penetration is NaN then, here and in
 * ft_world_contact and ft_event. */
typedef struct ft_contact {
  uint32_t size;
  int32_t link;
  int32_t verdict;
  int32_t reason;        /* for FT_VERDICT_UNDECIDED */
  double toi;            /* time of impact, [0, 1], rounded down; valid for contacts */
  double free_until;     /* toi for contacts, 1 for clear */
  double separation;     /* metres at toi */
  double penetration;    /* metres, for FT_VERDICT_STARTS_IN_CONTACT; NaN: not known */
  double point_scene[3]; /* witness point on the triangle, W */
  double point_link[3];  /* witness point on the link's surface, W */
  double normal[3];      /* unit, from the scene to the link, W */
  int32_t triangle;      /* -1: none */
  int32_t object;        /* the triangle's; -1: none */
  int32_t lss;           /* which of the link's LSS; -1: none */
  int32_t link_triangle; /* at exact fidelity, which of the link's triangles; else -1 */
  int32_t link_feature, scene_feature; /* at exact fidelity */
} ft_contact;

/* All links of the last step, in order. O(links). */
FT_API ft_status ft_query_links(const ft_query* query, ft_contact* links, size_t capacity,
                                size_t* required);
/* The links of the last step that are not clear, earliest first (undecided ones at their
 * free_until); at equal times, the lowest link first. O(links log links). */
FT_API ft_status ft_query_contacts(const ft_query* query, ft_contact* contacts, size_t capacity,
                                   size_t* required);

/* With FT_SCOPE_EVERY_OBJECT: the first contact of every link with every object in the last step,
 * in the order of ft_query_contacts(). A link and an object that it does not list never touch,
 * unless it lists the link as undecided: then only before that. FT_ERROR_MISMATCH at other scopes.
 */
FT_API ft_status ft_query_objects(const ft_query* query, ft_contact* contacts, size_t capacity,
                                  size_t* required);

/* The own link that takes the place of the scene in a contact of two own links. */
typedef struct ft_other_link {
  int32_t link; /* above the contact's */
  int32_t lss;  /* which of its LSS; -1: none */
} ft_other_link;

/* All asked pairs of own links of the last step that are not clear, in the order of
 * ft_query_contacts(), then of the other link; every other asked pair is proven clear. In each
 * contact, `point_scene`, `triangle` and `scene_feature` belong to the other link and its mesh,
 * and `object` is -1. FT_ERROR_MISMATCH without pair rules. */
FT_API ft_status ft_query_pairs(const ft_query* query, ft_contact* contacts, ft_other_link* others,
                                size_t capacity, size_t* required);

/* Two points, one of each side, that are near when a contact is made. */
typedef struct ft_contact_point {
  double point_scene[3]; /* W; on the other link, in a contact of two own links */
  double point_link[3];
  double separation;     /* metres, as computed; below 0 where the two overlap */
  int32_t triangle;      /* -1: none, as for the next two */
  int32_t lss;           /* which of the link's LSS */
  int32_t link_triangle; /* at exact fidelity, which of the link's triangles */
  int32_t reserved;      /* 0 */
} ft_contact_point;

#define FT_MOST_CONTACT_POINTS 4

/* More about one contact, at its toi. Velocities in metres per unit of t: divide by the step's
 * seconds. */
typedef struct ft_contact_details {
  uint32_t size;
  int32_t point_count;
  double velocity_scene[3]; /* of the material points at the two witness points; 0 for the scene */
  double velocity_link[3];
  double approach_speed; /* along the normal, above 0 while the two approach; 0 without a normal */
  /* If these two points touch in the rest of the step, within the tolerance from here, they do so
   * at a speed between these along this normal. A lower bound below 0: perhaps they never touch. */
  double approach_lower, approach_upper;
  /* Points of what is within the tolerance: the nearest first, then others far from it and from
   * each other. At FT_FIDELITY_LINK and _EXACT; elsewhere there are none. */
  ft_contact_point points[FT_MOST_CONTACT_POINTS];
} ft_contact_details;

/* The last step's lists of contacts. */
enum {
  FT_LIST_LINKS = 0,    /* ft_query_links() */
  FT_LIST_CONTACTS = 1, /* ft_query_contacts() */
  FT_LIST_OBJECTS = 2,  /* ft_query_objects() */
  FT_LIST_PAIRS = 3     /* ft_query_pairs() */
};

/* Fills as much of `details` as details->size covers, about the contact that `list` has at `index`.
 * Not meant for every contact of every step: it looks at the near pairs once more.
 * FT_ERROR_MISMATCH if the step has no such list, or if nothing is touched there. */
FT_API ft_status ft_query_details(ft_query* query, int32_t list, size_t index,
                                  ft_contact_details* details);

/* A link's place and velocity at one t, in W; velocities per unit of t. */
typedef struct ft_transform {
  double rotation[4], translation[3]; /* w, x, y, z; metres */
  double angular_velocity[3], velocity[3];
} ft_transform;

/* All links at `t` in [0, 1] of the last step's motion; at toi, the avatar's pose as it touches.
 * O(joints). */
FT_API ft_status ft_motion_transforms(ft_query* query, double t, ft_transform* transforms,
                                      size_t capacity, size_t* required);
/* The pose at `t` in [0, 1] of the last step's motion, to begin the next step with: from toi on,
 * say. The given poses at both ends; otherwise like ft_avatar_rest_pose(). */
FT_API ft_status ft_motion_pose(ft_query* query, double t, double* rotations, double* translations,
                                size_t capacity, size_t* required);
/* What a discrete check sees: stores 1 in *touches if the link's surface touches the scene at `t`
 * of the last step's motion, else 0. Uses computed distances, without the promise. */
FT_API ft_status ft_touches_at(ft_query* query, int32_t link, double t, int32_t* touches);

/* Work of the last step, independent of machine load (middleware/contact.h). */
typedef struct ft_counters {
  uint32_t size;
  uint32_t reserved; /* 0 */
  uint64_t nodes, leaves, candidates, cluster_steps, lane_steps, part_steps, advancements;
  uint64_t hierarchy_tests, plane_tests, leaf_tests, states;
  uint64_t rung_tests; /* always 0: the volumes that it counted are gone */
} ft_counters;

FT_API ft_status ft_query_counters(const ft_query* query, ft_counters* counters);
FT_API void ft_query_destroy(ft_query* query);

/* ---- Near: what is a body near to at one pose? ---- */

enum {
  FT_NEAR_REDUCED = 0, /* what a solver of contacts needs: at most 256 features per link */
  FT_NEAR_ALL = 1,     /* every LSS and triangle within reach */
  FT_NEAR_NEAREST = 2  /* the nearest feature of each link */
};

typedef struct ft_near_options {
  uint32_t size;
  int32_t detail; /* default FT_NEAR_REDUCED */
  const ft_ignored_pair* ignored;
  size_t ignored_count;
} ft_near_options;

FT_API ft_status ft_near_options_init(ft_near_options* options, size_t size);
/* Asks about the links' LSS; `options` may be NULL. For one thread. A scene's first ft_near finds
 * the edges over which its surfaces go on flat: they are not features. */
FT_API ft_status ft_near_create(const ft_scene* scene, const ft_avatar* avatar,
                                const ft_near_options* options, ft_near** near_query);

/* Finds what is within `reach` of the links at `pose`: metres, one per link, at most 1e7; below 0:
 * the link is left out. Allocates nothing once memory has grown. A call that fails leaves the last
 * answer, if its arguments were wrong. */
FT_API ft_status ft_near_ask(ft_near* near_query, const ft_pose* pose, const double* reach,
                             size_t reach_count);

/* One place where an LSS of a link is near the scene. In arrays, the first element's size applies
 * to all, and the library sets the others'. */
typedef struct ft_near_feature {
  uint32_t size;
  int32_t link, lss;
  int32_t triangle, object;
  int32_t feature;       /* which part of the triangle: FT_FEATURE_* */
  double along;          /* where the axis' nearest point is, from its end a (0) to b (1) */
  double gap;            /* lower bound on the separation, metres; below 0 where they overlap */
  double point_scene[3]; /* on the triangle, W */
  double point_link[3];  /* on the LSS's surface, W */
  double normal[3];      /* unit, from the scene to the link, W; 0 if the two meet without one */
} ft_near_feature;

/* Where a link's features are among all. */
typedef struct ft_near_range {
  uint64_t first, count;
  int32_t had_more; /* 1: more were near than FT_NEAR_REDUCED keeps; these are the nearest */
  int32_t reserved; /* 0 */
} ft_near_range;

/* The last ft_near_ask()'s features, by link, LSS, gap and triangle. FT_ERROR_NO_STEP before it. */
FT_API ft_status ft_near_features(const ft_near* near_query, ft_near_feature* features,
                                  size_t capacity, size_t* required);
/* One per link, in order. */
FT_API ft_status ft_near_ranges(const ft_near* near_query, ft_near_range* ranges, size_t capacity,
                                size_t* required);
FT_API void ft_near_destroy(ft_near* near_query);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_FORETOUCH_H */
