/* godot4.c: the entry for Godot 4.1 and later, by GDExtension. */
#include "integrations/godot/native/godot4.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrations/godot/native/core.h"

#define EXPORTED __attribute__((visibility("default")))

#define DECLARED(returns, name, arguments) returns(*name) arguments;
static struct Interface {
  GX_INTERFACE(DECLARED)
} gx;
static void* this_library;

/* ---- Variants ---- */

static gx_string name_of(const char* from) {
  gx_string name;
  gx.string_name_new_with_latin1_chars(&name, from, 0);
  return name;
}
static void destroy(int32_t type, void* self) { gx.variant_get_ptr_destructor(type)(self); }

static gx_variant variant_of(int32_t type, const void* from) {
  gx_variant made;
  gx.get_variant_from_type_constructor(type)(&made, (void*)from);
  return made;
}

/* Calls a method of a variant, which is kept, with arguments, which are destroyed; NULL: the result is. */
static bool call_variant(gx_variant* self, const char* method, gx_variant* arguments, int count, int32_t type, void* result) {
  const void* list[4];
  gx_string name = name_of(method);
  gx_variant returned;
  gx_call_error error = {GX_CALL_OK, 0, 0};
  bool has_result;
  int i;
  for (i = 0; i < count; ++i) list[i] = &arguments[i];
  gx.variant_call(self, &name, list, count, &returned, &error);
  has_result = error.error == GX_CALL_OK && (result == NULL || gx.variant_get_type(&returned) == type);
  if (has_result && result != NULL) gx.get_variant_to_type_constructor(type)(result, &returned);
  gx.variant_destroy(&returned);
  for (i = 0; i < count; ++i) gx.variant_destroy(&arguments[i]);
  destroy(GX_STRING_NAME, &name);
  return has_result;
}

static bool call_object(void* object, const char* method, gx_variant* arguments, int count, int32_t type, void* result) {
  gx_variant self = variant_of(GX_OBJECT, &object);
  const bool has_result = call_variant(&self, method, arguments, count, type, result);
  gx.variant_destroy(&self);
  return has_result;
}

/* ---- For the classes ---- */

static bool is_class(void* object, const char* name) {
  gx_string text;
  gx_variant argument;
  gx_bool is = 0;
  gx.string_new_with_utf8_chars(&text, name);
  argument = variant_of(GX_STRING, &text);
  destroy(GX_STRING, &text);
  return call_object(object, "is_class", &argument, 1, GX_BOOL, &is) && is;
}

bool host_is_skeleton(void* object) { return is_class(object, "Skeleton3D"); }
bool host_is_spatial(void* object) { return is_class(object, "Node3D"); }

int64_t host_bone_count(void* skeleton) {
  int64_t count = 0;
  call_object(skeleton, "get_bone_count", NULL, 0, GX_INT, &count);
  return count;
}

/* Zeroes, which no scale is, where Godot did not answer. */
void host_node_place(void* spatial, float place[12]) {
  memset(place, 0, 12 * sizeof *place);
  call_object(spatial, "get_global_transform", NULL, 0, GX_TRANSFORM3D, place);
}

void host_bone_place(void* skeleton, int64_t bone, float place[12]) {
  gx_variant argument = variant_of(GX_INT, &bone);
  memset(place, 0, 12 * sizeof *place);
  call_object(skeleton, "get_bone_global_pose", &argument, 1, GX_TRANSFORM3D, place);
}

void host_set_node_place(void* spatial, const float place[12]) {
  gx_variant argument = variant_of(GX_TRANSFORM3D, place);
  call_object(spatial, "set_global_transform", &argument, 1, GX_NIL, NULL);
}

void host_set_bone_place(void* skeleton, int64_t bone, const float place[12]) {
  const double amount = 1;
  const gx_bool is_persistent = 1;
  gx_variant arguments[4] = {variant_of(GX_INT, &bone), variant_of(GX_TRANSFORM3D, place), variant_of(GX_FLOAT, &amount),
                             variant_of(GX_BOOL, &is_persistent)};
  call_object(skeleton, "set_bone_global_pose_override", arguments, 4, GX_NIL, NULL);
}

