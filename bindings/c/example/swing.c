/* A forearm of 30 cm swings about the elbow, towards a pole's edge: first as one step of a quarter
 * turn, then in eight steps, as a stream of poses comes in.
 *   cc swing.c -lforetouch -lm        or        cc swing.c $(pkg-config --cflags --libs foretouch)
 * -lm */
#include <foretouch/foretouch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char* const kVerdicts[] = {"clear", "contact", "starts_in_contact", "undecided"};

/* Every call of Foretouch says whether it worked. */
static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static ft_scene* make_pole(void) {
  static const double positions[] = {0.2, 0, -0.2, 0.2, 2, -0.2, 0.4, 1, -0.4};
  static const uint32_t indices[] = {0, 1, 2};
  static const int32_t objects[] = {0};
  static const char* const names[] = {"pole"};
  ft_scene_arrays arrays;
  ft_scene* scene = NULL;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = positions;
  arrays.vertex_count = 3;
  arrays.indices = indices;
  arrays.triangle_count = 1;
  arrays.objects = objects;
  arrays.object_names = names;
  arrays.object_count = 1;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

static ft_avatar* make_forearm(void) {
  static const char* const names[] = {"forearm"};
  static const int32_t parents[] = {-1};
  static const double offsets[] = {0, 1, 0};
  static const ft_lss lss[] = {{{0, 0, 0}, {0.3, 0, 0}, 0.04}};
  static const int32_t lss_links[] = {0};
  ft_avatar_arrays arrays;
  ft_avatar* avatar = NULL;
  must(ft_avatar_arrays_init(&arrays, sizeof arrays));
  arrays.joint_count = 1;
  arrays.names = names;
  arrays.parents = parents;
  arrays.offsets = offsets;
  arrays.lss = lss;
  arrays.lss_links = lss_links;
  arrays.lss_count = 1;
  must(ft_avatar_create(&arrays, &avatar));
  return avatar;
}

/* The pose in which the forearm is turned by `angle` about +Y; the elbow stays at its offset. */
static ft_pose turned(double angle, double rotation[4]) {
  ft_pose pose;
  must(ft_pose_init(&pose, sizeof pose));
  rotation[0] = cos(0.5 * angle);
  rotation[1] = 0;
  rotation[2] = sin(0.5 * angle);
  rotation[3] = 0;
  pose.joint_count = 1;
  pose.rotations = rotation;
  return pose;
}

static void print(const ft_scene* scene, const ft_contact* contact) {
  const char* object = "nothing";
  if (contact->object >= 0) must(ft_scene_object_name(scene, contact->object, &object));
  printf("%s at t = %.4f, %.2f mm from %s\n", kVerdicts[contact->verdict], contact->toi,
         1000 * contact->separation, object);
}

/* The same swing in steps, until something is met; where the forearm stands then. */
static void swing_in_steps(ft_query* query, const ft_scene* scene, double angle, int steps) {
  double rotation[4];
  int i;
  ft_pose pose = turned(0, rotation);
  must(ft_query_step(query, &pose, &pose));
  for (i = 1; i <= steps; ++i) {
    ft_contact contact;
    size_t count;
    contact.size = sizeof contact;
    pose = turned(angle * i / steps, rotation);
    must(ft_query_step(query, NULL, &pose)); /* from where the last step ended */
    must(ft_query_contacts(query, &contact, 1, &count));
    printf("step %d: ", i);
    if (count == 0) {
      printf("clear\n");
    } else {
      ft_transform ghost;
      print(scene, &contact);
      must(ft_motion_transforms(query, contact.toi, &ghost, 1, NULL));
      printf("the forearm stops at %.1f degrees\n",
             2 * atan2(ghost.rotation[2], ghost.rotation[0]) * 180 / 3.14159265358979);
      return;
    }
  }
}

int main(void) {
  const double quarter = 1.5708;
  double rest[4], end[4];
  ft_pose from, to;
  ft_scene* scene;
  ft_avatar* avatar;
  ft_query* query = NULL;
  ft_contact first;
  must(FT_CHECK_ABI());
  scene = make_pole();
  avatar = make_forearm();
  must(ft_query_create(scene, avatar, NULL, &query));

  from = turned(0, rest);
  to = turned(quarter, end);
  must(ft_query_step(query, &from, &to));
  first.size = sizeof first;
  must(ft_query_links(query, &first, 1, NULL));
  print(scene, &first);

  swing_in_steps(query, scene, quarter, 8);
  ft_query_destroy(query);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return first.verdict == FT_VERDICT_CONTACT && first.toi > 0.3 && first.toi < 0.5 ? 0 : 1;
}
