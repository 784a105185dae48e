/* answers.c: asks the C library what answers.gd asked in Godot.
 *   answers clip FOLDER_OF_EXAMPLES PLACE WHO steps|ticks   writes all answers of a bundled clip
 *   answers own FILE   reads what Godot was asked and answered, of meshes and bones of its own: were poses those
 *                      of its floats, are answers those of C, bit for bit, and is shown what was answered? */
#include <foretouch/solid.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 4096

static double rotations[4 * MOST], translations[3 * MOST];
static ft_contact contacts[MOST];
static ft_solid_contact presses[MOST];
static ft_solid_tick tick; /* zeroes between its fields, as in the add-on */

static void must(ft_status status) {
  if (status == FT_OK) return;
  fprintf(stderr, "%s\n", ft_last_error());
  exit(1);
}

static void expect(int is_so, const char* what, long at) {
  if (is_so) return;
  fprintf(stderr, "not so: %s, at %ld\n", what, at);
  exit(1);
}

/* ---- The bundled clips ---- */

static void clip_answers(const char* folder, const char* place, const char* who, int is_solid) {
  ft_scene* scene;
  ft_avatar* avatar;
  ft_clip* clip;
  ft_query* query;
  ft_solid* solid;
  ft_solid_options options;
  ft_clip_info info;
  size_t joints, count, frame;
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.obj", folder, place);
  must(ft_scene_create_from_file(path, NULL, &scene));
  snprintf(path, sizeof path, "%s/%s.avatar.json", folder, who);
  must(ft_avatar_create_from_file(path, NULL, &avatar));
  snprintf(path, sizeof path, "%s/%s.bvh", folder, who);
  must(ft_clip_create_from_file(path, avatar, NULL, &clip));
  must(ft_avatar_joint_count(avatar, &joints));
  info.size = sizeof info;
  must(ft_clip_get_info(clip, &info));
  must(ft_query_create(scene, avatar, NULL, &query));
  must(ft_solid_options_init(&options, sizeof options));
  options.floor = FT_SOLID_FLOOR_HOLD;
  must(ft_solid_create(scene, avatar, &options, &solid));
  for (frame = 0; frame < info.frame_count; ++frame) {
    const ft_pose pose = {sizeof pose, (uint32_t)joints, rotations, translations};
    must(ft_clip_pose(clip, frame, rotations, translations, joints, NULL));
    if (is_solid) {
      tick.size = sizeof tick;
      must(ft_solid_follow(solid, &pose, NULL, 1.0 / 64, &tick));
      must(ft_solid_shown(solid, rotations, translations, joints, NULL));
      presses[0].size = sizeof *presses;
      must(ft_solid_contacts(solid, presses, MOST, &count));
      fwrite(&tick, sizeof tick, 1, stdout);
    } else {
      must(ft_query_step(query, frame == 0 ? &pose : NULL, &pose));
      contacts[0].size = sizeof *contacts;
      must(ft_query_links(query, contacts, MOST, &count));
    }
    fwrite(rotations, sizeof(double), 4 * joints, stdout);
    fwrite(translations, sizeof(double), 3 * joints, stdout);
    if (is_solid) fwrite(presses, sizeof *presses, count, stdout);
    else fwrite(contacts, sizeof *contacts, count, stdout);
  }
}

/* ---- Godot's own meshes and bones ---- */

static FILE* file;

static void take(void* to, size_t size) { expect(size == 0 || fread(to, size, 1, file) == 1, "the file goes on", ftell(file)); }
static uint32_t take_count(void) {
  uint32_t count;
  take(&count, sizeof count);
  return count;
}

/* Four columns: an affine map, as written row by row, then the origin. */
typedef struct Matrix { double at[3][4]; } Matrix;

static Matrix take_matrix(void) {
  float floats[12];
  Matrix to;
  int i, k;
  take(floats, sizeof floats);
  for (i = 0; i < 3; ++i) {
    for (k = 0; k < 3; ++k) to.at[i][k] = floats[3 * i + k];
    to.at[i][3] = floats[9 + i];
  }
  return to;
}

