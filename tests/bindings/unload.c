/* unload.c: a host loads the library, makes a scene whose tree threads build, and unloads it: those
 * threads may still be there, so the library must be, too. Mono unloads it when it ends.
 *   unload LIBRARY */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <foretouch/foretouch.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SIDE 300

typedef ft_status (*create_function)(const ft_scene_arrays*, ft_scene**);
typedef void (*destroy_function)(ft_scene*);

/* A field of triangles that stand apart. */
static void fill(double* positions) {
  int i;
  for (i = 0; i < SIDE * SIDE; ++i) {
    double* at = positions + 9 * i;
    const double x = i % SIDE, z = i / SIDE;
    at[0] = at[6] = x;
    at[3] = x + 0.5;
    at[1] = at[4] = 0;
    at[7] = 0.5;
    at[2] = at[5] = at[8] = z;
  }
}

static int load_and_unload(const char* path, const ft_scene_arrays* arrays) {
  const struct timespec moment = {0, 20000000};
  ft_scene* scene;
  create_function create;
  destroy_function destroy;
  void* library = dlopen(path, RTLD_NOW);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  *(void**)&create = dlsym(library, "ft_scene_create");
  *(void**)&destroy = dlsym(library, "ft_scene_destroy");
  if (create(arrays, &scene) != FT_OK) return 1;
  destroy(scene);
  dlclose(library);
  nanosleep(&moment, NULL); /* here threads of what is gone would wake up */
  return 0;
}

int main(int count, char** arguments) {
  ft_scene_arrays arrays = {sizeof(ft_scene_arrays), 0, NULL, 0, NULL, 0, NULL, NULL, 0};
  double* positions = malloc(9 * SIDE * SIDE * sizeof(double));
  int i, failed = 0;
  if (count != 2 || positions == NULL) return 2;
  fill(positions);
  arrays.positions = positions;
  arrays.vertex_count = 3 * SIDE * SIDE;
  arrays.triangle_count = SIDE * SIDE;
  for (i = 0; i < 5 && failed == 0; ++i) failed = load_and_unload(arguments[1], &arrays);
  free(positions);
  return failed;
}
