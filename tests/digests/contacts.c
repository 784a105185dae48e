/* All that the C library says of a clip, in digits that keep every bit:
 *   contacts SCENE AVATAR CLIP EVERY link|exact COUNTERS
 * Each link's verdict of each step, what is touched at both poses, and where the links stand at the
 * first contact, to standard output; the work of each step to the file COUNTERS. */
#include <foretouch/foretouch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static void* room(size_t count, size_t size) {
  void* const memory = calloc(count, size);
  if (memory != NULL) return memory;
  fprintf(stderr, "out of memory\n");
  exit(1);
}

static void print_numbers(const double* numbers, size_t count) {
  size_t i;
  for (i = 0; i < count; ++i) printf(" %a", numbers[i]);
}

static void print_contact(const ft_contact* c) {
  printf("%d %d %d", (int)c->link, (int)c->verdict, (int)c->reason);
  print_numbers(&c->toi, 1);
  print_numbers(&c->free_until, 1);
  print_numbers(&c->separation, 1);
  print_numbers(&c->penetration, 1);
  print_numbers(c->point_scene, 3);
  print_numbers(c->point_link, 3);
  print_numbers(c->normal, 3);
  printf(" %d %d %d %d %d %d\n", (int)c->triangle, (int)c->object, (int)c->lss,
         (int)c->link_triangle, (int)c->link_feature, (int)c->scene_feature);
}

static void print_links(const ft_query* query, size_t count) {
  ft_contact* const links = room(count, sizeof *links);
  size_t i;
  links[0].size = sizeof *links;
  must(ft_query_links(query, links, count, NULL));
  for (i = 0; i < count; ++i) print_contact(&links[i]);
  free(links);
}

static void print_touches(ft_query* query, size_t links) {
  size_t i;
  printf("touches");
  for (i = 0; i < links; ++i) {
    int32_t before, after;
    must(ft_touches_at(query, (int32_t)i, 0.0, &before));
    must(ft_touches_at(query, (int32_t)i, 1.0, &after));
    printf(" %d%d", (int)before, (int)after);
  }
  printf("\n");
}

/* The order of contacts, and the avatar as it stands at the first. */
static void print_first(ft_query* query, size_t links) {
  ft_contact* const contacts = room(links, sizeof *contacts);
  ft_transform* const stand = room(links, sizeof *stand);
  size_t count, i;
  contacts[0].size = sizeof *contacts;
  must(ft_query_contacts(query, contacts, links, &count));
  printf("order");
  for (i = 0; i < count; ++i) printf(" %d", (int)contacts[i].link);
  printf("\n");
  if (count > 0) {
    must(ft_motion_transforms(query, contacts[0].free_until, stand, links, NULL));
    for (i = 0; i < links; ++i) {
      print_numbers(stand[i].rotation, 13);
      printf("\n");
    }
  }
  free(stand);
  free(contacts);
}

static void print_work(const ft_query* query, FILE* file) {
  ft_counters work;
  work.size = sizeof work;
  must(ft_query_counters(query, &work));
  fprintf(file, "%llu %llu %llu %llu %llu %llu %llu %llu %llu %llu %llu %llu\n",
          (unsigned long long)work.nodes, (unsigned long long)work.leaves,
          (unsigned long long)work.candidates, (unsigned long long)work.cluster_steps,
          (unsigned long long)work.lane_steps, (unsigned long long)work.part_steps,
          (unsigned long long)work.advancements, (unsigned long long)work.hierarchy_tests,
          (unsigned long long)work.plane_tests, (unsigned long long)work.leaf_tests,
          (unsigned long long)work.states, (unsigned long long)work.rung_tests);
}

static void step_through(ft_query* query, const ft_clip* clip, size_t links, size_t every,
                         FILE* work) {
  double* const rotations = room(4 * links, sizeof *rotations);
  double* const translations = room(3 * links, sizeof *translations);
  ft_clip_info info;
  ft_pose pose;
  size_t frame;
  info.size = sizeof info;
  must(ft_clip_get_info(clip, &info));
  must(ft_pose_init(&pose, sizeof pose));
  pose.joint_count = (uint32_t)links;
  pose.rotations = rotations;
  pose.translations = translations;
  for (frame = 0; frame < info.frame_count; frame += every) {
    must(ft_clip_pose(clip, frame, rotations, translations, links, NULL));
    must(ft_query_step(query, frame == 0 ? &pose : NULL, &pose));
    printf("frame %lu\n", (unsigned long)frame);
    print_links(query, links);
    print_work(query, work);
    print_touches(query, links);
    print_first(query, links);
  }
  free(translations);
  free(rotations);
}

int main(int argc, char** argv) {
  ft_scene* scene;
  ft_avatar* avatar;
  ft_clip* clip;
  ft_query* query;
  ft_query_options options;
  ft_import_options meshes;
  size_t links;
  FILE* work;
  if (argc != 7 || (work = fopen(argv[6], "w")) == NULL) return 2;
  must(FT_CHECK_ABI());
  must(ft_query_options_init(&options, sizeof options));
  must(ft_import_options_init(&meshes, sizeof meshes));
  options.fidelity = strcmp(argv[5], "exact") == 0 ? FT_FIDELITY_EXACT : FT_FIDELITY_LINK;
  must(ft_scene_create_from_file(argv[1], NULL, &scene));
  must(ft_avatar_create_from_file(argv[2], &meshes, &avatar));
  must(ft_clip_create_from_file(argv[3], avatar, NULL, &clip));
  must(ft_avatar_joint_count(avatar, &links));
  must(ft_query_create(scene, avatar, &options, &query));
  step_through(query, clip, links, (size_t)atoi(argv[4]), work);
  ft_query_destroy(query);
  ft_clip_destroy(clip);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return fclose(work) == 0 ? 0 : 1;
}
