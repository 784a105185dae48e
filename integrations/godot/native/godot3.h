/* godot3.h: what is used here of GDNative, the C interface of Godot 3.x, declared from its
 * published description: gdnative_api.json, version 1.0 of the core (and 1.1 for one function),
 * version 1.0 of NativeScript. Its tables of functions only ever grow at the end, so a function's
 * number stays. */
#ifndef FORETOUCH_GODOT_GODOT3_H
#define FORETOUCH_GODOT_GODOT3_H

#include <stdbool.h>
#include <stdint.h>

/* Values of Godot that are passed by value, so their size and alignment count. */
typedef struct gd_variant {
  uint8_t bytes[24];
} gd_variant;
typedef struct gd_string {
  uint8_t bytes[sizeof(void*)];
} gd_string;
typedef struct gd_char_string {
  uint8_t bytes[sizeof(void*)];
} gd_char_string;
typedef struct gd_pool {
  uint8_t bytes[sizeof(void*)];
} gd_pool; /* any Pool*Array */
typedef struct gd_vector3 {
  uint8_t bytes[12];
} gd_vector3;
typedef struct gd_transform {
  uint8_t bytes[48];
} gd_transform;

enum {
  GD_NIL = 0,
  GD_BOOL = 1,
  GD_INT = 2,
  GD_REAL = 3,
  GD_STRING = 4,
  GD_VECTOR3 = 7,
  GD_TRANSFORM = 13,
  GD_OBJECT = 17,
  GD_POOL_VECTOR3_ARRAY = 25
};

typedef struct gd_version {
  unsigned int major, minor;
} gd_version;
typedef void (*gd_function)(void);

typedef struct gd_extension {
  unsigned int type;
  gd_version version;
  const struct gd_extension* next;
  gd_function functions[1]; /* as many as this version has */
} gd_extension;

typedef struct gd_core {
  unsigned int type;
  gd_version version;
  const gd_extension* next;
  unsigned int extension_count;
  const gd_extension** extensions;
  gd_function functions[744];
} gd_core;

#define GD_NATIVESCRIPT 1 /* type of an extension */

typedef struct gd_init_options {
  bool in_editor;
  uint64_t core_hash, editor_hash, no_hash;
  void (*report_version_mismatch)(const void* library, const char* what, gd_version want,
                                  gd_version have);
  void (*report_loading_error)(const void* library, const char* what);
  void* library;
  const gd_core* core;
  const gd_string* path;
} gd_init_options;

/* NativeScript. */
typedef struct gd_create {
  void* (*call)(void* owner, void* data);
  void* data;
  void (*release)(void* data);
} gd_create;
typedef struct gd_destroy {
  void (*call)(void* owner, void* data, void* self);
  void* data;
  void (*release)(void* data);
} gd_destroy;
typedef gd_variant (*gd_method_call)(void* owner, void* data, void* self, int count,
                                     gd_variant** arguments);
typedef struct gd_method {
  gd_method_call call;
  void* data;
  void (*release)(void* data);
} gd_method;
typedef struct gd_method_attributes {
  int rpc;
} gd_method_attributes; /* 0: never by network */

/* The numbers of functions in the tables, and their types. `F(return, number, name, arguments)` */
#define GD_CORE(F)                                                                    \
  F(void, 155, pool_byte_array_new, (gd_pool * to))                                   \
  F(void, 164, pool_byte_array_resize, (gd_pool * self, int size))                    \
  F(void*, 166, pool_byte_array_write, (gd_pool * self))                              \
  F(void, 170, pool_byte_array_destroy, (gd_pool * self))                             \
  F(void*, 245, pool_vector3_array_read, (const gd_pool* self))                       \
  F(int, 249, pool_vector3_array_size, (const gd_pool* self))                         \
  F(void, 250, pool_vector3_array_destroy, (gd_pool * self))                          \
  F(const void*, 288, pool_vector3_array_read_access_ptr, (const void* access))       \
  F(void, 290, pool_vector3_array_read_access_destroy, (void* access))                \
  F(void*, 296, pool_byte_array_write_access_ptr, (const void* access))               \
  F(void, 298, pool_byte_array_write_access_destroy, (void* access))                  \
  F(int, 507, variant_get_type, (const gd_variant* self))                             \
  F(void, 509, variant_new_nil, (gd_variant * to))                                    \
  F(void, 510, variant_new_bool, (gd_variant * to, bool from))                        \
  F(void, 512, variant_new_int, (gd_variant * to, int64_t from))                      \
  F(void, 513, variant_new_real, (gd_variant * to, double from))                      \
  F(void, 514, variant_new_string, (gd_variant * to, const gd_string* from))          \
  F(void, 517, variant_new_vector3, (gd_variant * to, const void* from))              \
  F(void, 523, variant_new_transform, (gd_variant * to, const void* from))            \
  F(void, 530, variant_new_pool_byte_array, (gd_variant * to, const gd_pool* from))   \
  F(bool, 537, variant_as_bool, (const gd_variant* self))                             \
  F(int64_t, 539, variant_as_int, (const gd_variant* self))                           \
  F(double, 540, variant_as_real, (const gd_variant* self))                           \
  F(gd_string, 541, variant_as_string, (const gd_variant* self))                      \
  F(gd_vector3, 544, variant_as_vector3, (const gd_variant* self))                    \
  F(gd_transform, 550, variant_as_transform, (const gd_variant* self))                \
  F(void*, 554, variant_as_object, (const gd_variant* self))                          \
  F(gd_pool, 562, variant_as_pool_vector3_array, (const gd_variant* self))            \
  F(const char*, 572, char_string_get_data, (const gd_char_string* self))             \
  F(void, 573, char_string_destroy, (gd_char_string * self))                          \
  F(void, 574, string_new, (gd_string * to))                                          \
  F(gd_char_string, 678, string_utf8, (const gd_string* self))                        \
  F(bool, 679, string_parse_utf8, (gd_string * self, const char* from))               \
  F(void, 721, string_destroy, (gd_string * self))                                    \
  F(void*, 732, method_bind_get_method, (const char* class_name, const char* method)) \
  F(void, 733, method_bind_ptrcall,                                                   \
    (void* method, void* self, const void** arguments, void* result))                 \
  F(void, 741, print_error, (const char* what, const char* function, const char* file, int line))

#define GD_CORE_1_1(F) F(bool, 29, is_instance_valid, (const void* object))

#define GD_NATIVESCRIPT_1_0(F)                                                                 \
  F(void, 0, register_class,                                                                   \
    (void* library, const char* name, const char* base, gd_create create, gd_destroy destroy)) \
  F(void, 2, register_method,                                                                  \
    (void* library, const char* class_name, const char* name, gd_method_attributes attributes, \
     gd_method method))

#endif