static Matrix product(const Matrix* a, const Matrix* b) {
  Matrix to;
  int i, k;
  for (i = 0; i < 3; ++i) {
    for (k = 0; k < 4; ++k)
      to.at[i][k] = a->at[i][0] * b->at[0][k] + a->at[i][1] * b->at[1][k] + a->at[i][2] * b->at[2][k] + (k == 3 ? a->at[i][3] : 0);
  }
  return to;
}

/* The place of one joint of a pose, in its parent's frame. */
static Matrix matrix_of(const double* q, const double* p) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const Matrix to = {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), p[0]},
                      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), p[1]},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z, p[2]}}};
  return to;
}

static uint32_t bones;
static int32_t parents[MOST];

/* The places that a pose puts bones at, and those that Godot says, up to their scale and its floats. */
static void expect_same_places(const double* q, const double* p, const Matrix* node, const Matrix* bone, const char* what, long at) {
  static Matrix world[MOST];
  uint32_t b;
  for (b = 0; b < bones; ++b) {
    const Matrix local = matrix_of(q + 4 * b, p + 3 * b), other = product(node, &bone[b]);
    const double scale = sqrt(other.at[0][0] * other.at[0][0] + other.at[1][0] * other.at[1][0] + other.at[2][0] * other.at[2][0]);
    int i, k;
    world[b] = parents[b] < 0 ? local : product(&world[parents[b]], &local);
    for (i = 0; i < 3; ++i)
      for (k = 0; k < 4; ++k)
        expect(fabs(world[b].at[i][k] - other.at[i][k] / (k < 3 ? scale : 1)) < 4e-6, what, at);
  }
}

