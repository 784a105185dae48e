/* godot4_host.c: a host of our own in the place of Godot 4, which has what GDExtension promises and no more: it
 * loads the add-on, registers what that registers, calls both ways, and counts what is not given back. It is
 * written from the same description as godot4.h, and so does not show that Godot 4 itself agrees.
 *   godot4_host ADDON_LIBRARY */
#include <dlfcn.h>
#include <foretouch/foretouch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrations/godot/native/core.h"
#include "integrations/godot/native/godot4.h"

static long held; /* texts and arrays that live */
static int errors, registered;

static void expect(int is_so, const char* what) {
  if (is_so) return;
  fprintf(stderr, "not so: %s\n", what);
  exit(1);
}

/* ---- Values: a text is a counted char*, an array a counted block; a variant has a type and a pointer or so ---- */

typedef struct Block { int uses; int64_t count; float data[]; } Block;
typedef struct Variant { int64_t type; union { int64_t integer; double real; void* pointer; void* block[2]; } is; } Variant;
typedef struct Node { const char* class_name; float place[12]; int is_alive; } Node;

static Block* block_of(const void* data, int64_t count, size_t size) {
  Block* made = calloc(1, sizeof *made + (size_t)count * size + 16);
  made->uses = 1;
  made->count = count;
  if (data != NULL) memcpy(made->data, data, (size_t)count * size);
  ++held;
  return made;
}
static void drop(void* of) {
  Block* block = of;
  if (block != NULL && --block->uses == 0) {
    free(block);
    --held;
  }
}
static Block* use(void* of) {
  if (of != NULL) ++((Block*)of)->uses;
  return of;
}
static const char* text_in(const void* string) { return (const char*)(*(Block* const*)string)->data; }

static void text_new(void* to, const char* from) { *(Block**)to = block_of(from, (int64_t)strlen(from) + 1, 1); }
static void name_new(void* to, const char* from, gx_bool is_static) { (void)is_static; text_new(to, from); }
static int64_t text_out(const void* self, char* to, int64_t most) {
  const int64_t length = (int64_t)strlen(text_in(self));
  if (to != NULL) memcpy(to, text_in(self), (size_t)(length < most ? length : most));
  return length;
}

static int is_block(int64_t type) {
  return type == GX_STRING || type == GX_VECTOR3 || type == GX_TRANSFORM3D || type == GX_PACKED_BYTE_ARRAY || type == GX_PACKED_VECTOR3_ARRAY;
}
static int32_t type_of(const void* self) { return (int32_t)((const Variant*)self)->type; }
static void nil_new(void* to) { memset(to, 0, sizeof(Variant)); }
static void variant_destroy(void* self) {
  if (is_block(type_of(self))) drop(((Variant*)self)->is.pointer);
  nil_new(self);
}

