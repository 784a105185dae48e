/* solid.c: the body that is shown in place of the tracked one, and passes through nothing. */
#include <stdlib.h>
#include <string.h>

#include "integrations/godot/native/body.h"
#include "integrations/godot/native/scene.h"

/* What the library takes in one tick: after a longer gap it begins anew. */
static const double longest_tick_s = 10;
/* Twice in one frame. */
static const double shortest_tick_s = 1e-3;

/* make_solid(FtScene, skin): or goes on in another scene, from where it is shown. */
void make_solid(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const Scene* scene = scene_of_owner(arguments[0].object);
  ft_solid_options options;
  ft_status status;
  result->boolean = false;
  body->press_count = 0;
  if (scene == NULL || scene_handle(scene) == NULL) {
    fail(body, "expected an FtScene that was built");
    return;
  }
  if (body->solid != NULL) {
    status = ft_solid_change_scene(body->solid, scene_handle(scene));
  } else {
    status = ft_solid_options_init(&options, sizeof options);
    options.skin = arguments[1].real;
    /* A hand is tracked to the ground and below: no floor lifts it. */
    options.floor = FT_SOLID_FLOOR_HOLD;
    if (status == FT_OK) status = ft_solid_create(scene_handle(scene), body->avatar, &options, &body->solid);
  }
  result->boolean = status == FT_OK;
  if (!result->boolean) fail_by_library(body);
}

static bool has_press_room(Body* body) {
  if (body->tick.contact_count > body->press_room) {
    const size_t room = 2 * (size_t)body->tick.contact_count;
    ft_solid_contact* presses = realloc(body->presses, room * sizeof *presses);
    if (presses == NULL) return false;
    body->presses = presses;
    body->press_room = room;
  }
  return true;
}

/* Follows to `body->to`; the number of surfaces that hold it, or -1. */
static int64_t follow_on(Body* body, double dt_s) {
  const ft_pose to = as_pose(body, &body->to);
  if (!(dt_s >= shortest_tick_s)) dt_s = shortest_tick_s;
  if (dt_s > longest_tick_s) {
    if (ft_solid_reset(body->solid) != FT_OK) return fail_by_library(body);
    dt_s = longest_tick_s;
  }
  body->tick.size = sizeof body->tick;
  if (ft_solid_follow(body->solid, &to, NULL, dt_s, &body->tick) != FT_OK) return fail_by_library(body);
  if (!has_press_room(body)) return fail(body, "no memory for %llu contacts", (unsigned long long)body->tick.contact_count);
  if (body->tick.contact_count == 0) return 0;
  body->presses[0].size = sizeof *body->presses;
  if (ft_solid_contacts(body->solid, body->presses, body->press_room, &body->press_count) != FT_OK)
    return fail_by_library(body);
  return (int64_t)body->press_count;
}

static bool can_follow(Body* body, bool can_pose) {
  body->press_count = 0;
  if (body->solid != NULL && can_pose) return true;
  fail(body, "it was not made: build() or load() with load_clip(), and make_solid(), come first");
  return false;
}

/* follow(Skeleton or Spatial that is tracked, seconds) */
void body_follow(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  result->integer = -1;
  if (can_follow(body, !body->is_of_file) && read_pose(body, arguments[0].object, NULL, &body->to))
    result->integer = follow_on(body, arguments[1].real);
}

void body_follow_clip(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  result->integer = -1;
  if (!can_follow(body, body->clip != NULL)) return;
  if (arguments[0].integer < 0 ||
      ft_clip_pose(body->clip, (size_t)arguments[0].integer, body->to.rotations, body->to.translations, body->joint_count,
                   NULL) != FT_OK)
    result->integer = fail_by_library(body);
  else
    result->integer = follow_on(body, arguments[1].real);
}

/* World places of the shown pose, with the scales that the joints have. */
static bool read_shown(Body* body) {
  size_t i;
  if (body->solid == NULL ||
      ft_solid_shown(body->solid, body->from.rotations, body->from.translations, body->joint_count, NULL) != FT_OK) {
    fail(body, "nothing is shown before the first follow()");
    return false;
  }
  for (i = 0; i < body->joint_count; ++i) {
    const int32_t parent = body->joints[i].parent;
    Place local;
    memcpy(local.rotation, body->from.rotations + 4 * i, sizeof local.rotation);
    memcpy(local.position, body->from.translations + 3 * i, sizeof local.position);
    local.scale = 1;
    if (parent >= 0) {
      Place above = body->world[parent];
      above.scale = 1; /* poses are in metres */
      local = place_product(&above, &local);
    }
    body->world[i] = local;
  }
  for (i = 0; i < body->joint_count; ++i) body->world[i].scale = body->joints[i].scale;
  return true;
}