static ft_scene* take_scene(void) {
  static double positions[9 * 200000];
  static int32_t objects[200000];
  const uint32_t meshes = take_count();
  uint32_t mesh;
  ft_scene_arrays arrays;
  ft_scene* scene;
  size_t corners = 0;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  for (mesh = 0; mesh < meshes; ++mesh) {
    static float floats[3 * 600000];
    const uint32_t count = take_count();
    Matrix place;
    uint32_t c;
    int i;
    expect(corners + count <= 600000, "room for the mesh", count);
    take(floats, count * 3 * sizeof(float));
    place = take_matrix();
    for (c = 0; c < count; ++c, ++corners) {
      objects[corners / 3] = (int32_t)mesh;
      for (i = 0; i < 3; ++i)
        positions[3 * corners + i] = place.at[i][0] * floats[3 * c] + place.at[i][1] * floats[3 * c + 1] +
                                     place.at[i][2] * floats[3 * c + 2] + place.at[i][3];
    }
  }
  arrays.positions = positions;
  arrays.vertex_count = corners;
  arrays.triangle_count = corners / 3;
  arrays.objects = objects;
  arrays.object_count = meshes;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

static void take_bones(Matrix* node, Matrix* bone) {
  uint32_t b;
  *node = take_matrix();
  for (b = 0; b < bones; ++b) bone[b] = take_matrix();
}

/* Capsules have the scale of the bones that they were made for. */
static ft_avatar* take_avatar(Matrix* node, Matrix* bone) {
  static ft_lss lss[MOST];
  static char text[MOST][16];
  static const char* names[MOST];
  static int32_t links[MOST];
  ft_avatar_arrays arrays;
  ft_avatar* avatar;
  uint32_t b;
  int i;
  must(ft_avatar_arrays_init(&arrays, sizeof arrays));
  bones = take_count();
  for (b = 0; b < bones; ++b) {
    float ends[6];
    take(&parents[b], sizeof parents[b]);
    take(ends, sizeof ends);
    take(&lss[b].radius, sizeof(double));
    for (i = 0; i < 3; ++i) {
      lss[b].a[i] = ends[i];
      lss[b].b[i] = ends[3 + i];
    }
    snprintf(text[b], sizeof text[b], "bone%u", b);
    names[b] = text[b];
    links[b] = (int32_t)b;
  }
  take_bones(node, bone);
  for (b = 0; b < bones; ++b) {
    Matrix whole = product(node, &bone[b]);
    const double scale = sqrt(whole.at[0][0] * whole.at[0][0] + whole.at[1][0] * whole.at[1][0] + whole.at[2][0] * whole.at[2][0]);
    for (i = 0; i < 3; ++i) {
      lss[b].a[i] *= scale;
      lss[b].b[i] *= scale;
    }
    lss[b].radius *= scale;
  }
  take(rotations, 4 * bones * sizeof(double));
  take(translations, 3 * bones * sizeof(double));
  expect_same_places(rotations, translations, node, bone, "the rest pose is where Godot says", -1);
  arrays.joint_count = arrays.lss_count = bones;
  arrays.names = names;
  arrays.parents = parents;
  arrays.offsets = translations;
  arrays.rotations = rotations;
  arrays.lss = lss;
  arrays.lss_links = links;
  must(ft_avatar_create(&arrays, &avatar));
  return avatar;
}

static void own_answers(void) {
  static Matrix node, bone[MOST], shown_node, shown_bone[MOST];
  static unsigned char told[1 << 20], asked[1 << 20];
  ft_scene* scene = take_scene();
  ft_avatar* avatar = take_avatar(&node, bone);
  const uint32_t steps = take_count();
  ft_solid_options options;
  ft_query* query;
  ft_solid* solid;
  long not_clear = 0, held = 0;
  uint32_t step, b;
  must(ft_query_create(scene, avatar, NULL, &query));
  must(ft_solid_options_init(&options, sizeof options));
  options.floor = FT_SOLID_FLOOR_HOLD;
  must(ft_solid_create(scene, avatar, &options, &solid));
  for (step = 0; step < steps; ++step) {
    const ft_pose pose = {sizeof pose, bones, rotations, translations};
    const size_t floats = 4 * bones * sizeof(double), places = 3 * bones * sizeof(double);
    size_t count, size;
    take_bones(&node, bone);
    take(rotations, floats);
    take(translations, places);
    expect_same_places(rotations, translations, &node, bone, "the pose is where Godot says", step);
    take(told, bones * sizeof *contacts);
    must(ft_query_step(query, step == 0 ? &pose : NULL, &pose));
    contacts[0].size = sizeof *contacts;
    must(ft_query_links(query, contacts, MOST, NULL));
    expect(memcmp(told, contacts, bones * sizeof *contacts) == 0, "contacts have the same bits", step);
    for (b = 0; b < bones; ++b) not_clear += contacts[b].verdict != FT_VERDICT_CLEAR;

    tick.size = sizeof tick;
    must(ft_solid_follow(solid, &pose, NULL, 1.0 / 64, &tick));
    must(ft_solid_shown(solid, rotations, translations, bones, NULL));
    presses[0].size = sizeof *presses;
    must(ft_solid_contacts(solid, presses, MOST, &count));
    held += (long)count;
    memcpy(asked, &tick, sizeof tick);
    memcpy(asked + sizeof tick, rotations, floats);
    memcpy(asked + sizeof tick + floats, translations, places);
    memcpy(asked + sizeof tick + floats + places, presses, count * sizeof *presses);
    size = sizeof tick + floats + places + count * sizeof *presses;
    expect(take_count() == size, "the tick has as many contacts", step);
    take(told, size);
    expect(memcmp(told, asked, size) == 0, "the tick has the same bits", step);
    take_bones(&shown_node, shown_bone);
    expect_same_places(rotations, translations, &shown_node, shown_bone, "what is shown is where C says", step);
  }
  expect(not_clear > 200 && held > 200, "enough contacts to compare", not_clear);
  printf("%u steps and ticks of %u bones of Godot's own: %ld link-steps not clear, %ld surfaces that hold: the same bits\n", steps, bones,
         not_clear, held);
}

int main(int count, char** arguments) {
  if (count == 6 && strcmp(arguments[1], "clip") == 0) {
    clip_answers(arguments[2], arguments[3], arguments[4], strcmp(arguments[5], "ticks") == 0);
    return 0;
  }
  if (count != 3 || (file = fopen(arguments[2], "rb")) == NULL) return 2;
  own_answers();
  return 0;
}
