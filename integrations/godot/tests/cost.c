/* cost.c: the steps of cost.gd, in C; prints both, and what is between them.
 *   cost FOLDER_OF_EXAMPLES FILE_OF_POSES WHAT_GODOT_PRINTED */
#define _POSIX_C_SOURCE 199309L
#include <foretouch/foretouch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ROUNDS 100
#define FRAMES 200
#define MOST 4096

static ft_contact contacts[MOST];
static double rotations[4 * MOST], translations[3 * MOST];
static double poses[FRAMES][7 * 26];
static const char* printed;

static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static double now_us(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static void report(const char* name, const char* what, double c_us, int count) {
  char line[200], word[40];
  double godot_us = -1;
  int steps = 0;
  FILE* file = fopen(printed, "r");
  while (file != NULL && fgets(line, sizeof line, file) != NULL)
    if (sscanf(line, "%39s %d %lf", word, &steps, &godot_us) == 3 && strcmp(word, name) == 0) break;
  if (file == NULL || steps != count) {
    fprintf(stderr, "expected a line '%s %d TIME'\n", name, count);
    exit(1);
  }
  fclose(file);
  printf("%-44s GDScript %6.2f us, C %6.2f us, border %5.2f us per step\n", what, godot_us, c_us, godot_us - c_us);
}

static void read_contacts(ft_query* query) {
  size_t count;
  contacts[0].size = sizeof *contacts;
  must(ft_query_contacts(query, contacts, MOST, &count));
}

static void clip_cost(const ft_scene* scene, const char* folder) {
  char path[4096];
  ft_avatar* avatar;
  ft_clip* clip;
  ft_clip_info info;
  ft_query* query;
  size_t joints, frame;
  double least = 1e300;
  int round;
  snprintf(path, sizeof path, "%s/dancer.avatar.json", folder);
  must(ft_avatar_create_from_file(path, NULL, &avatar));
  snprintf(path, sizeof path, "%s/dancer.bvh", folder);
  must(ft_clip_create_from_file(path, avatar, NULL, &clip));
  must(ft_avatar_joint_count(avatar, &joints));
  must(ft_query_create(scene, avatar, NULL, &query));
  info.size = sizeof info;
  must(ft_clip_get_info(clip, &info));
  for (round = 0; round < ROUNDS; ++round) {
    const double begin = now_us();
    for (frame = 0; frame < info.frame_count; ++frame) {
      const ft_pose pose = {sizeof pose, (uint32_t)joints, rotations, translations};
      must(ft_clip_pose(clip, frame, rotations, translations, joints, NULL));
      must(ft_query_step(query, frame == 0 ? &pose : NULL, &pose));
      read_contacts(query);
    }
    if (now_us() - begin < least) least = now_us() - begin;
  }
  report("clip", "the dancer, 26 links, poses in doubles", least / (double)info.frame_count, (int)info.frame_count);
}

/* `joints` of the file's next poses; from each to the next. */
static void node_cost(const ft_scene* scene, FILE* file, uint32_t joints, const char* name, const char* what) {
  static ft_lss lss[26];
  static char text[26][8];
  static const char* names[26];
  static int32_t parents[26], links[26];
  static double zeroes[3 * 26];
  ft_avatar_arrays arrays;
  ft_avatar* avatar;
  ft_query* query;
  double least = 1e300;
  uint32_t j;
  int round, frame;
  must(ft_avatar_arrays_init(&arrays, sizeof arrays));
  for (j = 0; j < joints; ++j) {
    snprintf(text[j], sizeof text[j], "%u", j);
    names[j] = text[j];
    parents[j] = j == 0 ? -1 : (int32_t)(j - 1) / 5;
    links[j] = (int32_t)j;
    lss[j].radius = 0.01;
    lss[j].a[0] = joints == 1 ? -0.05 : 0;
    lss[j].b[0] = joints == 1 ? 0.05 : 0.02;
  }
  arrays.joint_count = arrays.lss_count = joints;
  arrays.names = names;
  arrays.parents = parents;
  arrays.offsets = zeroes;
  arrays.lss = lss;
  arrays.lss_links = links;
  must(ft_avatar_create(&arrays, &avatar));
  must(ft_query_create(scene, avatar, NULL, &query));
  for (frame = 0; frame < FRAMES; ++frame)
    if (fread(poses[frame], 7 * joints * sizeof(double), 1, file) != 1) exit(2);
  for (round = 0; round < ROUNDS; ++round) {
    const double begin = now_us();
    for (frame = joints == 1 ? 1 : 0; frame < FRAMES; ++frame) {
      const double* before = poses[frame == 0 ? 0 : frame - 1];
      const ft_pose from = {sizeof from, joints, before, before + 4 * joints};
      const ft_pose to = {sizeof to, joints, poses[frame], poses[frame] + 4 * joints};
      must(ft_query_step(query, joints == 1 || frame == 0 ? &from : NULL, &to));
      read_contacts(query);
    }
    if (now_us() - begin < least) least = now_us() - begin;
  }
  frame = joints == 1 ? FRAMES - 1 : FRAMES;
  report(name, what, least / frame, frame);
}

int main(int count, char** arguments) {
  char path[4096];
  ft_scene* scene;
  FILE* file;
  if (count != 4 || (file = fopen(arguments[2], "rb")) == NULL) return 2;
  printed = arguments[3];
  snprintf(path, sizeof path, "%s/room.obj", arguments[1]);
  must(ft_scene_create_from_file(path, NULL, &scene));
  clip_cost(scene, arguments[1]);
  node_cost(scene, file, 1, "rigid", "a Spatial from one Transform to another");
  node_cost(scene, file, 26, "skeleton", "a Skeleton of 26 bones, read from Godot");
  return 0;
}
