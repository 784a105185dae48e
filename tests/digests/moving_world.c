/* All that the C library says of what moves, in digits that keep every bit:
 *   moving_world SCENE AVATAR CLIP world|solid
 * To standard output: two dancers, a door that swings and a trigger, window by window and from
 * enter to leave; or a solid avatar, alone and in a world with that door. */
#include <foretouch/solid_world.h>
#include <foretouch/triggers.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 512
#define TICK_US 33333

static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static void print_numbers(const double* numbers, size_t count) {
  size_t i;
  for (i = 0; i < count; ++i) printf(" %a", numbers[i]);
}

static void print_side(const ft_world_side* side) {
  printf(" | %d %d %d %d %d", (int)side->body, (int)side->link, (int)side->lss, (int)side->triangle,
         (int)side->object);
  print_numbers(side->point, 3);
}

static void print_time(int64_t us, double fraction) {
  printf(" %lld %a", (long long)us, fraction);
}

static void print_window(const ft_world* world) {
  static ft_world_contact contacts[MOST];
  size_t count, i;
  contacts[0].size = sizeof contacts[0];
  must(ft_world_contacts(world, contacts, MOST, &count));
  for (i = 0; i < count; ++i) {
    const ft_world_contact* const c = &contacts[i];
    printf("contact %d %d %d", (int)c->verdict, (int)c->reason, (int)c->is_assumed);
    print_time(c->time_us, c->time_fraction);
    print_numbers(&c->separation, 1);
    print_numbers(&c->penetration, 1);
    print_numbers(c->normal, 3);
    print_side(&c->a);
    print_side(&c->b);
    printf("\n");
  }
}

static void print_event(const ft_event* e) {
  int i;
  printf("event %d %d %d %d", (int)e->kind, (int)e->cause, (int)e->reason, (int)e->is_assumed);
  print_time(e->time_us, e->time_fraction);
  print_time(e->since_us, e->since_fraction);
  print_numbers(&e->separation, 1);
  print_numbers(&e->penetration, 1);
  print_numbers(e->normal, 3);
  print_numbers(e->velocity, 3);
  print_numbers(&e->approach_speed, 1);
  print_numbers(&e->approach_lower, 1);
  print_numbers(&e->approach_upper, 1);
  print_numbers(&e->effective_mass, 1);
  print_side(&e->a);
  print_side(&e->b);
  for (i = 0; i < e->point_count; ++i) {
    print_numbers(e->points[i].point_a, 3);
    print_numbers(e->points[i].point_b, 3);
    print_numbers(&e->points[i].separation, 1);
  }
  printf("\n");
}

static void print_events(const ft_world* world) {
  static ft_event events[MOST];
  static ft_part parts[MOST];
  size_t count, i;
  events[0].size = sizeof events[0];
  must(ft_world_events(world, events, MOST, &count));
  for (i = 0; i < count; ++i) print_event(&events[i]);
  parts[0].size = sizeof parts[0];
  must(ft_world_parts(world, parts, MOST, &count));
  for (i = 0; i < count; ++i) {
    printf("part %d %d %d %d", (int)parts[i].is_contact, (int)parts[i].reason,
           (int)parts[i].began_before, (int)parts[i].goes_on);
    print_time(parts[i].from_us, parts[i].from_fraction);
    print_time(parts[i].to_us, parts[i].to_fraction);
    print_side(&parts[i].a);
    print_side(&parts[i].b);
    printf("\n");
  }
}

static void print_triggers(const ft_world* world) {
  static ft_trigger_event events[MOST];
  size_t count, i;
  events[0].size = sizeof events[0];
  must(ft_world_trigger_events(world, events, MOST, &count));
  for (i = 0; i < count; ++i) {
    printf("trigger %d %d %d %d", (int)events[i].kind, (int)events[i].trigger, (int)events[i].body,
           (int)events[i].link);
    print_time(events[i].time_us, events[i].time_fraction);
    print_time(events[i].since_us, events[i].since_fraction);
    printf("\n");
  }
}

/* ---- What moves ---- */

/* A clip's frames, and a panel that swings. */
typedef struct stage {
  ft_scene *room, *panel;
  ft_avatar* avatar;
  ft_clip* clip;
  size_t joints;
  double *rotations, *translations, turn[4];
  ft_pose dancer, door;
} stage;

static const double kHinge[] = {-0.35, 0.0, -0.35};

static ft_scene* make_panel(void) {
  static const double corners[] = {0, 0, 0, 0.9, 0, 0, 0.9, 2, 0, 0, 2, 0};
  static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  ft_scene_arrays arrays;
  ft_scene* panel;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = corners;
  arrays.vertex_count = 4;
  arrays.indices = triangles;
  arrays.triangle_count = 2;
  must(ft_scene_create(&arrays, &panel));
  return panel;
}

static void set_up(stage* s, char** paths) {
  ft_import_options meshes;
  must(ft_import_options_init(&meshes, sizeof meshes));
  must(ft_scene_create_from_file(paths[0], NULL, &s->room));
  must(ft_avatar_create_from_file(paths[1], &meshes, &s->avatar));
  must(ft_clip_create_from_file(paths[2], s->avatar, NULL, &s->clip));
  must(ft_avatar_joint_count(s->avatar, &s->joints));
  s->panel = make_panel();
  s->rotations = calloc(4 * s->joints, sizeof *s->rotations);
  s->translations = calloc(3 * s->joints, sizeof *s->translations);
  must(ft_pose_init(&s->dancer, sizeof s->dancer));
  s->dancer.joint_count = (uint32_t)s->joints;
  s->dancer.rotations = s->rotations;
  s->dancer.translations = s->translations;
  must(ft_pose_init(&s->door, sizeof s->door));
  s->door.joint_count = 1;
  s->door.rotations = s->turn;
  s->door.translations = kHinge;
}

