#include "integrations/godot/native/body.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrations/godot/native/scene.h"

int64_t fail(Body* body, const char* format, ...) {
  va_list list;
  va_start(list, format);
  vsnprintf(body->error, sizeof body->error, format, list);
  va_end(list);
  return -1;
}

int64_t fail_by_library(Body* body) { return fail(body, "%s", ft_last_error()); }

ft_pose as_pose(const Body* body, const Pose* pose) {
  const ft_pose made = {sizeof made, (uint32_t)body->joint_count, pose->rotations, pose->translations};
  return made;
}

uint8_t* bytes_of(Body* body, size_t count) {
  if (count > body->byte_room) {
    uint8_t* bytes = realloc(body->bytes, count);
    if (bytes == NULL) return NULL;
    body->bytes = bytes;
    body->byte_room = count;
  }
  return body->bytes;
}

/* ---- Life ---- */

static void forget_answers(Body* body) {
  body->has_begun = false;
  body->contact_count = body->press_count = 0;
}

static void forget_made(Body* body) {
  ft_query_destroy(body->query);
  ft_solid_destroy(body->solid);
  ft_clip_destroy(body->clip);
  ft_avatar_destroy(body->avatar);
  body->query = NULL;
  body->solid = NULL;
  body->clip = NULL;
  body->avatar = NULL;
  free(body->world);
  free(body->from.rotations);
  free(body->from.translations);
  free(body->to.rotations);
  free(body->to.translations);
  free(body->last.rotations);
  free(body->last.translations);
  free(body->contacts);
  body->world = NULL;
  body->from.rotations = body->from.translations = body->to.rotations = body->to.translations = NULL;
  body->last.rotations = body->last.translations = NULL;
  body->contacts = NULL;
  forget_answers(body);
}

static void forget_joints(Body* body) {
  size_t i;
  for (i = 0; i < body->joint_count; ++i) free(body->joints[i].name);
  free(body->joints);
  free(body->capsules);
  body->joints = NULL;
  body->capsules = NULL;
  body->joint_count = body->capsule_count = 0;
}

static void* create(void* owner) {
  (void)owner;
  return calloc(1, sizeof(Body));
}

static void destroy(void* self) {
  Body* body = self;
  forget_made(body);
  forget_joints(body);
  free(body->presses);
  free(body->bytes);
  free(body);
}

/* What all poses and answers need, for as many joints as there are. */
static bool has_memory(Body* body) {
  const size_t n = body->joint_count;
  body->world = calloc(n, sizeof *body->world);
  body->from.rotations = calloc(4 * n, sizeof(double));
  body->from.translations = calloc(3 * n, sizeof(double));
  body->to.rotations = calloc(4 * n, sizeof(double));
  body->to.translations = calloc(3 * n, sizeof(double));
  body->last.rotations = calloc(4 * n, sizeof(double));
  body->last.translations = calloc(3 * n, sizeof(double));
  body->contacts = calloc(n, sizeof *body->contacts);
  if (body->world != NULL && body->from.rotations != NULL && body->from.translations != NULL &&
      body->to.rotations != NULL && body->to.translations != NULL && body->last.rotations != NULL && body->last.translations != NULL &&
      body->contacts != NULL)
    return true;
  fail(body, "no memory for %zu joints", n);
  return false;
}

/* ---- Joints and capsules ---- */

static void clear(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  (void)arguments;
  (void)result;
  forget_made(body);
  forget_joints(body);
  body->is_of_file = false;
}

static void add_joint(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const int64_t parent = arguments[1].integer;
  Joint* joints;
  result->integer = -1;
  if (body->avatar != NULL || body->joint_count == MOST_JOINTS || parent < -1 || parent >= (int64_t)body->joint_count) {
    fail(body, "joint '%s' has the parent %lld: expected an earlier joint or -1, at most %d joints, and none after build()",
         arguments[0].text, (long long)parent, MOST_JOINTS);
    return;
  }
  joints = realloc(body->joints, (body->joint_count + 1) * sizeof *joints);
  if (joints != NULL) {
    Joint* joint = &joints[body->joint_count];
    body->joints = joints;
    joint->name = malloc(strlen(arguments[0].text) + 1);
    joint->parent = (int32_t)parent;
    joint->bone = arguments[2].integer;
    if (joint->name != NULL) {
      strcpy(joint->name, arguments[0].text);
      result->integer = (int64_t)body->joint_count++;
      return;
    }
  }
  fail(body, "no memory for joint '%s'", arguments[0].text);
}