/* show(Skeleton or Spatial): another than the one that is tracked, with the same bones. */
void body_show(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  void* node = arguments[0].object;
  float floats[12];
  Affine whole;
  Place frame;
  double scales[3];
  size_t i;
  result->boolean = false;
  if (body->is_of_file || node == NULL || !(body->bone_count < 0 ? host_is_spatial(node) : host_is_skeleton(node)) ||
      (body->bone_count >= 0 && host_bone_count(node) != body->bone_count)) {
    fail(body, "what is shown is missing, was freed, or is no %s like the tracked one", body->bone_count < 0 ? "Spatial" : "Skeleton");
    return;
  }
  if (!read_shown(body)) return;
  host_node_place(node, floats);
  whole = affine_of(floats);
  if (!place_of(&whole, &frame, scales)) {
    fail(body, "the node that is shown has the scale (%g, %g, %g) in the world: expected one above zero along all axes", scales[0],
         scales[1], scales[2]);
    return;
  }
  for (i = 0; i < body->joint_count; ++i) {
    const Place in_skeleton = place_within(&frame, &body->world[i]);
    if (body->joints[i].bone < 0) {
      place_to_floats(&body->world[i], floats);
      host_set_node_place(node, floats);
    } else {
      place_to_floats(&in_skeleton, floats);
      host_set_bone_place(node, body->joints[i].bone, floats);
    }
  }
  result->boolean = true;
}

/* After a teleport, or when trackers were gone for long. */
void body_reset(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  (void)arguments;
  (void)result;
  if (body->solid != NULL) ft_solid_reset(body->solid);
  body->press_count = 0;
}

void tick_state(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  result->integer = ((Body*)self)->tick.state;
}
void tick_deviation(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  result->real = ((Body*)self)->tick.deviation;
}
void tick_is_certified(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  result->boolean = ((Body*)self)->tick.is_certified != 0;
}

/* ---- Surfaces that hold it in the last tick ---- */

static const ft_solid_contact* press(const Body* body, const Value* index) {
  static const ft_solid_contact none = {sizeof none, -1, -1, -1, -1, -1, {0, 0, 0}, {0, 0, 0}, 0, 0, 0};
  return index->integer < 0 || (size_t)index->integer >= body->press_count ? &none : &body->presses[index->integer];
}

static void to_floats(const double from[3], float to[3]) {
  int i;
  for (i = 0; i < 3; ++i) to[i] = (float)from[i];
}

void press_joint(void* self, const Value* arguments, Value* result) { result->integer = press(self, arguments)->link; }
void press_object(void* self, const Value* arguments, Value* result) { result->integer = press(self, arguments)->object; }
void press_point(void* self, const Value* arguments, Value* result) {
  to_floats(press(self, arguments)->point, result->vector);
}
void press_normal(void* self, const Value* arguments, Value* result) {
  to_floats(press(self, arguments)->normal, result->vector);
}
void press_push(void* self, const Value* arguments, Value* result) { result->real = press(self, arguments)->push; }

/* All of the last tick without rounding: ft_solid_tick of solid.h, the shown pose (w, x, y, z per joint, then
 * x, y, z), and ft_solid_contact per contact. */
void tick_bytes(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const size_t n = body->joint_count;
  const size_t rotations = 4 * n * sizeof(double), translations = 3 * n * sizeof(double);
  const size_t presses = body->press_count * sizeof *body->presses;
  const size_t count = sizeof body->tick + rotations + translations + presses;
  uint8_t* bytes;
  (void)arguments;
  if (body->solid == NULL || (bytes = bytes_of(body, count)) == NULL ||
      ft_solid_shown(body->solid, body->from.rotations, body->from.translations, n, NULL) != FT_OK)
    return;
  memcpy(bytes, &body->tick, sizeof body->tick);
  memcpy(bytes + sizeof body->tick, body->from.rotations, rotations);
  memcpy(bytes + sizeof body->tick + rotations, body->from.translations, translations);
  if (presses > 0) memcpy(bytes + sizeof body->tick + rotations + translations, body->presses, presses);
  result->data = bytes;
  result->count = count;
}