static void tear_down(stage* s) {
  free(s->rotations);
  free(s->translations);
  ft_scene_destroy(s->panel);
  ft_clip_destroy(s->clip);
  ft_avatar_destroy(s->avatar);
  ft_scene_destroy(s->room);
}

static const ft_pose* dancer_at(stage* s, size_t frame, double x, double z) {
  must(ft_clip_pose(s->clip, frame, s->rotations, s->translations, s->joints, NULL));
  s->translations[0] += x;
  s->translations[2] += z;
  return &s->dancer;
}

static const ft_pose* door_at(stage* s, int tick) {
  const double angle = 2.2 + sin(0.2 * tick);
  s->turn[0] = cos(0.5 * angle);
  s->turn[1] = s->turn[3] = 0.0;
  s->turn[2] = sin(0.5 * angle);
  return &s->door;
}

static void follow_world(stage* s) {
  static const double half[] = {0.5, 1.0, 0.3};
  ft_world* world;
  int32_t anna, ben, door, watched;
  int tick;
  must(ft_world_create(s->room, NULL, &world));
  must(ft_world_add_avatar(world, s->avatar, NULL, &anna));
  must(ft_world_add_avatar(world, s->avatar, NULL, &ben));
  must(ft_world_add_mesh(world, s->panel, NULL, &door));
  must(ft_world_add_trigger_box(world, half, NULL, NULL, &watched));
  must(ft_world_follow_from(world, 0, NULL));
  must(ft_world_weigh_avatar(world, anna, 58.0));
  for (tick = 0; tick <= 40; ++tick) {
    const int64_t us = tick * (int64_t)TICK_US;
    must(ft_world_push(world, anna, us, dancer_at(s, 240 + 2 * (size_t)tick, 0.0, 0.0)));
    must(ft_world_push(world, ben, us, dancer_at(s, 480 - 3 * (size_t)tick, 0.1, 0.45)));
    must(ft_world_push(world, door, us, door_at(s, tick)));
    must(ft_world_push(world, watched, us, door_at(s, tick)));
    if (tick == 0) continue;
    printf("tick %d\n", tick);
    must(ft_world_answer(world, us - TICK_US, us));
    print_window(world);
    must(ft_world_follow(world, us));
    print_events(world);
    print_triggers(world);
  }
  ft_world_destroy(world);
}

/* ---- What passes through nothing ---- */

static void print_tick(const ft_solid_tick* t) {
  printf("shown %d %d %d %d", (int)t->state, (int)t->limit, (int)t->is_certified,
         (int)t->has_appeared);
  print_numbers(&t->deviation, 1);
  print_numbers(&t->lift, 1);
  print_numbers(&t->clearance, 1);
  printf(" %u %u %u %u %llu", (unsigned)t->queries, (unsigned)t->iterations, (unsigned)t->features,
         (unsigned)t->rows, (unsigned long long)t->work);
}

static void print_pose(const stage* s) {
  print_numbers(s->rotations, 4 * s->joints);
  print_numbers(s->translations, 3 * s->joints);
  printf("\n");
}

static void follow_solid(stage* s) {
  ft_solid* solid;
  ft_solid_tick tick;
  size_t i;
  must(ft_solid_create(s->room, s->avatar, NULL, &solid));
  for (i = 0; i < 40; ++i) {
    tick.size = sizeof tick;
    must(ft_solid_follow(solid, dancer_at(s, 240 + 2 * i, 0.9, 0.4), NULL, 1e-6 * TICK_US, &tick));
    print_tick(&tick);
    must(ft_solid_shown(solid, s->rotations, s->translations, s->joints, NULL));
    print_pose(s);
  }
  ft_solid_destroy(solid);
}

static void follow_solid_world(stage* s) {
  ft_world* world;
  ft_solid_target target = {0, 0, NULL, NULL};
  ft_solid_tick tick;
  int32_t door;
  int i;
  must(ft_solid_world_create(s->room, 0, FT_SOLID_REACH_SKIN, NULL, &world));
  must(ft_solid_world_add(world, s->avatar, NULL, NULL, &target.body));
  must(ft_world_add_mesh(world, s->panel, NULL, &door));
  must(ft_world_push(world, door, 0, door_at(s, 0)));
  for (i = 1; i <= 20; ++i) {
    must(ft_world_push(world, door, i * (int64_t)TICK_US, door_at(s, i)));
    target.pose = dancer_at(s, 480 - 3 * (size_t)i, 0.1, -0.3);
    must(ft_solid_world_tick(world, i * (int64_t)TICK_US, &target, 1));
    tick.size = sizeof tick;
    must(ft_solid_world_get_tick(world, target.body, &tick, NULL));
    print_tick(&tick);
    must(ft_solid_world_shown(world, target.body, s->rotations, s->translations, s->joints, NULL));
    print_pose(s);
    must(ft_world_follow(world, i * (int64_t)TICK_US));
    print_events(world);
  }
  ft_world_destroy(world);
}

int main(int argc, char** argv) {
  stage s;
  if (argc != 5) return 2;
  must(FT_CHECK_ABI());
  set_up(&s, argv + 1);
  if (strcmp(argv[4], "world") == 0) {
    follow_world(&s);
  } else {
    follow_solid(&s);
    follow_solid_world(&s);
  }
  tear_down(&s);
  return 0;
}
