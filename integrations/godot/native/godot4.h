/* godot4.h: what is used here of GDExtension, the C interface of Godot 4.1 and later, declared from
 * its published description. Functions are asked for by name. What would need an engine's hashes is
 * called by name, too. */
#ifndef FORETOUCH_GODOT_GODOT4_H
#define FORETOUCH_GODOT_GODOT4_H

#include <stdint.h>

enum {
  GX_NIL = 0,
  GX_BOOL = 1,
  GX_INT = 2,
  GX_FLOAT = 3,
  GX_STRING = 4,
  GX_VECTOR3 = 9,
  GX_TRANSFORM3D = 18,
  GX_STRING_NAME = 21,
  GX_OBJECT = 24,
  GX_PACKED_BYTE_ARRAY = 29,
  GX_PACKED_VECTOR3_ARRAY = 36
};
enum { GX_EQUAL = 0 };       /* operator */
enum { GX_LEVEL_SCENE = 2 }; /* of initialisation */
enum { GX_METHOD_NORMAL = 1 };
enum { GX_CALL_OK = 0, GX_CALL_INVALID_ARGUMENT = 2, GX_CALL_TOO_MANY = 3, GX_CALL_TOO_FEW = 4 };

/* Values of builds whose real_t is float, on machines of 64 bits. */
typedef struct gx_variant {
  uint64_t opaque[3];
} gx_variant;
typedef struct gx_string {
  void* opaque;
} gx_string;
typedef struct gx_packed {
  void* opaque[2];
} gx_packed;

typedef uint8_t gx_bool;
typedef struct gx_call_error {
  int32_t error, argument, expected;
} gx_call_error;
typedef void (*gx_function)(void);
typedef gx_function (*gx_get_function)(const char* name);

typedef struct gx_initialization {
  int32_t minimum_level;
  void* data;
  void (*initialize)(void* data, int32_t level);
  void (*deinitialize)(void* data, int32_t level);
} gx_initialization;

typedef struct gx_property {
  int32_t type;
  void *name, *class_name;
  uint32_t hint;
  void* hint_string;
  uint32_t usage;
} gx_property;

typedef void (*gx_call)(void* method, void* self, const void* const* arguments, int64_t count,
                        void* result, gx_call_error* error);

typedef struct gx_method {
  void* name;
  void* data;
  gx_call call;
  void (*ptrcall)(void* method, void* self, const void* const* arguments, void* result);
  uint32_t flags;
  gx_bool has_result;
  gx_property* result;
  int32_t result_metadata;
  uint32_t argument_count;
  gx_property* arguments;
  int32_t* argument_metadata;
  uint32_t default_count;
  void** defaults;
} gx_method;

/* The first shape of it, which later Godots take, too. */
typedef struct gx_class {
  gx_bool is_virtual, is_abstract;
  gx_function set, get, get_list, free_list, can_revert, get_revert, notify, to_string, reference,
      unreference;
  void* (*create)(void* data);
  void (*release)(void* data, void* self);
  gx_function get_virtual, get_rid;
  void* data;
} gx_class;

typedef void (*gx_from_type)(void* variant, void* from);
typedef void (*gx_to_type)(void* to, void* variant);
typedef void (*gx_destructor)(void* self);
typedef void (*gx_constructor)(void* self, const void* const* arguments);

/* `F(return, name, arguments)` */
#define GX_INTERFACE(F)                                                                          \
  F(void, print_error,                                                                           \
    (const char* what, const char* function, const char* file, int32_t line, gx_bool in_editor)) \
  F(void, string_name_new_with_latin1_chars, (void* to, const char* from, gx_bool is_static))    \
  F(void, string_new_with_utf8_chars, (void* to, const char* from))                              \
  F(int64_t, string_to_utf8_chars, (const void* self, char* to, int64_t most))                   \
  F(int32_t, variant_get_type, (const void* self))                                               \
  F(void, variant_new_nil, (void* to))                                                           \
  F(void, variant_destroy, (void* self))                                                         \
  F(void, variant_evaluate,                                                                      \
    (int32_t operation, const void* a, const void* b, void* result, gx_bool* is_valid))          \
  F(void, variant_call,                                                                          \
    (void* self, const void* method, const void* const* arguments, int64_t count, void* result,  \
     gx_call_error* error))                                                                      \
  F(gx_from_type, get_variant_from_type_constructor, (int32_t type))                             \
  F(gx_to_type, get_variant_to_type_constructor, (int32_t type))                                 \
  F(gx_constructor, variant_get_ptr_constructor, (int32_t type, int32_t number))                 \
  F(gx_destructor, variant_get_ptr_destructor, (int32_t type))                                   \
  F(uint8_t*, packed_byte_array_operator_index, (void* self, int64_t index))                     \
  F(void*, packed_vector3_array_operator_index_const, (const void* self, int64_t index))         \
  F(void*, classdb_construct_object, (const void* class_name))                                   \
  F(void, object_set_instance, (void* object, const void* class_name, void* self))               \
  F(void, classdb_register_extension_class,                                                      \
    (void* library, const void* name, const void* parent, const gx_class* from))                 \
  F(void, classdb_register_extension_class_method,                                               \
    (void* library, const void* class_name, const gx_method* from))                              \
  F(void, classdb_unregister_extension_class, (void* library, const void* name))

#endif
