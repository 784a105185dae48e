/* A hand comes down onto a table and is stopped there. Then it sweeps along the table into a cup,
 * presses on, and retreats: what comes after the first contact.
 *   cc table.c -lforetouch -lm */
#include <foretouch/foretouch.h>
#include <stdio.h>
#include <stdlib.h>

static const char* const kVerdicts[] = {"clear", "contact", "starts_in_contact", "undecided"};
static const double kRotation[] = {1, 0, 0, 0};

/* Every call of Foretouch says whether it worked. */
static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

/* A table at y = 0, and the side of a cup at x = 0.5. */
static ft_scene* make_table_and_cup(void) {
  static const double positions[] = {-2,  0, -2,   2,   0, -2,  0,   0,   4,
                                     0.5, 0, -0.2, 0.5, 0, 0.2, 0.5, 0.4, 0};
  static const int32_t objects[] = {0, 1};
  static const char* const names[] = {"table", "cup"};
  ft_scene_arrays arrays;
  ft_scene* scene = NULL;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = positions;
  arrays.vertex_count = 6;
  arrays.triangle_count = 2;
  arrays.objects = objects;
  arrays.object_names = names;
  arrays.object_count = 2;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

/* One ball of 5 cm. */
static ft_avatar* make_hand(void) {
  static const char* const names[] = {"hand"};
  static const int32_t parents[] = {-1};
  static const double offsets[] = {0, 0, 0};
  static const ft_lss lss[] = {{{0, 0, 0}, {0, 0, 0}, 0.05}};
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

static ft_pose at(const double place[3]) {
  ft_pose pose;
  must(ft_pose_init(&pose, sizeof pose));
  pose.joint_count = 1;
  pose.rotations = kRotation;
  pose.translations = place;
  return pose;
}

/* Asks for one motion; prints what the hand meets, object by object. Returns how many there are. */
static size_t moved(ft_query* query, const ft_scene* scene, const char* how, const double from[3],
                    const double to[3], ft_contact* met) {
  const ft_pose first = at(from), last = at(to);
  ft_contact contacts[2] = {{0}};
  size_t count, i;
  must(ft_query_step(query, &first, &last));
  contacts[0].size = sizeof contacts[0];
  must(ft_query_objects(query, contacts, 2, &count));
  printf("%s:%s\n", how, count == 0 ? " free" : "");
  for (i = 0; i < count; ++i) {
    ft_contact_details details;
    const char* object = NULL;
    details.size = sizeof details;
    must(ft_query_details(query, FT_LIST_OBJECTS, i, &details));
    must(ft_scene_object_name(scene, contacts[i].object, &object));
    printf("  %s with the %s at t = %.3f, coming at %.2f m per step\n",
           kVerdicts[contacts[i].verdict], object, contacts[i].toi, details.approach_speed);
  }
  *met = contacts[0];
  return count;
}

int main(void) {
  const double above[] = {0, 0.3, 0}, below[] = {0, -0.3, 0};
  double stopped[3], along[3];
  ft_query_options options;
  ft_scene* scene;
  ft_avatar* avatar;
  ft_query* query = NULL;
  ft_contact down, cup, press, none;
  int is_free;
  must(FT_CHECK_ABI());
  scene = make_table_and_cup();
  avatar = make_hand();
  must(ft_query_options_init(&options, sizeof options));
  options.scope = FT_SCOPE_EVERY_OBJECT;
  options.pass_separating = 1;
  must(ft_query_create(scene, avatar, &options, &query));

  moved(query, scene, "down", above, below, &down);
  must(ft_motion_pose(query, down.toi, NULL, stopped, 1, NULL)); /* up to here it is free */
  along[0] = 1, along[1] = stopped[1], along[2] = 0;
  moved(query, scene, "along the table", stopped, along, &cup);
  moved(query, scene, "on into the table", stopped, below, &press);
  is_free = moved(query, scene, "up again", stopped, above, &none) == 0;

  ft_query_destroy(query);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return down.toi > 0.41 && down.toi <= 0.25 / 0.6 && cup.object == 1 && cup.toi > 0.449 &&
                 press.verdict == FT_VERDICT_CONTACT && press.toi == 0 && is_free
             ? 0
             : 1;
}
