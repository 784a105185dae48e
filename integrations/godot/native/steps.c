/* steps.c: what a body meets between two places. */
#include <string.h>

#include "integrations/godot/native/body.h"

/* Contacts of the step that was just asked, their number, or -1. */
static int64_t answered(Body* body) {
  body->contacts[0].size = sizeof *body->contacts;
  if (ft_query_contacts(body->query, body->contacts, body->joint_count, &body->contact_count) == FT_OK)
    return (int64_t)body->contact_count;
  body->contact_count = 0;
  return fail_by_library(body);
}

static bool can_step(Body* body, bool can_pose) {
  body->contact_count = 0;
  if (body->query != NULL && can_pose) return true;
  fail(body, "it was not made: build() or load() with load_clip(), and use_scene(), come first");
  return false;
}

/* From where the last step ended to `body->to`. The first only begins. What went wrong before, and so is
 * not known, is not swept through. */
static int64_t step_on(Body* body, bool goes_on) {
  const ft_pose last = as_pose(body, &body->last), to = as_pose(body, &body->to);
  const ft_pose* from = !goes_on ? &to : body->was_swept ? &last : NULL;
  if (ft_query_step(body->query, from, &to) != FT_OK) return fail_by_library(body);
  memcpy(body->last.rotations, body->to.rotations, 4 * body->joint_count * sizeof(double));
  memcpy(body->last.translations, body->to.translations, 3 * body->joint_count * sizeof(double));
  body->has_begun = true;
  body->was_swept = false;
  return goes_on ? answered(body) : 0;
}

/* step(Skeleton or Spatial): from where it was at the last step to where it is. */
void body_step(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const bool goes_on = body->has_begun;
  body->has_begun = false;
  result->integer = -1;
  if (can_step(body, !body->is_of_file) && read_pose(body, arguments[0].object, NULL, &body->to))
    result->integer = step_on(body, goes_on);
}

/* step_clip(frame): the same, to a frame of the clip. */
void body_step_clip(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const bool goes_on = body->has_begun;
  body->has_begun = false;
  result->integer = -1;
  if (!can_step(body, body->clip != NULL)) return;
  if (arguments[0].integer < 0 ||
      ft_clip_pose(body->clip, (size_t)arguments[0].integer, body->to.rotations, body->to.translations, body->joint_count,
                   NULL) != FT_OK) {
    result->integer = fail_by_library(body);
    return;
  }
  result->integer = step_on(body, goes_on);
}

/* The node whose joint 0 is read, seen from there. */
static bool read_node(Body* body, const float* from) {
  const Affine whole = affine_of(from);
  Place node;
  double scales[3];
  if (!place_of(&whole, &node, scales)) {
    fail(body, "the place to go from has the scale (%g, %g, %g): expected one above zero along all axes", scales[0], scales[1],
         scales[2]);
    return false;
  }
  body->node = place_within(&body->world[0], &node);
  return true;
}

/* sweep(Skeleton or Spatial, from, to): as if the node went from one place to the other, bones as they are.
 * Steps go on as if it had not been asked. */
void body_sweep(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  ft_pose from, to;
  body->was_swept = true;
  result->integer = -1;
  if (!can_step(body, !body->is_of_file) || !read_pose(body, arguments[0].object, arguments[1].place, &body->from) ||
      !read_node(body, arguments[1].place) || !read_pose(body, arguments[0].object, arguments[2].place, &body->to))
    return;
  from = as_pose(body, &body->from);
  to = as_pose(body, &body->to);
  result->integer = ft_query_step(body->query, &from, &to) == FT_OK ? answered(body) : fail_by_library(body);
}

/* After a teleport: the next step begins anew. */
void body_restart(void* self, const Value* arguments, Value* result) {
  (void)arguments;
  (void)result;
  ((Body*)self)->has_begun = false;
}

/* place_of_node_at(share): where the node is at that share of the last sweep. */
void place_of_node_at(void* self, const Value* arguments, Value* result) {
  static const Place identity = {{1, 0, 0, 0}, {0, 0, 0}, 1};
  Body* body = self;
  Place place = identity;
  if (body->query != NULL && !body->is_of_file &&
      ft_motion_pose(body->query, arguments[0].real, body->from.rotations, body->from.translations, body->joint_count, NULL) ==
          FT_OK) {
    memcpy(place.rotation, body->from.rotations, sizeof place.rotation);
    memcpy(place.position, body->from.translations, sizeof place.position);
    place.scale = body->joints[0].scale;
    place = place_product(&place, &body->node);
  }
  place_to_floats(&place, result->place);
}

/* ---- Contacts of the last step, the earliest first ---- */

static const ft_contact* contact(const Body* body, const Value* index) {
  static const ft_contact none = {sizeof none, -1, FT_VERDICT_UNDECIDED, 0, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, -1, -1, -1, -1, 0, 0};
  return index->integer < 0 || (size_t)index->integer >= body->contact_count ? &none : &body->contacts[index->integer];
}

static void to_floats(const double from[3], float to[3]) {
  int i;
  for (i = 0; i < 3; ++i) to[i] = (float)from[i];
}

void contact_joint(void* self, const Value* arguments, Value* result) { result->integer = contact(self, arguments)->link; }
void contact_object(void* self, const Value* arguments, Value* result) { result->integer = contact(self, arguments)->object; }
void contact_verdict(void* self, const Value* arguments, Value* result) {
  result->integer = contact(self, arguments)->verdict;
}
/* Free before this share of the step. */
void contact_share(void* self, const Value* arguments, Value* result) {
  const ft_contact* from = contact(self, arguments);
  result->real = from->verdict == FT_VERDICT_STARTS_IN_CONTACT ? 0 : from->free_until;
}
void contact_separation(void* self, const Value* arguments, Value* result) {
  result->real = contact(self, arguments)->separation;
}
void contact_point(void* self, const Value* arguments, Value* result) {
  to_floats(contact(self, arguments)->point_scene, result->vector);
}
void contact_normal(void* self, const Value* arguments, Value* result) {
  to_floats(contact(self, arguments)->normal, result->vector);
}

/* All of the last step without rounding, for callers that want doubles: the pose it ended with (w, x, y, z per
 * joint, then x, y, z), and ft_contact of foretouch.h per joint, clear ones too. */
void step_bytes(void* self, const Value* arguments, Value* result) {
  Body* body = self;
  const size_t n = body->joint_count;
  const size_t rotations = 4 * n * sizeof(double), translations = 3 * n * sizeof(double), links = n * sizeof(ft_contact);
  uint8_t* bytes;
  (void)arguments;
  if (body->query == NULL || (bytes = bytes_of(body, rotations + translations + links)) == NULL) return;
  memcpy(bytes, body->to.rotations, rotations);
  memcpy(bytes + rotations, body->to.translations, translations);
  body->contacts[0].size = sizeof *body->contacts;
  if (ft_query_links(body->query, body->contacts, n, NULL) != FT_OK) return;
  memcpy(bytes + rotations + translations, body->contacts, links);
  body->contact_count = 0; /* the buffer was theirs */
  result->data = bytes;
  result->count = rotations + translations + links;
}