/* Vectors and transforms are floats in place; in a variant here they are blocks, to see whether they are given back. */
#define FROM(name, body) static void from_##name(void* variant, void* from) { Variant* to = variant; nil_new(to); to->type = name; body }
FROM(GX_BOOL, to->is.integer = *(gx_bool*)from;)
FROM(GX_INT, to->is.integer = *(int64_t*)from;)
FROM(GX_FLOAT, to->is.real = *(double*)from;)
FROM(GX_OBJECT, to->is.pointer = *(void**)from;)
FROM(GX_STRING, to->is.pointer = use(*(Block**)from);)
FROM(GX_VECTOR3, to->is.pointer = block_of(from, 3, 4);)
FROM(GX_TRANSFORM3D, to->is.pointer = block_of(from, 12, 4);)
FROM(GX_PACKED_BYTE_ARRAY, to->is.pointer = use(*(Block**)from);)
FROM(GX_PACKED_VECTOR3_ARRAY, to->is.pointer = use(*(Block**)from);)
static gx_from_type from_type(int32_t type) {
  switch (type) {
    case GX_BOOL: return from_GX_BOOL;
    case GX_INT: return from_GX_INT;
    case GX_FLOAT: return from_GX_FLOAT;
    case GX_OBJECT: return from_GX_OBJECT;
    case GX_STRING: return from_GX_STRING;
    case GX_VECTOR3: return from_GX_VECTOR3;
    case GX_TRANSFORM3D: return from_GX_TRANSFORM3D;
    case GX_PACKED_BYTE_ARRAY: return from_GX_PACKED_BYTE_ARRAY;
    case GX_PACKED_VECTOR3_ARRAY: return from_GX_PACKED_VECTOR3_ARRAY;
    default: return NULL;
  }
}
#define TO(name, body) static void to_##name(void* to, void* variant) { const Variant* from = variant; expect(from->type == name, "the type is asked before"); body }
TO(GX_BOOL, *(gx_bool*)to = (gx_bool)from->is.integer;)
TO(GX_INT, *(int64_t*)to = from->is.integer;)
TO(GX_FLOAT, *(double*)to = from->is.real;)
TO(GX_OBJECT, *(void**)to = from->is.pointer;)
TO(GX_STRING, *(Block**)to = use(from->is.pointer);)
TO(GX_VECTOR3, memcpy(to, ((Block*)from->is.pointer)->data, 12);)
TO(GX_TRANSFORM3D, memcpy(to, ((Block*)from->is.pointer)->data, 48);)
TO(GX_PACKED_BYTE_ARRAY, *(Block**)to = use(from->is.pointer);)
TO(GX_PACKED_VECTOR3_ARRAY, *(Block**)to = use(from->is.pointer);)
static gx_to_type to_type(int32_t type) {
  switch (type) {
    case GX_BOOL: return to_GX_BOOL;
    case GX_INT: return to_GX_INT;
    case GX_FLOAT: return to_GX_FLOAT;
    case GX_OBJECT: return to_GX_OBJECT;
    case GX_STRING: return to_GX_STRING;
    case GX_VECTOR3: return to_GX_VECTOR3;
    case GX_TRANSFORM3D: return to_GX_TRANSFORM3D;
    case GX_PACKED_BYTE_ARRAY: return to_GX_PACKED_BYTE_ARRAY;
    case GX_PACKED_VECTOR3_ARRAY: return to_GX_PACKED_VECTOR3_ARRAY;
    default: return NULL;
  }
}
static void drop_in(void* self) { drop(*(Block**)self); }
static gx_destructor destructor(int32_t type) {
  expect(type == GX_STRING || type == GX_STRING_NAME || type == GX_PACKED_BYTE_ARRAY || type == GX_PACKED_VECTOR3_ARRAY, "it has a destructor");
  return drop_in;
}
static void bytes_new(void* self, const void* const* arguments) { (void)arguments; *(Block**)self = block_of(NULL, 0, 1); }
static gx_constructor constructor(int32_t type, int32_t number) {
  expect(type == GX_PACKED_BYTE_ARRAY && number == 0, "the one that is used");
  return bytes_new;
}
static uint8_t* bytes_at(void* self, int64_t index) { /* copies before it is written, as Godot's do */
  Block** block = self;
  expect(index >= 0 && index < (*block)->count, "within the array");
  if ((*block)->uses > 1) {
    Block* copy = block_of((*block)->data, (*block)->count, 1);
    drop(*block);
    *block = copy;
  }
  return (uint8_t*)(*block)->data + index;
}
static void* vectors_at(const void* self, int64_t index) { return (*(Block* const*)self)->data + 3 * index; }

static void evaluate(int32_t operation, const void* a, const void* b, void* result, gx_bool* is_valid) {
  const Variant* object = a;
  gx_bool equals = object->is.pointer == NULL || !((Node*)object->is.pointer)->is_alive;
  expect(operation == GX_EQUAL && type_of(a) == GX_OBJECT && type_of(b) == GX_NIL, "an object against null");
  from_GX_BOOL(result, &equals);
  *is_valid = 1;
}

/* Methods of Godot's classes. */
static void call(void* of, const void* method, const void* const* arguments, int64_t count, void* result, gx_call_error* error) {
  Variant* self = of;
  Node* node = self->is.pointer;
  const char* name = text_in(method);
  nil_new(result);
  error->error = GX_CALL_OK;
  if (self->type == GX_PACKED_VECTOR3_ARRAY && strcmp(name, "size") == 0) {
    from_GX_INT(result, &((Block*)self->is.pointer)->count);
  } else if (self->type == GX_PACKED_BYTE_ARRAY && strcmp(name, "resize") == 0 && count == 1) {
    const int64_t size = ((const Variant*)arguments[0])->is.integer;
    drop(self->is.pointer);
    self->is.pointer = block_of(NULL, size, 1);
  } else if (self->type == GX_OBJECT && strcmp(name, "is_class") == 0) {
    Block* text = ((const Variant*)arguments[0])->is.pointer;
    gx_bool is = strcmp(node->class_name, (const char*)text->data) == 0;
    from_GX_BOOL(result, &is);
  } else if (self->type == GX_OBJECT && strcmp(name, "get_global_transform") == 0) {
    from_GX_TRANSFORM3D(result, node->place);
  } else if (self->type == GX_OBJECT && strcmp(name, "set_global_transform") == 0) {
    memcpy(node->place, ((Block*)((const Variant*)arguments[0])->is.pointer)->data, sizeof node->place);
  } else {
    error->error = 1;
  }
}