/* ---- Values ---- */

static int32_t type_of(Kind kind) {
  static const int32_t types[] = {GX_NIL, GX_BOOL, GX_INT, GX_FLOAT, GX_STRING, GX_VECTOR3, GX_TRANSFORM3D,
                                  GX_PACKED_VECTOR3_ARRAY, GX_PACKED_BYTE_ARRAY, GX_OBJECT};
  return types[kind];
}

/* What a call holds until it has returned. */
typedef struct Held {
  char* text;
  gx_packed packed;
} Held;

/* An object that was freed equals null. */
static bool is_alive(const void* from) {
  gx_variant nil, equals;
  gx_bool is_valid = 0, is_null = 1;
  gx.variant_new_nil(&nil);
  gx.variant_evaluate(GX_EQUAL, from, &nil, &equals, &is_valid);
  if (is_valid && gx.variant_get_type(&equals) == GX_BOOL) gx.get_variant_to_type_constructor(GX_BOOL)(&is_null, &equals);
  gx.variant_destroy(&equals);
  gx.variant_destroy(&nil);
  return is_valid && !is_null;
}

static bool take_text(void* from, Value* to, Held* held) {
  gx_string text;
  int64_t length;
  gx.get_variant_to_type_constructor(GX_STRING)(&text, from);
  length = gx.string_to_utf8_chars(&text, NULL, 0);
  held->text = length < 0 ? NULL : malloc((size_t)length + 1);
  if (held->text != NULL) held->text[gx.string_to_utf8_chars(&text, held->text, length)] = 0;
  destroy(GX_STRING, &text);
  to->text = held->text;
  return held->text != NULL;
}

static bool take_vectors(void* from, Value* to, Held* held) {
  int64_t count = 0;
  if (!call_variant(from, "size", NULL, 0, GX_INT, &count)) return false;
  gx.get_variant_to_type_constructor(GX_PACKED_VECTOR3_ARRAY)(&held->packed, from);
  to->count = (size_t)count;
  to->data = count > 0 ? gx.packed_vector3_array_operator_index_const(&held->packed, 0) : NULL;
  return true;
}

static bool take(void* from, Kind kind, Value* to, Held* held) {
  const int32_t type = gx.variant_get_type(from);
  if (kind == KIND_OBJECT) {
    to->object = NULL;
    if (type == GX_OBJECT && is_alive(from)) gx.get_variant_to_type_constructor(GX_OBJECT)(&to->object, from);
    return type == GX_OBJECT || type == GX_NIL;
  }
  if (kind == KIND_REAL && type == GX_INT) {
    gx.get_variant_to_type_constructor(GX_INT)(&to->integer, from);
    to->real = (double)to->integer;
    return true;
  }
  if (type != type_of(kind)) return false;
  switch (kind) {
    case KIND_INT: gx.get_variant_to_type_constructor(type)(&to->integer, from); return true;
    case KIND_REAL: gx.get_variant_to_type_constructor(type)(&to->real, from); return true;
    case KIND_VECTOR: gx.get_variant_to_type_constructor(type)(to->vector, from); return true;
    case KIND_PLACE: gx.get_variant_to_type_constructor(type)(to->place, from); return true;
    case KIND_TEXT: return take_text(from, to, held);
    case KIND_VECTORS: return take_vectors(from, to, held);
    default: return false; /* no method takes it */
  }
}

static void let_go(Kind kind, Held* held) {
  if (kind == KIND_TEXT) free(held->text);
  if (kind == KIND_VECTORS) destroy(GX_PACKED_VECTOR3_ARRAY, &held->packed);
}