/* In the frame of its joint, before the joint's scale. */
static void add_capsule(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const int64_t joint = arguments[0].integer;
  const double radius = arguments[3].real;
  Capsule* capsules;
  int i;
  result->boolean = false;
  if (body->avatar != NULL || joint < 0 || joint >= (int64_t)body->joint_count || body->capsule_count == MOST_CAPSULES) {
    fail(body, "a capsule is on joint %lld: expected one that was added, and at most %d capsules", (long long)joint, MOST_CAPSULES);
    return;
  }
  if (!(radius > 0) || !isfinite(radius)) {
    fail(body, "a capsule of '%s' has the radius %g: expected one above 0", body->joints[joint].name, radius);
    return;
  }
  capsules = realloc(body->capsules, (body->capsule_count + 1) * sizeof *capsules);
  if (capsules == NULL) {
    fail(body, "no memory for a capsule");
    return;
  }
  body->capsules = capsules;
  capsules += body->capsule_count++;
  capsules->joint = (int32_t)joint;
  capsules->radius = radius;
  for (i = 0; i < 3; ++i) {
    capsules->a[i] = arguments[1].vector[i];
    capsules->b[i] = arguments[2].vector[i];
  }
  result->boolean = true;
}

/* ---- Poses ---- */

static bool must_be_alive(Body* body, void* node) {
  const bool has_bones = body->bone_count >= 0;
  int64_t bones;
  if (node == NULL || !(has_bones ? host_is_skeleton(node) : host_is_spatial(node))) {
    fail(body, "its %s is missing or was freed", has_bones ? "Skeleton" : "Spatial");
    return false;
  }
  bones = has_bones ? host_bone_count(node) : -1;
  if (bones != body->bone_count) {
    fail(body, "the Skeleton has %lld bones, and had %lld when the body was made of it: call rebuild() after a change",
         (long long)bones, (long long)body->bone_count);
    return false;
  }
  return true;
}

static bool is_place(Body* body, const Affine* from, const char* what, const char* name, Place* into) {
  double s[3];
  if (place_of(from, into, s)) return true;
  fail(body,
       "%s '%s' has the scale (%g, %g, %g) in the world%s: capsules need one scale above zero along all axes. Set its scale, and "
       "those of the nodes and bones above it, to equal numbers, and scale the mesh in its import settings instead",
       what, name, s[0], s[1], s[2],
       fabs(s[0] - s[1]) + fabs(s[0] - s[2]) <= 2 * SCALE_SLACK * s[0] ? ", mirrored or skewed" : "");
  return false;
}

/* World places of all joints, from those that bones have in their skeleton. */
static bool read_world(Body* body, void* node, const float* place) {
  float given[12];
  Affine whole;
  size_t i;
  if (place == NULL) host_node_place(node, given);
  whole = affine_of(place == NULL ? given : place);
  for (i = 0; i < body->joint_count; ++i) {
    const Joint* joint = &body->joints[i];
    Affine at = whole;
    if (joint->bone >= 0) {
      Affine bone;
      host_bone_place(node, joint->bone, given);
      bone = affine_of(given);
      at = affine_product(&whole, &bone);
    }
    if (!is_place(body, &at, joint->bone < 0 ? "node" : "bone", joint->name, &body->world[i])) return false;
  }
  return true;
}

bool read_pose(Body* body, void* node, const float* place, Pose* into) {
  size_t i;
  if (!must_be_alive(body, node) || !read_world(body, node, place)) return false;
  for (i = 0; i < body->joint_count; ++i) {
    const Joint* joint = &body->joints[i];
    Place at = body->world[i];
    if (!(fabs(at.scale - joint->scale) <= 2 * SCALE_SLACK * joint->scale)) {
      fail(body, "the scale of '%s' changed from %g to %g at run time: its capsules are still those of %g. Call rebuild() to take the new one",
           joint->name, joint->scale, at.scale, joint->scale);
      return false;
    }
    if (joint->parent >= 0) {
      Place parent = body->world[joint->parent];
      parent.scale = 1; /* poses are in metres */
      at = place_within(&parent, &at);
    }
    memcpy(into->rotations + 4 * i, at.rotation, sizeof at.rotation);
    memcpy(into->translations + 3 * i, at.position, sizeof at.position);
  }
  return true;
}

/* ---- Making ---- */