/* ---- Classes ---- */

typedef struct Registered { char name[40]; gx_class made; gx_method methods[60]; char names[60][40]; int32_t types[60][5]; int count; } Registered;
static Registered classes[4];

static Registered* class_named(const char* name) {
  int i;
  for (i = 0; i < 4; ++i)
    if (strcmp(classes[i].name, name) == 0) return &classes[i];
  expect(0, name);
  return NULL;
}
static void register_class(void* library, const void* name, const void* parent, const gx_class* from) {
  expect(library == &held && strcmp(text_in(parent), "RefCounted") == 0, "of this library, counted");
  snprintf(classes[registered].name, 40, "%s", text_in(name));
  classes[registered++].made = *from;
}
static void register_method(void* library, const void* class_name, const gx_method* from) {
  Registered* to = class_named(text_in(class_name));
  uint32_t i;
  (void)library;
  snprintf(to->names[to->count], 40, "%s", text_in(from->name));
  for (i = 0; i < from->argument_count; ++i) to->types[to->count][i] = from->arguments[i].type;
  to->types[to->count][4] = from->has_result ? from->result->type : GX_NIL;
  to->methods[to->count++] = *from;
}
static void unregister(void* library, const void* name) { (void)library; class_named(text_in(name))->name[0] = 0; --registered; }
static void* construct(const void* name) { expect(strcmp(text_in(name), "RefCounted") == 0, "counted"); return calloc(1, sizeof(Node)); }
static void* last_self;
static void set_instance(void* object, const void* name, void* self) { (void)object; class_named(text_in(name)); last_self = self; }
static void print_error(const char* what, const char* function, const char* file, int32_t line, gx_bool in_editor) {
  (void)what, (void)function, (void)file, (void)line, (void)in_editor;
  ++errors;
}

static gx_function function_named(const char* name) {
  static const struct { const char* name; gx_function function; } list[] = {
      {"print_error", (gx_function)print_error}, {"string_name_new_with_latin1_chars", (gx_function)name_new},
      {"string_new_with_utf8_chars", (gx_function)text_new}, {"string_to_utf8_chars", (gx_function)text_out},
      {"variant_get_type", (gx_function)type_of}, {"variant_new_nil", (gx_function)nil_new}, {"variant_destroy", (gx_function)variant_destroy},
      {"variant_evaluate", (gx_function)evaluate}, {"variant_call", (gx_function)call},
      {"get_variant_from_type_constructor", (gx_function)from_type}, {"get_variant_to_type_constructor", (gx_function)to_type},
      {"variant_get_ptr_constructor", (gx_function)constructor}, {"variant_get_ptr_destructor", (gx_function)destructor},
      {"packed_byte_array_operator_index", (gx_function)bytes_at}, {"packed_vector3_array_operator_index_const", (gx_function)vectors_at},
      {"classdb_construct_object", (gx_function)construct}, {"object_set_instance", (gx_function)set_instance},
      {"classdb_register_extension_class", (gx_function)register_class},
      {"classdb_register_extension_class_method", (gx_function)register_method},
      {"classdb_unregister_extension_class", (gx_function)unregister}};
  size_t i;
  for (i = 0; i < sizeof list / sizeof *list; ++i)
    if (strcmp(list[i].name, name) == 0) return list[i].function;
  return NULL;
}

/* ---- The test ---- */

static gx_method* method_named(Registered* of, const char* name) {
  int i;
  for (i = 0; i < of->count; ++i)
    if (strcmp(of->names[i], name) == 0) return &of->methods[i];
  expect(0, name);
  return NULL;
}

