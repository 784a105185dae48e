/* godot3.c: the entry for Godot 3.x, by GDNative and NativeScript. */
#include "integrations/godot/native/godot3.h"

#include <stdio.h>
#include <string.h>

#include "integrations/godot/native/core.h"

#define EXPORTED __attribute__((visibility("default")))

#define DECLARED(returns, number, name, arguments) returns(*name) arguments;
static struct Interface {
  GD_CORE(DECLARED) GD_CORE_1_1(DECLARED) GD_NATIVESCRIPT_1_0(DECLARED)
} gd;

/* Methods of Godot's own classes. */
static struct Binds {
  void *is_class, *node_place, *set_node_place, *bone_count, *bone_place, *set_bone_place;
} binds;
static gd_string skeleton_name, spatial_name;

/* ---- For the classes ---- */

static void engine(void* method, void* self, const void* first, const void* second, void* result) {
  const void* arguments[2] = {first, second};
  gd.method_bind_ptrcall(method, self, arguments, result);
}

static bool is_class(void* object, const gd_string* name) {
  bool is = false;
  engine(binds.is_class, object, name, NULL, &is);
  return is;
}

bool host_is_skeleton(void* object) { return is_class(object, &skeleton_name); }
bool host_is_spatial(void* object) { return is_class(object, &spatial_name); }

int64_t host_bone_count(void* skeleton) {
  int64_t count = 0;
  engine(binds.bone_count, skeleton, NULL, NULL, &count);
  return count;
}

void host_node_place(void* spatial, float place[12]) { engine(binds.node_place, spatial, NULL, NULL, place); }
void host_bone_place(void* skeleton, int64_t bone, float place[12]) {
  engine(binds.bone_place, skeleton, &bone, NULL, place);
}
void host_set_node_place(void* spatial, const float place[12]) { engine(binds.set_node_place, spatial, place, NULL, NULL); }

void host_set_bone_place(void* skeleton, int64_t bone, const float place[12]) {
  const double amount = 1;
  const bool is_persistent = true;
  const void* arguments[4] = {&bone, place, &amount, &is_persistent};
  gd.method_bind_ptrcall(binds.set_bone_place, skeleton, arguments, NULL);
}

/* ---- Values ---- */

static int type_of(Kind kind) {
  static const int types[] = {GD_NIL, GD_BOOL, GD_INT, GD_REAL, GD_STRING, GD_VECTOR3, GD_TRANSFORM, GD_POOL_VECTOR3_ARRAY, GD_NIL, GD_OBJECT};
  return types[kind];
}

/* Godot's own values that a call holds until it has returned. */
typedef struct Held {
  gd_char_string text;
  gd_pool pool;
  void* access;
} Held;

static bool take(const gd_variant* from, Kind kind, Value* to, Held* held) {
  const int type = gd.variant_get_type(from);
  const bool fits = type == type_of(kind) || (kind == KIND_REAL && type == GD_INT) || (kind == KIND_OBJECT && type == GD_NIL);
  if (!fits) return false;
  switch (kind) {
    case KIND_INT: to->integer = gd.variant_as_int(from); break;
    case KIND_REAL: to->real = gd.variant_as_real(from); break;
    case KIND_BOOL: to->boolean = gd.variant_as_bool(from); break;
    case KIND_VECTOR: {
      const gd_vector3 vector = gd.variant_as_vector3(from);
      memcpy(to->vector, vector.bytes, sizeof to->vector);
      break;
    }
    case KIND_PLACE: {
      const gd_transform place = gd.variant_as_transform(from);
      memcpy(to->place, place.bytes, sizeof to->place);
      break;
    }
    case KIND_OBJECT:
      to->object = type == GD_NIL ? NULL : gd.variant_as_object(from);
      if (to->object != NULL && !gd.is_instance_valid(to->object)) to->object = NULL;
      break;
    case KIND_TEXT: {
      gd_string text = gd.variant_as_string(from);
      held->text = gd.string_utf8(&text);
      gd.string_destroy(&text);
      to->text = gd.char_string_get_data(&held->text);
      if (to->text == NULL) to->text = "";
      break;
    }
    case KIND_VECTORS:
      held->pool = gd.variant_as_pool_vector3_array(from);
      held->access = gd.pool_vector3_array_read(&held->pool);
      to->data = gd.pool_vector3_array_read_access_ptr(held->access);
      to->count = (size_t)gd.pool_vector3_array_size(&held->pool);
      break;
    default: break;
  }
  return true;
}

static void let_go(Kind kind, Held* held) {
  if (kind == KIND_TEXT) gd.char_string_destroy(&held->text);
  if (kind == KIND_VECTORS) {
    gd.pool_vector3_array_read_access_destroy(held->access);
    gd.pool_vector3_array_destroy(&held->pool);
  }
}

static void give_text(const char* from, gd_variant* to) {
  gd_string text;
  gd.string_new(&text);
  gd.string_parse_utf8(&text, from == NULL ? "" : from);
  gd.variant_new_string(to, &text);
  gd.string_destroy(&text);
}