static ft_status make_avatar(Body* body) {
  const size_t n = body->joint_count, capsules = body->capsule_count;
  const char** names = malloc(n * sizeof *names);
  int32_t* parents = malloc(n * sizeof *parents);
  ft_lss* lss = malloc((capsules + 1) * sizeof *lss);
  int32_t* links = malloc((capsules + 1) * sizeof *links);
  ft_avatar_arrays arrays;
  ft_status status = ft_avatar_arrays_init(&arrays, sizeof arrays);
  size_t i;
  if (names == NULL || parents == NULL || lss == NULL || links == NULL) status = FT_ERROR_OUT_OF_MEMORY;
  for (i = 0; status == FT_OK && i < n; ++i) {
    names[i] = body->joints[i].name;
    parents[i] = body->joints[i].parent;
  }
  for (i = 0; status == FT_OK && i < capsules; ++i) {
    const Capsule* from = &body->capsules[i];
    const double scale = body->joints[from->joint].scale;
    int k;
    for (k = 0; k < 3; ++k) {
      lss[i].a[k] = scale * from->a[k];
      lss[i].b[k] = scale * from->b[k];
    }
    lss[i].radius = scale * from->radius;
    links[i] = from->joint;
  }
  arrays.joint_count = n;
  arrays.names = names;
  arrays.parents = parents;
  arrays.offsets = body->from.translations;
  arrays.rotations = body->from.rotations;
  arrays.lss = lss;
  arrays.lss_links = links;
  arrays.lss_count = capsules;
  if (status == FT_OK) status = ft_avatar_create(&arrays, &body->avatar);
  free(names);
  free(parents);
  free(lss);
  free(links);
  return status;
}

static bool make_of_node(Body* body, void* node) {
  size_t i;
  body->bone_count = node != NULL && host_is_skeleton(node) ? host_bone_count(node) : -1;
  if (!must_be_alive(body, node)) return false;
  for (i = 0; i < body->joint_count; ++i) {
    if (body->joints[i].bone >= body->bone_count && body->joints[i].bone >= 0) {
      fail(body, "joint '%s' is bone %lld of a Skeleton that has %lld", body->joints[i].name, (long long)body->joints[i].bone,
           (long long)body->bone_count);
      return false;
    }
  }
  if (!has_memory(body) || !read_world(body, node, NULL)) return false;
  for (i = 0; i < body->joint_count; ++i) body->joints[i].scale = body->world[i].scale;
  if (!read_pose(body, node, NULL, &body->from)) return false;
  if (make_avatar(body) == FT_OK) return true;
  fail_by_library(body);
  return false;
}

/* build(Skeleton or Spatial): from the joints and capsules that were added. */
static void build(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  forget_made(body);
  if (body->is_of_file) forget_joints(body);
  body->is_of_file = false;
  result->boolean = false;
  if (body->joint_count == 0 || body->capsule_count == 0) {
    fail(body, "it has no capsules");
    return;
  }
  result->boolean = make_of_node(body, arguments[0].object);
  if (!result->boolean) forget_made(body);
}

/* load(avatar file): its poses come from a clip. */
static void load(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  forget_made(body);
  forget_joints(body);
  result->boolean = false;
  if (ft_avatar_create_from_file(arguments[0].text, NULL, &body->avatar) != FT_OK ||
      ft_avatar_joint_count(body->avatar, &body->joint_count) != FT_OK) {
    fail_by_library(body);
    return;
  }
  body->joints = calloc(body->joint_count, sizeof *body->joints);
  body->is_of_file = true;
  result->boolean = body->joints != NULL && has_memory(body);
  if (result->boolean) return;
  forget_made(body);
  forget_joints(body);
}

static void load_clip(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  ft_clip_info info;
  ft_clip* clip;
  info.size = sizeof info;
  result->integer = -1;
  if (ft_clip_create_from_file(arguments[0].text, body->avatar, NULL, &clip) != FT_OK ||
      ft_clip_get_info(clip, &info) != FT_OK) {
    fail_by_library(body);
    return;
  }
  ft_clip_destroy(body->clip);
  body->clip = clip;
  result->integer = (int64_t)info.frame_count;
}

