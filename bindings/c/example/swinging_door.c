/* A dancer, tracked 30 times per second, and a door that swings, known 60 times per second: when
 * does which link meet the door? cc swinging_door.c -lforetouch -lm */
#include <foretouch/world.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST_CONTACTS 64

static const double kTurn = 6.283185307179586;

/* Every call of Foretouch says whether it worked. */
static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

/* A panel of 0.9 by 2 m, in the frame of its hinge. */
static ft_scene* make_door(void) {
  static const double corners[] = {0, 0, 0, -0.9, 0, 0, -0.9, 2, 0, 0, 2, 0};
  static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  ft_scene_arrays arrays;
  ft_scene* scene;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = corners;
  arrays.vertex_count = 4;
  arrays.indices = triangles;
  arrays.triangle_count = 2;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

/* A trunk with one arm. */
static ft_avatar* make_dancer(void) {
  static const char* const names[] = {"trunk", "arm"};
  static const int32_t parents[] = {-1, 0}, links[] = {0, 1};
  static const double offsets[] = {0, 0.9, 0, 0.2, 0.5, 0};
  static const ft_lss lss[] = {{{0, 0, 0}, {0, 0.6, 0}, 0.15}, {{0, 0, 0}, {0.6, 0, 0}, 0.05}};
  ft_avatar_arrays arrays;
  ft_avatar* avatar;
  must(ft_avatar_arrays_init(&arrays, sizeof arrays));
  arrays.joint_count = 2;
  arrays.names = names;
  arrays.parents = parents;
  arrays.offsets = offsets;
  arrays.lss = lss;
  arrays.lss_links = links;
  arrays.lss_count = 2;
  must(ft_avatar_create(&arrays, &avatar));
  return avatar;
}

/* Turns each of `count` joints about y, the i-th by angles[i]. */
static void turn_about_y(const double* angles, int count, double* wxyz) {
  int i;
  for (i = 0; i < count; ++i) {
    wxyz[4 * i] = cos(0.5 * angles[i]);
    wxyz[4 * i + 1] = wxyz[4 * i + 3] = 0.0;
    wxyz[4 * i + 2] = sin(0.5 * angles[i]);
  }
}

/* What the tracker says of the dancer, who turns and swings the arm; and how far the door is open.
 * Yours. */
static void track_dancer(double s, double* rotations) {
  const double angles[] = {0.4 * sin(kTurn * 0.3 * s), 1.2 * sin(kTurn * 0.7 * s)};
  turn_about_y(angles, 2, rotations);
}
static void track_door(double s, double* rotation) {
  const double open = 0.35 * sin(kTurn * 0.5 * s);
  turn_about_y(&open, 1, rotation);
}

/* Prints the contacts of a window, the earliest first; returns how many there are. */
static int print_contacts(const ft_world* world, const ft_avatar* dancer) {
  ft_world_contact contacts[MOST_CONTACTS];
  size_t count, i;
  int met = 0;
  contacts[0].size = sizeof contacts[0];
  must(ft_world_contacts(world, contacts, MOST_CONTACTS, &count));
  for (i = 0; i < count; ++i) {
    const double us = (double)contacts[i].time_us + contacts[i].time_fraction;
    const char* link;
    if (contacts[i].verdict != FT_VERDICT_CONTACT) continue; /* it touched before */
    must(ft_avatar_joint_name(dancer, contacts[i].a.link, &link));
    printf("%.4f s: %s meets the door at (%.3f, %.3f, %.3f)\n", 1e-6 * us, link,
           contacts[i].a.point[0], contacts[i].a.point[1], contacts[i].a.point[2]);
    ++met;
  }
  return met;
}

int main(void) {
  const double hinge[] = {1.3, 0.0, -0.35};
  double turns[8], turn[4];
  int64_t answered = 0, until, us;
  int32_t dancer, door;
  int contacts = 0, windows = 0;
  ft_avatar* avatar;
  ft_scene* panel;
  ft_world* world;
  ft_pose of_dancer, of_door;
  must(FT_CHECK_ABI());
  avatar = make_dancer();
  panel = make_door();
  must(ft_pose_init(&of_dancer, sizeof of_dancer));
  of_dancer.joint_count = 2;
  of_dancer.rotations = turns; /* no translations: those of rest */
  must(ft_pose_init(&of_door, sizeof of_door));
  of_door.joint_count = 1;
  of_door.rotations = turn;
  of_door.translations = hinge;

  must(ft_world_create(NULL, NULL, &world)); /* nothing stands still; the usual options */
  must(ft_world_add_avatar(world, avatar, NULL, &dancer));
  must(ft_world_add_mesh(world, panel, NULL, &door));
  for (us = 0; us <= 4000000; us += 5556) {
    if (us % 33336 == 0) { /* each body with its own clock */
      track_dancer(1e-6 * (double)us, turns);
      must(ft_world_push(world, dancer, us, &of_dancer));
    }
    if (us % 16668 == 0) {
      track_door(1e-6 * (double)us, turn);
      must(ft_world_push(world, door, us, &of_door));
    }
    must(ft_world_known_until(world, &until, NULL));
    if (until <= answered) continue;
    must(ft_world_answer(world, answered, until)); /* all is known until then */
    contacts += print_contacts(world, avatar);
    must(ft_world_forget_before(world, until));
    answered = until;
    ++windows;
  }
  printf("%d contacts in %d windows\n", contacts, windows);

  ft_world_destroy(world);
  ft_scene_destroy(panel);
  ft_avatar_destroy(avatar);
  return contacts > 0 ? 0 : 1;
}
