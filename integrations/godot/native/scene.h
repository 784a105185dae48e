/* scene.h: the class FtScene: meshes as they stand, each an object of its own. */
#ifndef FORETOUCH_GODOT_SCENE_H
#define FORETOUCH_GODOT_SCENE_H

#include <foretouch/foretouch.h>

/* The scene of Godot's object; NULL: it is not an FtScene. */
typedef struct Scene Scene;
Scene* scene_of_owner(const void* owner);
/* NULL: it was not built. */
const ft_scene* scene_handle(const Scene* scene);

#endif