/* By variants; the arguments are destroyed. */
static Variant ask(Registered* of, void* self, const char* name, int count, Variant* arguments, int32_t error_expected) {
  gx_method* method = method_named(of, name);
  const void* list[5] = {NULL};
  gx_call_error error = {0, 0, 0};
  Variant result;
  int i;
  nil_new(&result);
  for (i = 0; i < count; ++i) list[i] = &arguments[i];
  method->call(method->data, self, list, count, &result, &error);
  expect(error.error == error_expected, name);
  for (i = 0; i < count; ++i) variant_destroy(&arguments[i]);
  return result;
}

static Variant of_float(double from) { Variant to; from_GX_FLOAT(&to, &from); return to; }
static Variant of_int(int64_t from) { Variant to; from_GX_INT(&to, &from); return to; }
static Variant of_text(const char* from) { Variant to; void* text; text_new(&text, from); from_GX_STRING(&to, &text); drop(text); return to; }
static Variant of_object(void* from) { Variant to; from_GX_OBJECT(&to, &from); return to; }
static Variant of_floats(int32_t type, const float* from) { Variant to; from_type(type)(&to, (void*)from); return to; }

static const float corners[18] = {0, -5, -5, 0, 5, -5, 0, 5, 5, 0, -5, -5, 0, 5, 5, 0, -5, 5};

/* The share before a ball's touch in C, by the library itself. */
static double share_in_c(void) {
  static const double zero[3] = {0, 0, 0}, one[4] = {1, 0, 0, 0}, far[3] = {1, 0, 0};
  double positions[18];
  const char* name = "ball";
  const int32_t parent = -1, link = 0;
  const ft_lss lss = {{0, 0, 0}, {0, 0, 0}, 0.02f};
  const ft_pose from = {sizeof from, 1, one, zero}, to = {sizeof to, 1, one, far};
  ft_scene_arrays scene_arrays;
  ft_avatar_arrays avatar_arrays;
  ft_scene* scene;
  ft_avatar* avatar;
  ft_query* query;
  ft_contact contact;
  int i;
  for (i = 0; i < 18; ++i) positions[i] = corners[i] + (i % 3 == 0 ? 0.5f : 0);
  ft_scene_arrays_init(&scene_arrays, sizeof scene_arrays);
  scene_arrays.positions = positions;
  scene_arrays.vertex_count = 6;
  scene_arrays.triangle_count = 2;
  ft_avatar_arrays_init(&avatar_arrays, sizeof avatar_arrays);
  avatar_arrays.joint_count = avatar_arrays.lss_count = 1;
  avatar_arrays.names = &name;
  avatar_arrays.parents = &parent;
  avatar_arrays.offsets = zero;
  avatar_arrays.lss = &lss;
  avatar_arrays.lss_links = &link;
  contact.size = sizeof contact;
  expect(ft_scene_create(&scene_arrays, &scene) == FT_OK && ft_avatar_create(&avatar_arrays, &avatar) == FT_OK &&
             ft_query_create(scene, avatar, NULL, &query) == FT_OK && ft_query_step(query, &from, &to) == FT_OK &&
             ft_query_links(query, &contact, 1, NULL) == FT_OK,
         "C answers");
  ft_query_destroy(query);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return contact.toi;
}

