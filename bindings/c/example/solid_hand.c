/* A hand that stays on a table: the tracked hand goes 6 cm too deep, sweeps along and over the edge,
 * comes back and leaves. Prints what is shown of it, at 90 Hz.
 *   cc solid_hand.c -lforetouch -lm */
#include <foretouch/solid.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define HZ 90.0
#define TOP 0.75
#define EDGE 0.4
#define THICKNESS 0.04
#define MOST_CONTACTS 64

static const char* const kStates[] = {"placing", "equal",  "following", "sliding",
                                      "held",    "around", "snapped"};

/* Every call of Foretouch says whether it worked. */
static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

/* A table's board: x from -0.4 to 0.4, its top at 0.75 m. */
static ft_scene* make_table(void) {
  static const uint32_t corners[] = {0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2,
                                     4, 5, 7, 4, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
  static const char* const names[] = {"table"};
  double positions[24];
  ft_scene_arrays arrays;
  ft_scene* scene;
  int i;
  for (i = 0; i < 8; ++i) {
    positions[3 * i] = (i & 1) != 0 ? EDGE : -EDGE;
    positions[3 * i + 1] = (i & 2) != 0 ? TOP : TOP - THICKNESS;
    positions[3 * i + 2] = (i & 4) != 0 ? 0.3 : -0.3;
  }
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = positions;
  arrays.vertex_count = 8;
  arrays.indices = corners;
  arrays.triangle_count = 12;
  arrays.object_names = names;
  arrays.object_count = 1;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

/* A forearm, tracked at its elbow, with a hand. */
static ft_avatar* make_forearm(void) {
  static const char* const names[] = {"LeftForeArm", "LeftHand"};
  static const int32_t parents[] = {-1, 0}, links[] = {0, 1};
  static const double offsets[] = {0, 0, 0, 0.25, 0, 0};
  static const ft_lss lss[] = {{{0, 0, 0}, {0.25, 0, 0}, 0.04}, {{0, 0, 0}, {0.15, 0, 0}, 0.03}};
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

/* 0 before `begin`, 1 after `end` (seconds), smoothly. */
static double ramp(double t, double begin, double end) {
  double s = (t - begin) / (end - begin);
  s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
  return s * s * (3.0 - 2.0 * s);
}

static void turn_about_z(double angle, double* wxyz) {
  wxyz[0] = cos(0.5 * angle);
  wxyz[1] = wxyz[2] = 0.0;
  wxyz[3] = sin(0.5 * angle);
}

/* What the tracker says. Yours; here an elbow above the board, and a hand below its top. */
static void track(double t, double* rotations, double* translations) {
  const double down = ramp(t, 0.0, 0.8) - ramp(t, 4.2, 5.0);
  const double along = ramp(t, 1.2, 2.4) - ramp(t, 3.2, 4.2);
  translations[0] = -0.5 + 0.6 * along;
  translations[1] = TOP + 0.3 - 0.13 * down;
  translations[2] = 0.0;
  translations[3] = 0.25;
  translations[4] = translations[5] = 0.0;
  turn_about_z(-0.35 - 0.35 * down, rotations);
  turn_about_z(0.4 * down, rotations + 4);
}

/* The tip of the hand, in the world: all of it turns about z. */
static void find_tip(const double* rotations, const double* translations, double* xy) {
  const double arm = 2.0 * atan2(rotations[3], rotations[0]);
  const double hand = arm + 2.0 * atan2(rotations[7], rotations[4]);
  xy[0] = translations[0] + 0.25 * cos(arm) + 0.15 * cos(hand);
  xy[1] = translations[1] + 0.25 * sin(arm) + 0.15 * sin(hand);
}

static double largest_push(const ft_solid* solid) {
  ft_solid_contact contacts[MOST_CONTACTS];
  double push = 0.0;
  size_t count, i;
  contacts[0].size = sizeof contacts[0];
  must(ft_solid_contacts(solid, contacts, MOST_CONTACTS, &count));
  for (i = 0; i < count; ++i) push = contacts[i].push > push ? contacts[i].push : push;
  return push;
}

int main(void) {
  ft_scene* scene;
  ft_avatar* avatar;
  ft_solid* solid;
  ft_solid_tick tick;
  ft_pose pose;
  double rotations[8], translations[6], shown_rotations[8], shown_translations[6];
  double wanted[2], shown[2];
  int frame, touching = 0, moving = 0, proven = 0;
  must(FT_CHECK_ABI());
  scene = make_table();
  avatar = make_forearm();
  must(ft_solid_create(scene, avatar, NULL, &solid)); /* NULL: the usual options */
  must(ft_pose_init(&pose, sizeof pose));
  pose.joint_count = 2;
  pose.rotations = rotations;
  pose.translations = translations;
  tick.size = sizeof tick;

  printf("   s   tracked x, y   shown x, y    state      off mm  push mm\n");
  for (frame = 0; frame <= 5.5 * HZ; ++frame) {
    track(frame / HZ, rotations, translations);
    must(ft_solid_follow(solid, &pose, NULL, 1.0 / HZ, &tick)); /* NULL: no joint is lost */
    must(ft_solid_shown(solid, shown_rotations, shown_translations, 2, NULL)); /* draw these */
    proven += tick.is_certified;
    touching += tick.contact_count > 0;
    moving += tick.state == FT_SOLID_SLIDING;
    if (frame % 30 != 0) continue;
    find_tip(rotations, translations, wanted);
    find_tip(shown_rotations, shown_translations, shown);
    printf("%4.2f  %6.3f %6.3f  %6.3f %6.3f  %-9s  %5.1f  %5.1f\n", frame / HZ, wanted[0],
           wanted[1], shown[0], shown[1], kStates[tick.state], 1e3 * tick.deviation,
           1e3 * largest_push(solid));
  }
  printf("proven free in %d of %d frames, touched in %d, slid in %d; back: %s\n", proven, frame,
         touching, moving, tick.state == FT_SOLID_EQUAL ? "yes" : "no");

  ft_solid_destroy(solid);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return proven == frame && tick.state == FT_SOLID_EQUAL ? 0 : 1;
}
