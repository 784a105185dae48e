/* Somebody else's program in C reads a scene: the library finds the importer that came with it.
 *   import SCENE */
#include <foretouch/foretouch.h>
#include <stdio.h>

int main(int count, char** arguments) {
  ft_scene* scene = NULL;
  ft_scene_info info;
  info.size = sizeof info;
  if (count != 2 || FT_CHECK_ABI() != FT_OK ||
      ft_scene_create_from_file(arguments[1], NULL, &scene) != FT_OK ||
      ft_scene_get_info(scene, &info) != FT_OK) {
    fprintf(stderr, "%s\n", ft_last_error());
    return 1;
  }
  printf("%d objects\n", (int)info.object_count);
  ft_scene_destroy(scene);
  return info.triangles > 0 ? 0 : 1;
}