static gx_variant bytes_of(const Value* from) {
  gx_packed packed;
  gx_variant made, size;
  const int64_t count = (int64_t)from->count;
  gx.variant_get_ptr_constructor(GX_PACKED_BYTE_ARRAY, 0)(&packed, NULL);
  made = variant_of(GX_PACKED_BYTE_ARRAY, &packed);
  destroy(GX_PACKED_BYTE_ARRAY, &packed);
  if (count == 0) return made;
  size = variant_of(GX_INT, &count);
  if (!call_variant(&made, "resize", &size, 1, GX_NIL, NULL)) return made;
  gx.get_variant_to_type_constructor(GX_PACKED_BYTE_ARRAY)(&packed, &made);
  gx.variant_destroy(&made);
  memcpy(gx.packed_byte_array_operator_index(&packed, 0), from->data, from->count);
  made = variant_of(GX_PACKED_BYTE_ARRAY, &packed);
  destroy(GX_PACKED_BYTE_ARRAY, &packed);
  return made;
}

static gx_variant given(const Value* from, Kind kind) {
  const gx_bool boolean = from->boolean;
  gx_variant made;
  gx_string text;
  switch (kind) {
    case KIND_BOOL: return variant_of(GX_BOOL, &boolean);
    case KIND_INT: return variant_of(GX_INT, &from->integer);
    case KIND_REAL: return variant_of(GX_FLOAT, &from->real);
    case KIND_VECTOR: return variant_of(GX_VECTOR3, from->vector);
    case KIND_PLACE: return variant_of(GX_TRANSFORM3D, from->place);
    case KIND_BYTES: return bytes_of(from);
    case KIND_TEXT:
      gx.string_new_with_utf8_chars(&text, from->text == NULL ? "" : from->text);
      made = variant_of(GX_STRING, &text);
      destroy(GX_STRING, &text);
      return made;
    default: gx.variant_new_nil(&made); return made;
  }
}

/* ---- Calls ---- */

/* `result` is a variant that is nil. */
static void called(void* data, void* self, const void* const* arguments, int64_t count, void* result, gx_call_error* error) {
  const Method* method = data;
  Value values[MOST_ARGUMENTS], answer = {0};
  Held held[MOST_ARGUMENTS];
  int taken = 0;
  error->error = count < method->argument_count ? GX_CALL_TOO_FEW : count > method->argument_count ? GX_CALL_TOO_MANY : GX_CALL_OK;
  error->expected = method->argument_count;
  if (error->error != GX_CALL_OK) return;
  while (taken < count && take((void*)arguments[taken], method->arguments[taken], &values[taken], &held[taken])) ++taken;
  if (taken == count) {
    const gx_variant made = (method->call(self, values, &answer), given(&answer, method->result));
    memcpy(result, &made, sizeof made); /* nil holds nothing that had to be destroyed */
  } else {
    error->error = GX_CALL_INVALID_ARGUMENT;
    error->argument = taken;
    error->expected = type_of(method->arguments[taken]);
  }
  while (taken-- > 0) let_go(method->arguments[taken], &held[taken]);
}

/* What GDScript with types calls: the same, but values without their variants; `result` holds one already. */
static void called_typed(void* data, void* self, const void* const* arguments, void* result) {
  const Method* method = data;
  gx_variant variants[MOST_ARGUMENTS], made;
  const void* list[MOST_ARGUMENTS] = {NULL};
  gx_call_error error;
  int i;
  for (i = 0; i < method->argument_count; ++i) {
    variants[i] = variant_of(type_of(method->arguments[i]), arguments[i]);
    list[i] = &variants[i];
  }
  gx.variant_new_nil(&made);
  called(data, self, list, method->argument_count, &made, &error);
  if (error.error == GX_CALL_OK && method->result != KIND_NIL) {
    const int32_t type = type_of(method->result);
    if (method->result == KIND_TEXT || method->result == KIND_BYTES) destroy(type, result);
    gx.get_variant_to_type_constructor(type)(result, &made);
  }
  gx.variant_destroy(&made);
  for (i = 0; i < method->argument_count; ++i) gx.variant_destroy(&variants[i]);
}