static const float at_half[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0, 0};
static const float at_zero[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
static const float at_one[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0};
static const float origin[3] = {0, 0, 0};

static Variant make_scene(Registered* of, void* self) {
  Block* faces = block_of(corners, 18, 4);
  Variant arguments[3], said;
  faces->count = 6;
  from_GX_PACKED_VECTOR3_ARRAY(&arguments[0], &faces);
  drop(faces);
  arguments[1] = of_floats(GX_TRANSFORM3D, at_half);
  arguments[2] = of_text("board");
  said = ask(of, self, "add_mesh", 3, arguments, GX_CALL_OK);
  expect(said.type == GX_STRING && text_in(&said.is.pointer)[0] == 0, "the mesh is taken");
  variant_destroy(&said);
  return ask(of, self, "build", 0, NULL, GX_CALL_OK);
}

static void test_body(Registered* of, void* self, void* scene, Node* node) {
  Variant joint[3] = {of_text("ball"), of_int(-1), of_int(-1)};
  Variant capsule[4] = {of_int(0), of_floats(GX_VECTOR3, origin), of_floats(GX_VECTOR3, origin), of_float(0.02f)};
  Variant build[1] = {of_object(node)}, use_scene[2] = {of_object(scene), of_float(1e-3)};
  Variant sweep[3] = {of_object(node), of_floats(GX_TRANSFORM3D, at_zero), of_floats(GX_TRANSFORM3D, at_one)};
  Variant first[1] = {of_int(0)}, wrong[1] = {of_text("one")}, text, again[1] = {of_object(node)};
  const void* typed[1];
  const int64_t zero = 0;
  void* said;
  double share = -1;
  gx_method* method;
  expect(ask(of, self, "add_joint", 3, joint, GX_CALL_OK).is.integer == 0, "a joint");
  expect(ask(of, self, "add_capsule", 4, capsule, GX_CALL_OK).is.integer == 1, "a capsule");
  expect(ask(of, self, "build", 1, build, GX_CALL_OK).is.integer == 1, "it is built");
  expect(ask(of, self, "use_scene", 2, use_scene, GX_CALL_OK).is.integer == 1, "of the scene");
  expect(ask(of, self, "sweep", 3, sweep, GX_CALL_OK).is.integer == 1, "one contact");
  share = ask(of, self, "contact_share", 1, first, GX_CALL_OK).is.real;
  expect(share == share_in_c() && fabs(share - 0.48) < 2e-3, "the share has the bits of C");
  typed[0] = &zero;
  share = -1;
  method = method_named(of, "contact_share");
  method->ptrcall(method->data, self, typed, &share);
  expect(share == share_in_c(), "and by the typed call");
  text = ask(of, self, "step_bytes", 0, NULL, GX_CALL_OK);
  expect(text.type == GX_PACKED_BYTE_ARRAY && ((Block*)text.is.pointer)->count == (int64_t)(56 + sizeof(ft_contact)), "bytes");
  variant_destroy(&text);
  nil_new(&text);
  ask(of, self, "contact_share", 1, wrong, GX_CALL_INVALID_ARGUMENT);
  ask(of, self, "contact_share", 0, NULL, GX_CALL_TOO_FEW);
  node->is_alive = 0;
  expect(ask(of, self, "step", 1, again, GX_CALL_OK).is.integer == -1, "a node that was freed is none");
  text_new(&said, "before");
  method = method_named(of, "error");
  method->ptrcall(method->data, self, NULL, &said);
  expect(strstr(text_in(&said), "missing or was freed") != NULL, "and is told");
  drop(said);
}

int main(int count, char** arguments) {
  gx_initialization level;
  gx_bool (*entry)(gx_get_function, void*, gx_initialization*) = NULL;
  void* library = count == 2 ? dlopen(arguments[1], RTLD_NOW) : NULL;
  Node node = {"Node3D", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 1};
  Node *scene_object, *body_object;
  void *scene, *body;
  Variant said;
  Registered *scenes, *bodies;
  expect(library != NULL, "the add-on is loaded");
  *(void**)&entry = dlsym(library, "foretouch_godot4_init");
  expect(entry != NULL && entry(function_named, &held, &level) && level.minimum_level == GX_LEVEL_SCENE, "its entry");
  level.initialize(level.data, 0);
  expect(registered == 0, "nothing before the scene's level");
  level.initialize(level.data, GX_LEVEL_SCENE);
  expect(registered == 2 && held == 0, "two classes, and nothing is held");
  scenes = class_named("FtScene");
  bodies = class_named("FtBody");
  scene_object = scenes->made.create(scenes->made.data);
  scene = last_self;
  body_object = bodies->made.create(bodies->made.data);
  body = last_self;
  scene_object->is_alive = body_object->is_alive = 1;
  said = make_scene(scenes, scene);
  expect(said.type == GX_STRING && text_in(&said.is.pointer)[0] == 0, "the scene is built");
  variant_destroy(&said);
  test_body(bodies, body, scene_object, &node);
  scenes->made.release(scenes->made.data, scene);
  bodies->made.release(bodies->made.data, body);
  level.deinitialize(level.data, GX_LEVEL_SCENE);
  expect(registered == 0 && held == 0 && errors == 0, "nothing is left");
  printf("%d and %d methods; a sweep has the bits of C, by both ways to call; nothing is held\n", scenes->count, bodies->count);
  free(scene_object);
  free(body_object);
  return 0;
}
