/* Plays a clip in a scene, and prints what each link of the avatar meets first in every step.
 *   play_clip SCENE AVATAR CLIP [FRAMES_PER_STEP]
 *   cc play_clip.c -lforetouch -o play_clip */
#include <foretouch/foretouch.h>
#include <stdio.h>
#include <stdlib.h>

/* Every call says whether it worked; if not, where and what was expected there. */
static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

/* Arrays of the caller, for one pose. */
static ft_pose new_pose(size_t joints, double** rotations, double** translations) {
  ft_pose pose;
  must(ft_pose_init(&pose, sizeof pose));
  *rotations = malloc(joints * 4 * sizeof(double));
  *translations = malloc(joints * 3 * sizeof(double));
  if (*rotations == NULL || *translations == NULL) exit(1);
  pose.joint_count = (uint32_t)joints;
  pose.rotations = *rotations;
  pose.translations = *translations;
  return pose;
}

/* Prints the contacts of the last step, the earliest first; returns how many there are. */
static int print_contacts(const ft_query* query, const ft_scene* scene, const ft_avatar* avatar,
                          int step, ft_contact* contacts, size_t joints) {
  size_t count, i;
  int met = 0;
  contacts[0].size = sizeof contacts[0];
  must(ft_query_contacts(query, contacts, joints, &count));
  for (i = 0; i < count; ++i) {
    const char *link, *object;
    if (contacts[i].verdict != FT_VERDICT_CONTACT) continue;
    must(ft_avatar_joint_name(avatar, contacts[i].link, &link));
    must(ft_scene_object_name(scene, contacts[i].object, &object));
    printf("step %d: %s meets %s at t = %.4f\n", step, link, object, contacts[i].toi);
    ++met;
  }
  return met;
}

int main(int count, char** arguments) {
  const int stride = count == 5 ? atoi(arguments[4]) : 1;
  int steps = 0, contacts = 0;
  size_t joints, frame;
  double *rotations, *translations;
  ft_scene* scene;
  ft_avatar* avatar;
  ft_clip* clip;
  ft_query* query;
  ft_clip_info info;
  ft_contact* met;
  ft_pose pose;
  if (count < 4 || count > 5 || stride < 1) {
    fprintf(stderr, "play_clip SCENE AVATAR CLIP [FRAMES_PER_STEP]\n");
    return 2;
  }
  must(FT_CHECK_ABI());
  /* NULL: the usual options. ft_import_options and ft_clip_options have unit, axis and place. */
  must(ft_scene_create_from_file(arguments[1], NULL, &scene));
  must(ft_avatar_create_from_file(arguments[2], NULL, &avatar));
  must(ft_clip_create_from_file(arguments[3], avatar, NULL, &clip));
  must(ft_query_create(scene, avatar, NULL, &query));
  must(ft_avatar_joint_count(avatar, &joints));
  info.size = sizeof info;
  must(ft_clip_get_info(clip, &info));
  pose = new_pose(joints, &rotations, &translations);
  met = malloc(joints * sizeof *met);
  if (met == NULL) return 1;

  must(ft_clip_pose(clip, 0, rotations, translations, joints, NULL));
  must(ft_query_step(query, &pose, &pose)); /* the first pose: nothing has ended yet */
  for (frame = (size_t)stride; frame < info.frame_count; frame += (size_t)stride) {
    must(ft_clip_pose(clip, frame, rotations, translations, joints, NULL));
    must(ft_query_step(query, NULL, &pose)); /* from where the last step ended */
    contacts += print_contacts(query, scene, avatar, steps++, met, joints);
  }
  printf("%d contacts in %d steps\n", contacts, steps);

  free(met);
  free(rotations);
  free(translations);
  ft_query_destroy(query);
  ft_clip_destroy(clip);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return 0;
}
