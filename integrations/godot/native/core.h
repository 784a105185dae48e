/* core.h: what Foretouch is for Godot, without Godot: two classes as tables of methods, which
 * godot3.c registers by GDNative and godot4.c by GDExtension; and what both of them do for these
 * classes, below as host_*(). Lengths in metres. Godot's vectors and transforms are floats; all
 * else here is double. */
#ifndef FORETOUCH_GODOT_CORE_H
#define FORETOUCH_GODOT_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What crosses the border. */
typedef enum Kind {
  KIND_NIL,
  KIND_BOOL,
  KIND_INT,
  KIND_REAL,    /* double in both Godots */
  KIND_TEXT,    /* UTF-8; as a result it lives until the next call */
  KIND_VECTOR,  /* Vector3 */
  KIND_PLACE,   /* Transform, Transform3D: three rows of the basis, then the origin */
  KIND_VECTORS, /* PoolVector3Array, PackedVector3Array: only as an argument */
  KIND_BYTES,   /* PoolByteArray, PackedByteArray: only as a result */
  KIND_OBJECT   /* only as an argument; NULL: null, or an object that was freed */
} Kind;

typedef struct Value {
  bool boolean;
  int64_t integer;
  double real;
  const char* text;
  float vector[3];
  float place[12];
  const void* data; /* of KIND_VECTORS and KIND_BYTES */
  size_t count;
  void* object;
} Value;

#define MOST_ARGUMENTS 4

typedef struct Method {
  const char* name;
  Kind result;
  void (*call)(void* self, const Value* arguments, Value* result);
  int argument_count;
  Kind arguments[MOST_ARGUMENTS];
} Method;

typedef struct Class {
  const char* name;
  void* (*create)(void* owner); /* NULL: no memory. `owner`: Godot's object */
  void (*destroy)(void* self);
  const Method* methods;
  size_t method_count;
} Class;

extern const Class scene_class, body_class;

/* ---- What the hosts do. Objects are alive: the hosts give NULL for those that are not ---- */

bool host_is_skeleton(void* object);
bool host_is_spatial(void* object); /* Spatial, Node3D; a skeleton is one, too */
int64_t host_bone_count(void* skeleton);
/* Where a node is in the world, and where a bone is in its skeleton. */
void host_node_place(void* spatial, float place[12]);
void host_bone_place(void* skeleton, int64_t bone, float place[12]);
void host_set_node_place(void* spatial, const float place[12]);
void host_set_bone_place(void* skeleton, int64_t bone, const float place[12]);

#endif