static void* created(void* data) {
  const Class* class_of = data;
  gx_string base = name_of("RefCounted"), name = name_of(class_of->name);
  void* object = gx.classdb_construct_object(&base);
  void* self = class_of->create(object);
  if (self != NULL) gx.object_set_instance(object, &name, self);
  else gx.print_error("no memory", class_of->name, "foretouch", 0, 0);
  destroy(GX_STRING_NAME, &base);
  destroy(GX_STRING_NAME, &name);
  return object;
}

static void released(void* data, void* self) {
  if (self != NULL) ((const Class*)data)->destroy(self);
}

/* ---- Registration ---- */

static gx_property property_of(Kind kind, gx_string* empty_name, gx_string* empty) {
  const gx_property made = {type_of(kind), empty_name, empty_name, 0, empty, 6 /* as usual: stored and in the editor */};
  return made;
}

static void register_method(gx_string* class_name, const Method* from, gx_string* empty_name, gx_string* empty) {
  gx_string name = name_of(from->name);
  gx_property result = property_of(from->result, empty_name, empty), arguments[MOST_ARGUMENTS];
  int32_t metadata[MOST_ARGUMENTS] = {0};
  gx_method method = {0};
  int i;
  for (i = 0; i < from->argument_count; ++i) arguments[i] = property_of(from->arguments[i], empty_name, empty);
  method.name = &name;
  method.data = (void*)from;
  method.call = called;
  method.ptrcall = called_typed;
  method.flags = GX_METHOD_NORMAL;
  method.has_result = from->result != KIND_NIL;
  method.result = &result;
  method.argument_count = (uint32_t)from->argument_count;
  method.arguments = arguments;
  method.argument_metadata = metadata;
  gx.classdb_register_extension_class_method(this_library, class_name, &method);
  destroy(GX_STRING_NAME, &name);
}

static const Class* const all[] = {&scene_class, &body_class};

static void initialize(void* data, int32_t level) {
  gx_string parent, empty_name, empty;
  size_t c, m;
  (void)data;
  if (level != GX_LEVEL_SCENE) return;
  parent = name_of("RefCounted");
  empty_name = name_of("");
  gx.string_new_with_utf8_chars(&empty, "");
  for (c = 0; c < sizeof all / sizeof *all; ++c) {
    gx_string name = name_of(all[c]->name);
    gx_class made = {0};
    made.create = created;
    made.release = released;
    made.data = (void*)all[c];
    gx.classdb_register_extension_class(this_library, &name, &parent, &made);
    for (m = 0; m < all[c]->method_count; ++m) register_method(&name, &all[c]->methods[m], &empty_name, &empty);
    destroy(GX_STRING_NAME, &name);
  }
  destroy(GX_STRING_NAME, &parent);
  destroy(GX_STRING_NAME, &empty_name);
  destroy(GX_STRING, &empty);
}

static void deinitialize(void* data, int32_t level) {
  size_t c;
  (void)data;
  if (level != GX_LEVEL_SCENE) return;
  for (c = 0; c < sizeof all / sizeof *all; ++c) {
    gx_string name = name_of(all[c]->name);
    gx.classdb_unregister_extension_class(this_library, &name);
    destroy(GX_STRING_NAME, &name);
  }
}

/* ---- Entry: foretouch.gdextension names it ---- */

#define TAKEN(returns, name, arguments)                              \
  gx.name = (returns(*) arguments)get_function(#name);               \
  if (gx.name == NULL) {                                             \
    fprintf(stderr, "foretouch: this Godot has no '%s'\n", #name);   \
    return 0;                                                        \
  }

EXPORTED gx_bool foretouch_godot4_init(gx_get_function get_function, void* library, gx_initialization* initialization) {
  GX_INTERFACE(TAKEN)
  this_library = library;
  initialization->minimum_level = GX_LEVEL_SCENE;
  initialization->data = NULL;
  initialization->initialize = initialize;
  initialization->deinitialize = deinitialize;
  return 1;
}