static void give_bytes(const Value* from, gd_variant* to) {
  gd_pool pool;
  gd.pool_byte_array_new(&pool);
  if (from->count > 0 && from->count <= INT32_MAX) {
    void* access;
    gd.pool_byte_array_resize(&pool, (int)from->count);
    access = gd.pool_byte_array_write(&pool);
    memcpy(gd.pool_byte_array_write_access_ptr(access), from->data, from->count);
    gd.pool_byte_array_write_access_destroy(access);
  }
  gd.variant_new_pool_byte_array(to, &pool);
  gd.pool_byte_array_destroy(&pool);
}

static void give(const Value* from, Kind kind, gd_variant* to) {
  switch (kind) {
    case KIND_INT: gd.variant_new_int(to, from->integer); break;
    case KIND_REAL: gd.variant_new_real(to, from->real); break;
    case KIND_BOOL: gd.variant_new_bool(to, from->boolean); break;
    case KIND_VECTOR: gd.variant_new_vector3(to, from->vector); break;
    case KIND_PLACE: gd.variant_new_transform(to, from->place); break;
    case KIND_TEXT: give_text(from->text, to); break;
    case KIND_BYTES: give_bytes(from, to); break;
    default: gd.variant_new_nil(to); break;
  }
}

/* ---- Calls ---- */

static void refuse(const Method* method, int argument, int count) {
  char text[200];
  if (argument < 0)
    snprintf(text, sizeof text, "%s() takes %d arguments, %d were given", method->name, method->argument_count, count);
  else
    snprintf(text, sizeof text, "%s(): argument %d is of another type", method->name, argument + 1);
  gd.print_error(text, method->name, "foretouch", 0);
}

static gd_variant called(void* owner, void* data, void* self, int count, gd_variant** arguments) {
  const Method* method = data;
  Value values[MOST_ARGUMENTS], result;
  Held held[MOST_ARGUMENTS];
  gd_variant to;
  int taken = 0;
  (void)owner;
  result.integer = 0;
  result.text = NULL;
  result.count = 0;
  if (self == NULL || count != method->argument_count) {
    refuse(method, -1, count);
    gd.variant_new_nil(&to);
    return to;
  }
  while (taken < count && take(arguments[taken], method->arguments[taken], &values[taken], &held[taken])) ++taken;
  if (taken == count) {
    method->call(self, values, &result);
    give(&result, method->result, &to);
  } else {
    refuse(method, taken, count);
    gd.variant_new_nil(&to);
  }
  while (taken-- > 0) let_go(method->arguments[taken], &held[taken]);
  return to;
}

static void* made(void* owner, void* data) { return ((const Class*)data)->create(owner); }
static void unmade(void* owner, void* data, void* self) {
  (void)owner;
  if (self != NULL) ((const Class*)data)->destroy(self);
}

static void register_class(void* library, const Class* from) {
  const gd_create create = {made, (void*)from, NULL};
  const gd_destroy destroy = {unmade, (void*)from, NULL};
  const gd_method_attributes attributes = {0};
  size_t i;
  gd.register_class(library, from->name, "Reference", create, destroy);
  for (i = 0; i < from->method_count; ++i) {
    const gd_method method = {called, (void*)&from->methods[i], NULL};
    gd.register_method(library, from->name, from->methods[i].name, attributes, method);
  }
}

/* ---- Entries: Godot looks for these names ---- */

#define OF_CORE(returns, number, name, arguments) gd.name = (returns(*) arguments)core->functions[number];
#define OF_EXTENSION(returns, number, name, arguments) gd.name = (returns(*) arguments)extension->functions[number];

EXPORTED void godot_gdnative_init(gd_init_options* options) {
  const gd_core* core = options->core;
  const gd_extension* extension = core->next;
  unsigned int i;
  GD_CORE(OF_CORE)
  if (extension == NULL) { /* 3.0, which has no core 1.1 */
    options->report_loading_error(options->library, "foretouch: expected Godot 3.1 or later");
    return;
  }
  GD_CORE_1_1(OF_EXTENSION)
  for (i = 0; i < core->extension_count; ++i) {
    extension = core->extensions[i];
    if (extension->type == GD_NATIVESCRIPT) {
      GD_NATIVESCRIPT_1_0(OF_EXTENSION)
    }
  }
  binds.is_class = gd.method_bind_get_method("Object", "is_class");
  binds.node_place = gd.method_bind_get_method("Spatial", "get_global_transform");
  binds.set_node_place = gd.method_bind_get_method("Spatial", "set_global_transform");
  binds.bone_count = gd.method_bind_get_method("Skeleton", "get_bone_count");
  binds.bone_place = gd.method_bind_get_method("Skeleton", "get_bone_global_pose");
  binds.set_bone_place = gd.method_bind_get_method("Skeleton", "set_bone_global_pose_override");
  gd.string_new(&skeleton_name);
  gd.string_parse_utf8(&skeleton_name, "Skeleton");
  gd.string_new(&spatial_name);
  gd.string_parse_utf8(&spatial_name, "Spatial");
}

EXPORTED void godot_nativescript_init(void* library) {
  if (gd.register_class == NULL) return; /* refused above */
  register_class(library, &scene_class);
  register_class(library, &body_class);
}

EXPORTED void godot_gdnative_terminate(void* options) {
  (void)options;
  gd.string_destroy(&skeleton_name);
  gd.string_destroy(&spatial_name);
}
