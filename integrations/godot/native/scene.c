#include "integrations/godot/native/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrations/godot/native/core.h"
#include "integrations/godot/native/place.h"

struct Scene {
  void* owner;
  Scene* next; /* in the list of all that live */
  ft_scene* handle;
  double* positions; /* nine per triangle */
  int32_t* objects;  /* one per triangle */
  size_t triangles, room;
  char** names;
  size_t name_count;
  char error[1100];
};

/* Godot makes and frees objects of scripts on several threads only if a game does; foretouch's do not. */
static Scene* scenes;

Scene* scene_of_owner(const void* owner) {
  Scene* each;
  for (each = scenes; each != NULL; each = each->next)
    if (each->owner == owner) return owner == NULL ? NULL : each;
  return NULL;
}

const ft_scene* scene_handle(const Scene* scene) { return scene->handle; }

static void forget_meshes(Scene* scene) {
  size_t i;
  for (i = 0; i < scene->name_count; ++i) free(scene->names[i]);
  free(scene->names);
  free(scene->positions);
  free(scene->objects);
  scene->names = NULL;
  scene->positions = NULL;
  scene->objects = NULL;
  scene->name_count = scene->triangles = scene->room = 0;
}

static void* create(void* owner) {
  Scene* scene = calloc(1, sizeof *scene);
  if (scene == NULL) return NULL;
  scene->owner = owner;
  scene->next = scenes;
  scenes = scene;
  return scene;
}

static void destroy(void* self) {
  Scene* scene = self;
  Scene** link = &scenes;
  while (*link != scene) link = &(*link)->next;
  *link = scene->next;
  ft_scene_destroy(scene->handle);
  forget_meshes(scene);
  free(scene);
}

static const char* told(Scene* scene, ft_status status) {
  snprintf(scene->error, sizeof scene->error, "%s", status == FT_OK ? "" : ft_last_error());
  return scene->error;
}

static bool has_room(Scene* scene, size_t triangles) {
  if (scene->triangles + triangles > scene->room) {
    const size_t room = 2 * (scene->triangles + triangles);
    double* positions = realloc(scene->positions, 9 * room * sizeof *positions);
    int32_t* objects;
    if (positions == NULL) return false;
    scene->positions = positions;
    objects = realloc(scene->objects, room * sizeof *objects);
    if (objects == NULL) return false;
    scene->objects = objects;
    scene->room = room;
  }
  return true;
}

static bool has_name(Scene* scene, const char* name) {
  char** names = realloc(scene->names, (scene->name_count + 1) * sizeof *names);
  if (names == NULL) return false;
  scene->names = names;
  names[scene->name_count] = malloc(strlen(name) + 1);
  if (names[scene->name_count] == NULL) return false;
  strcpy(names[scene->name_count++], name);
  return true;
}

/* Any affine place will do: each corner is where Godot draws it, but computed in doubles. */
static void add_mesh(void* self, const Value* arguments, Value* result) {
  Scene* scene = self;
  const float* corners = arguments[0].data;
  const size_t count = arguments[0].count;
  const Affine place = affine_of(arguments[1].place);
  const char* name = arguments[2].text;
  size_t i;
  int row;
  result->text = scene->error;
  scene->error[0] = 0;
  if (count == 0 || count % 3 != 0) {
    snprintf(scene->error, sizeof scene->error, "'%s' has no triangles: its mesh has no surface, or only lines and points; nothing touches it",
             name);
    return;
  }
  for (i = 0; i < 3 * count; ++i) {
    if (!isfinite(corners[i])) {
      snprintf(scene->error, sizeof scene->error, "'%s' has a vertex that is not a number, in triangle %zu", name, i / 9);
      return;
    }
  }
  if (!has_room(scene, count / 3) || !has_name(scene, name)) {
    snprintf(scene->error, sizeof scene->error, "no memory for '%s'", name);
    return;
  }
  for (i = 0; i < count; ++i) {
    double* to = scene->positions + 9 * scene->triangles + 3 * i;
    for (row = 0; row < 3; ++row) {
      to[row] = place.basis[3 * row] * corners[3 * i] + place.basis[3 * row + 1] * corners[3 * i + 1] +
                place.basis[3 * row + 2] * corners[3 * i + 2] + place.origin[row];
    }
  }
  for (i = 0; i < count / 3; ++i) scene->objects[scene->triangles + i] = (int32_t)scene->name_count - 1;
  scene->triangles += count / 3;
}

static void build(void* self, const Value* arguments, Value* result) {
  Scene* scene = self;
  ft_scene_arrays arrays;
  ft_scene* made;
  ft_status status = ft_scene_arrays_init(&arrays, sizeof arrays);
  (void)arguments;
  arrays.positions = scene->positions;
  arrays.vertex_count = 3 * scene->triangles;
  arrays.triangle_count = scene->triangles;
  arrays.objects = scene->objects;
  arrays.object_names = (const char* const*)scene->names;
  arrays.object_count = scene->name_count;
  if (status == FT_OK) status = ft_scene_create(&arrays, &made);
  if (status == FT_OK) {
    ft_scene_destroy(scene->handle);
    scene->handle = made;
    forget_meshes(scene);
  }
  result->text = told(scene, status);
}

static void load(void* self, const Value* arguments, Value* result) {
  Scene* scene = self;
  ft_scene* made;
  const ft_status status = ft_scene_create_from_file(arguments[0].text, NULL, &made);
  if (status == FT_OK) {
    ft_scene_destroy(scene->handle);
    scene->handle = made;
  }
  result->text = told(scene, status);
}

static void object_name(void* self, const Value* arguments, Value* result) {
  Scene* scene = self;
  const int64_t object = arguments[0].integer;
  if (object < 0 || object > INT32_MAX ||
      ft_scene_object_name(scene->handle, (int32_t)object, &result->text) != FT_OK)
    result->text = "";
}

static void triangle_count(void* self, const Value* arguments, Value* result) {
  Scene* scene = self;
  ft_scene_info info;
  (void)arguments;
  info.size = sizeof info;
  result->integer = ft_scene_get_info(scene->handle, &info) == FT_OK ? (int64_t)info.triangles : 0;
}

static const Method methods[] = {
    {"add_mesh", KIND_TEXT, add_mesh, 3, {KIND_VECTORS, KIND_PLACE, KIND_TEXT}},
    {"build", KIND_TEXT, build, 0, {KIND_NIL}},
    {"load", KIND_TEXT, load, 1, {KIND_TEXT}},
    {"object_name", KIND_TEXT, object_name, 1, {KIND_INT}},
    {"triangle_count", KIND_INT, triangle_count, 0, {KIND_NIL}},
};
const Class scene_class = {"FtScene", create, destroy, methods, sizeof methods / sizeof *methods};
