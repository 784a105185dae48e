/* answers.c: asks the C library for the bundled example's answers and prints every field of each, doubles
 * as their bits. Answers.cs asks the same in C#, and prints the same.
 *   answers FOLDER_OF_EXAMPLES */
#include <stdlib.h>

#include "dump.h" /* generator/generate.py dump */

#define MOST 4096

/* Prints all that one function lists; `list`, MOST and `&count` are its last arguments. */
#define EACH_PLAIN(type, ask)                   \
  do {                                          \
    size_t count, each;                         \
    must(ask);                                  \
    for (each = 0; each < count; ++each) {      \
      printf(#type);                            \
      dump_##type(&list[each]);                 \
      printf("\n");                             \
    }                                           \
  } while (0)
#define EACH(type, ask)             \
  do {                              \
    static type list[MOST];         \
    list[0].size = sizeof list[0];  \
    EACH_PLAIN(type, ask);          \
  } while (0)
#define ONE(type, value)   \
  do {                     \
    printf(#type);         \
    dump_##type(value);    \
    printf("\n");          \
  } while (0)

static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static double rotations[4 * MOST], translations[3 * MOST];
static ft_pose pose = {sizeof(ft_pose), 0, rotations, translations};
static ft_scene* scene;
static ft_avatar* avatar;
static ft_clip* clip;
static size_t joints;

static void load(const char* folder, const char* place, const char* who) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.obj", folder, place);
  must(ft_scene_create_from_file(path, NULL, &scene));
  snprintf(path, sizeof path, "%s/%s.avatar.json", folder, who);
  must(ft_avatar_create_from_file(path, NULL, &avatar));
  snprintf(path, sizeof path, "%s/%s.bvh", folder, who);
  must(ft_clip_create_from_file(path, avatar, NULL, &clip));
  must(ft_avatar_joint_count(avatar, &joints));
  pose.joint_count = (uint32_t)joints;
}

static size_t frames(void) {
  ft_clip_info info;
  info.size = sizeof info;
  must(ft_clip_get_info(clip, &info));
  return info.frame_count;
}

static void at_frame(size_t frame) {
  must(ft_clip_pose(clip, frame, rotations, translations, joints, NULL));
}

static void print_pose(void) {
  size_t i;
  printf("pose");
  for (i = 0; i < 4 * joints; ++i) dump_bits(rotations[i]);
  for (i = 0; i < 3 * joints; ++i) dump_bits(translations[i]);
  printf("\n");
}

static void release(void) {
  ft_clip_destroy(clip);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
}

/* Every link of every step of a clip, what comes after a contact, and the counters. */
static void steps(size_t stride) {
  ft_query* query;
  ft_pair_rules* rules;
  ft_query_options options;
  size_t frame;
  must(ft_query_options_init(&options, sizeof options));
  options.scope = FT_SCOPE_EVERY_OBJECT;
  must(ft_pair_rules_create(avatar, NULL, &rules));
  must(ft_query_create(scene, avatar, &options, &query));
  must(ft_query_set_pair_rules(query, rules));
  at_frame(0);
  must(ft_query_step(query, &pose, &pose));
  for (frame = stride; frame < frames(); frame += stride) {
    static ft_contact contacts[MOST];
    static ft_other_link others[MOST];
    static ft_transform list[MOST];
    size_t found, i;
    at_frame(frame);
    must(ft_query_step(query, NULL, &pose));
    EACH(ft_contact, ft_query_links(query, list, MOST, &count));
    EACH(ft_contact, ft_query_objects(query, list, MOST, &count));
    contacts[0].size = sizeof contacts[0];
    must(ft_query_pairs(query, contacts, others, MOST, &found));
    for (i = 0; i < found; ++i) {
      ONE(ft_contact, &contacts[i]);
      ONE(ft_other_link, &others[i]);
    }
    must(ft_query_contacts(query, contacts, MOST, &found));
    for (i = 0; i < found && contacts[i].verdict == FT_VERDICT_CONTACT; ++i) {
      ft_contact_details details;
      details.size = sizeof details;
      must(ft_query_details(query, FT_LIST_CONTACTS, i, &details));
      ONE(ft_contact_details, &details);
      EACH_PLAIN(ft_transform, ft_motion_transforms(query, contacts[i].toi, list, MOST, &count));
    }
    {
      ft_counters counters;
      counters.size = sizeof counters;
      must(ft_query_counters(query, &counters));
      ONE(ft_counters, &counters);
    }
  }
  ft_query_destroy(query);
  ft_pair_rules_destroy(rules);
}

/* The solid avatar that follows the clip. */
static void solid(void) {
  ft_solid* shown;
  size_t frame;
  must(ft_solid_create(scene, avatar, NULL, &shown));
  for (frame = 0; frame < frames(); ++frame) {
    ft_solid_tick tick;
    tick.size = sizeof tick;
    at_frame(frame);
    must(ft_solid_follow(shown, &pose, NULL, 1.0 / 60, &tick));
    ONE(ft_solid_tick, &tick);
    must(ft_solid_shown(shown, rotations, translations, joints, NULL));
    print_pose();
    EACH(ft_solid_joint, ft_solid_joints(shown, list, MOST, &count));
    EACH(ft_solid_contact, ft_solid_contacts(shown, list, MOST, &count));
  }
  ft_solid_destroy(shown);
}

static const double kPanel[] = {0, 0, 0, -0.9, 0, 0, -0.9, 2, 0, 0, 2, 0};
static const uint32_t kTriangles[] = {0, 1, 2, 0, 2, 3};

static ft_scene* panel(void) {
  ft_scene_arrays arrays;
  ft_scene* made;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = kPanel;
  arrays.vertex_count = 4;
  arrays.indices = kTriangles;
  arrays.triangle_count = 2;
  must(ft_scene_create(&arrays, &made));
  return made;
}

/* Where the panel is in its frame k: by rational numbers, so that no library's sine counts. */
static ft_pose panel_at(int k, double* turn, double* place) {
  ft_pose at;
  const double p = 0.01 * (k % 100), norm = 1 + p * p;
  turn[0] = (1 - p * p) / norm; /* about +Y */
  turn[1] = turn[3] = 0;
  turn[2] = 2 * p / norm;
  place[0] = 0.02 * (k % 50);
  place[1] = 0;
  place[2] = -0.3;
  must(ft_pose_init(&at, sizeof at));
  at.joint_count = 1;
  at.rotations = turn;
  at.translations = place;
  return at;
}

/* A ball cast through the world, at whom its player saw, and one that flies. */
static void ask(ft_world* moving, int32_t body, int32_t door, int64_t until) {
  ft_ask_part part = {0, FT_EVERY_LINK, FT_EVERY_OBJECT};
  ft_ask_instant instant = {0, 0, 0, 0.5};
  ft_ask_whom whom;
  ft_question question, many[2];
  ft_probed probed[2];
  ft_flight flight;
  ft_flight_hit hit;
  must(ft_ask_whom_init(&whom, sizeof whom));
  must(ft_question_init(&question, sizeof question));
  must(ft_flight_init(&flight, sizeof flight));
  question.which = FT_ASK_ALL;
  question.shape.a[0] = question.shape.b[0] = -2;
  question.shape.a[1] = question.shape.b[1] = 1;
  question.shape.a[2] = question.shape.b[2] = 0.1;
  question.shape.radius = 0.02;
  question.direction[0] = 1;
  question.reach = 9;
  question.time_us = until - 700;
  must(ft_world_probe(moving, &question, NULL));
  EACH(ft_world_hit, ft_world_hits(moving, list, MOST, &count));
  part.body = door;
  instant.body = body;
  instant.time_us = until - 900;
  whom.without = &part;
  whom.without_count = 1;
  question.whom = &whom;
  question.instants = &instant;
  question.instant_count = 1;
  must(ft_world_probe(moving, &question, NULL));
  EACH(ft_world_hit, ft_world_hits(moving, list, MOST, &count));
  EACH(ft_unknown_body, ft_world_unknown(moving, list, MOST, &count));
  many[0] = many[1] = question;
  many[1].which = FT_ASK_CLOSEST;
  many[1].solids = 1;
  must(ft_world_probe_many(moving, many, 2, probed));
  ONE(ft_probed, &probed[0]);
  ONE(ft_probed, &probed[1]);
  EACH(ft_world_hit, ft_world_hits(moving, list, MOST, &count));
  flight.shape = question.shape;
  flight.way[0] = 3;
  flight.from_us = until - 900;
  flight.to_us = until;
  hit.size = sizeof hit;
  must(ft_world_fly(moving, &flight, &hit));
  ONE(ft_flight_hit, &hit);
}

/* The avatar and a panel in a world: contacts, then events, parts and a trigger's. */
static void world(size_t stride, int64_t us_per_frame) {
  const double half[3] = {0.5, 1, 0.5};
  double turn[4], place[3];
  int64_t until, at = 0;
  int32_t body, door, trigger, box;
  ft_world* moving;
  ft_scene* mesh = panel();
  ft_pose here;
  size_t frame;
  must(ft_world_create(scene, NULL, &moving));
  must(ft_world_add_avatar(moving, avatar, NULL, &body));
  must(ft_world_add_mesh(moving, mesh, NULL, &door));
  must(ft_world_add_trigger_box(moving, half, NULL, &trigger, &box));
  must(ft_world_watch(moving, trigger, body, FT_EVERY_LINK));
  here = panel_at(0, turn, place);
  must(ft_world_stand_trigger(moving, trigger, 0, &here));
  must(ft_world_follow_from(moving, 0, NULL));
  must(ft_world_weigh_avatar(moving, body, 70));
  for (frame = 0; frame < frames(); frame += stride, at += (int64_t)stride * us_per_frame) {
    ft_pose swung = panel_at((int)frame, turn, place);
    at_frame(frame);
    must(ft_world_push(moving, body, at, &pose));
    must(ft_world_push(moving, door, at + 500, &swung));
    if (frame == 0) continue;
    must(ft_world_known_until(moving, &until, NULL));
    must(ft_world_answer(moving, until - (int64_t)stride * us_per_frame, until));
    EACH(ft_world_contact, ft_world_contacts(moving, list, MOST, &count));
    must(ft_world_follow(moving, until));
    EACH(ft_event, ft_world_events(moving, list, MOST, &count));
    EACH(ft_part, ft_world_parts(moving, list, MOST, &count));
    EACH(ft_part, ft_world_open_parts(moving, list, MOST, &count));
    EACH(ft_trigger_event, ft_world_trigger_events(moving, list, MOST, &count));
    EACH(ft_occupant, ft_world_occupants(moving, list, MOST, &count));
    {
      ft_depth_question question = {sizeof question, 0, FT_EVERY_LINK, 0, FT_EVERY_LINK, 0, 0, 0.25};
      ft_depth depth;
      depth.size = sizeof depth;
      question.body = body;
      question.from_body = door;
      question.time_us = until - 1000;
      must(ft_world_depth(moving, &question, &depth));
      ONE(ft_depth, &depth);
    }
    ask(moving, body, door, until);
    must(ft_world_thin_before(moving, until - (int64_t)stride * us_per_frame, 1e-3));
    must(ft_world_forget_before(moving, until - (int64_t)stride * us_per_frame));
  }
  ft_world_destroy(moving);
  ft_scene_destroy(mesh);
}

/* The solid avatar beside a panel that swings into it. */
static void solid_world(void) {
  double turn[4], place[3];
  int32_t body, door, assumed;
  ft_world* moving;
  ft_scene* mesh = panel();
  size_t frame;
  must(ft_solid_world_create(scene, 0, FT_SOLID_REACH_SKIN, NULL, &moving));
  must(ft_solid_world_add(moving, avatar, NULL, NULL, &body));
  must(ft_world_add_mesh(moving, mesh, NULL, &door));
  for (frame = 0; frame < frames(); ++frame) {
    const int64_t us = 16667 * (int64_t)(frame + 1);
    const ft_solid_target target = {0, 0, &pose, NULL};
    ft_solid_tick tick;
    ft_pose swung = panel_at((int)frame, turn, place);
    tick.size = sizeof tick;
    if (frame == 0) must(ft_world_push(moving, door, 0, &swung));
    must(ft_world_push(moving, door, us, &swung));
    at_frame(frame);
    must(ft_solid_world_tick(moving, us, &target, 1));
    must(ft_solid_world_get_tick(moving, body, &tick, &assumed));
    ONE(ft_solid_tick, &tick);
    must(ft_solid_world_shown(moving, body, rotations, translations, joints, NULL));
    print_pose();
    EACH(ft_solid_contact, ft_solid_world_contacts(moving, body, list, MOST, &count));
    EACH(ft_solid_body_contact, ft_solid_world_body_contacts(moving, body, list, MOST, &count));
    EACH(ft_solid_crush, ft_solid_world_crushes(moving, body, list, MOST, &count));
    must(ft_world_follow(moving, us));
    EACH(ft_event, ft_world_events(moving, list, MOST, &count));
    must(ft_world_forget_before(moving, us));
  }
  ft_world_destroy(moving);
  ft_scene_destroy(mesh);
}

/* What is near, and what a person may have touched. */
static void near_and_person(void) {
  static double reach[MOST];
  static double later_rotations[4 * MOST], later_translations[3 * MOST];
  static ft_link_bound bounds[MOST];
  ft_pose later = pose;
  ft_near* near_query;
  ft_brackets* brackets;
  size_t frame, i;
  for (i = 0; i < joints; ++i) {
    reach[i] = 0.05;
    must(ft_link_bound_init(&bounds[i]));
    bounds[i].acceleration = 20;
  }
  later.rotations = later_rotations;
  later.translations = later_translations;
  must(ft_near_create(scene, avatar, NULL, &near_query));
  must(ft_brackets_create(scene, avatar, NULL, &brackets));
  for (frame = 0; frame + 6 < frames(); frame += 6) {
    static ft_near_range list[MOST];
    ft_posed_step step;
    at_frame(frame);
    must(ft_near_ask(near_query, &pose, reach, joints));
    EACH(ft_near_feature, ft_near_features(near_query, list, MOST, &count));
    EACH_PLAIN(ft_near_range, ft_near_ranges(near_query, list, MOST, &count));
    must(ft_posed_step_init(&step, sizeof step));
    must(ft_clip_pose(clip, frame + 6, later_rotations, later_translations, joints, NULL));
    step.from = &pose;
    step.to = &later;
    step.seconds = 0.1;
    must(ft_brackets_answer(brackets, &step, bounds, joints));
    EACH(ft_link_bracket, ft_brackets_links(brackets, list, MOST, &count));
  }
  ft_near_destroy(near_query);
  ft_brackets_destroy(brackets);
}

/* The avatar as a robot: edges between configurations that both languages draw alike, and a path of them. */
static void edges(void) {
  enum { EDGES = 200 };
  static ft_robot_joint kinds[MOST];
  static double q[EDGES * 64];
  static ft_edge answers[EDGES];
  uint32_t drawn = 1;
  ft_robot* robot;
  ft_edges* asked;
  ft_path path;
  size_t coordinates, i;
  for (i = 0; i < joints; ++i) {
    kinds[i].kind = i == 0 ? FT_JOINT_PLANAR : FT_JOINT_CONTINUOUS;
    kinds[i].mimic_of = -1;
    kinds[i].axis[i == 0 ? 1 : 2] = 1; /* the base turns, the arm swings down */
  }
  must(ft_robot_create(avatar, kinds, joints, NULL, &robot));
  must(ft_robot_coordinate_count(robot, &coordinates));
  for (i = 0; i < EDGES * coordinates; ++i) {
    drawn = 1664525 * drawn + 1013904223;
    q[i] = ((double)(drawn >> 8) / 16777216 - 0.5) * 2;
  }
  must(ft_edges_create(robot, scene, NULL, &asked));
  answers[0].size = sizeof answers[0];
  must(ft_edges_answer(asked, q, q + coordinates, EDGES - 1, coordinates, answers));
  for (i = 0; i < EDGES - 1; ++i) {
    ft_contact contact;
    ft_other_link other;
    contact.size = sizeof contact;
    ONE(ft_edge, &answers[i]);
    if (answers[i].verdict == FT_VERDICT_CLEAR) continue;
    must(ft_edges_contact(asked, i, &contact, &other));
    ONE(ft_contact, &contact);
    ONE(ft_other_link, &other);
  }
  path.size = sizeof path;
  must(ft_edges_answer_path(asked, q, EDGES, coordinates, &path));
  ONE(ft_path, &path);
  must(ft_robot_pose(robot, q, coordinates, rotations, translations, joints, NULL));
  print_pose();
  ft_edges_destroy(asked);
  ft_robot_destroy(robot);
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  load(arguments[1], "room", "dancer");
  steps(1);
  world(6, 16667);
  near_and_person();
  release();
  load(arguments[1], "desk", "hand");
  steps(1);
  world(1, 16667);
  solid();
  solid_world();
  near_and_person();
  edges();
  release();
  return 0;
}