/* use_scene(FtScene, tolerance): what steps are asked about; the next one begins anew. */
static void use_scene(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const Scene* scene = scene_of_owner(arguments[0].object);
  ft_query_options options;
  ft_query* query;
  result->boolean = false;
  if (scene == NULL || scene_handle(scene) == NULL) {
    fail(body, "expected an FtScene that was built");
    return;
  }
  if (ft_query_options_init(&options, sizeof options) == FT_OK) options.tolerance = arguments[1].real;
  if (ft_query_create(scene_handle(scene), body->avatar, &options, &query) != FT_OK) {
    fail_by_library(body);
    return;
  }
  ft_query_destroy(body->query);
  body->query = query;
  forget_answers(body);
  result->boolean = true;
}

static void capsule_count(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  result->integer = (int64_t)((Body*)self)->capsule_count;
}

static void error(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  result->text = ((Body*)self)->error;
}

static void joint_name(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const int64_t joint = arguments[0].integer;
  if (joint < 0 || joint > INT32_MAX || ft_avatar_joint_name(body->avatar, (int32_t)joint, &result->text) != FT_OK)
    result->text = "";
}

static const Method methods[] = {
    {"clear", KIND_NIL, clear, 0, {KIND_NIL}},
    {"add_joint", KIND_INT, add_joint, 3, {KIND_TEXT, KIND_INT, KIND_INT}},
    {"add_capsule", KIND_BOOL, add_capsule, 4, {KIND_INT, KIND_VECTOR, KIND_VECTOR, KIND_REAL}},
    {"capsule_count", KIND_INT, capsule_count, 0, {KIND_NIL}},
    {"build", KIND_BOOL, build, 1, {KIND_OBJECT}},
    {"load", KIND_BOOL, load, 1, {KIND_TEXT}},
    {"load_clip", KIND_INT, load_clip, 1, {KIND_TEXT}},
    {"use_scene", KIND_BOOL, use_scene, 2, {KIND_OBJECT, KIND_REAL}},
    {"error", KIND_TEXT, error, 0, {KIND_NIL}},
    {"joint_name", KIND_TEXT, joint_name, 1, {KIND_INT}},
    {"step", KIND_INT, body_step, 1, {KIND_OBJECT}},
    {"step_clip", KIND_INT, body_step_clip, 1, {KIND_INT}},
    {"sweep", KIND_INT, body_sweep, 3, {KIND_OBJECT, KIND_PLACE, KIND_PLACE}},
    {"restart", KIND_NIL, body_restart, 0, {KIND_NIL}},
    {"place_of_node_at", KIND_PLACE, place_of_node_at, 1, {KIND_REAL}},
    {"contact_joint", KIND_INT, contact_joint, 1, {KIND_INT}},
    {"contact_object", KIND_INT, contact_object, 1, {KIND_INT}},
    {"contact_verdict", KIND_INT, contact_verdict, 1, {KIND_INT}},
    {"contact_share", KIND_REAL, contact_share, 1, {KIND_INT}},
    {"contact_separation", KIND_REAL, contact_separation, 1, {KIND_INT}},
    {"contact_point", KIND_VECTOR, contact_point, 1, {KIND_INT}},
    {"contact_normal", KIND_VECTOR, contact_normal, 1, {KIND_INT}},
    {"step_bytes", KIND_BYTES, step_bytes, 0, {KIND_NIL}},
    {"make_solid", KIND_BOOL, make_solid, 2, {KIND_OBJECT, KIND_REAL}},
    {"follow", KIND_INT, body_follow, 2, {KIND_OBJECT, KIND_REAL}},
    {"follow_clip", KIND_INT, body_follow_clip, 2, {KIND_INT, KIND_REAL}},
    {"show", KIND_BOOL, body_show, 1, {KIND_OBJECT}},
    {"reset", KIND_NIL, body_reset, 0, {KIND_NIL}},
    {"tick_state", KIND_INT, tick_state, 0, {KIND_NIL}},
    {"tick_deviation", KIND_REAL, tick_deviation, 0, {KIND_NIL}},
    {"tick_is_certified", KIND_BOOL, tick_is_certified, 0, {KIND_NIL}},
    {"press_joint", KIND_INT, press_joint, 1, {KIND_INT}},
    {"press_object", KIND_INT, press_object, 1, {KIND_INT}},
    {"press_point", KIND_VECTOR, press_point, 1, {KIND_INT}},
    {"press_normal", KIND_VECTOR, press_normal, 1, {KIND_INT}},
    {"press_push", KIND_REAL, press_push, 1, {KIND_INT}},
    {"tick_bytes", KIND_BYTES, tick_bytes, 0, {KIND_NIL}},
};
const Class body_class = {"FtBody", create, destroy, methods, sizeof methods / sizeof *methods};
