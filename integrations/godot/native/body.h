/* body.h: the class FtBody: joints with capsules, read from a skeleton's bones or from one node;
 * what it meets between two places, and the solid body that is shown instead. Made by body.c, asked
 * by steps.c, solid by solid.c. */
#ifndef FORETOUCH_GODOT_BODY_H
#define FORETOUCH_GODOT_BODY_H

#include <foretouch/solid.h>

#include "integrations/godot/native/core.h"
#include "integrations/godot/native/place.h"

/* As many as the library takes in one avatar. */
#define MOST_JOINTS 4096
#define MOST_CAPSULES 65536

typedef struct Joint {
  char* name;
  int32_t parent;
  int64_t bone; /* of the skeleton; -1: the node itself */
  double scale; /* that its capsules have */
} Joint;

typedef struct Capsule {
  int32_t joint;
  double a[3], b[3], radius;
} Capsule;

/* A pose, as the library takes it. */
typedef struct Pose {
  double *rotations, *translations;
} Pose;

typedef struct Body {
  Joint* joints;
  size_t joint_count;
  Capsule* capsules;
  size_t capsule_count;
  int64_t bone_count; /* of the skeleton that it was made from */
  bool is_of_file;    /* load(): its poses come from a clip, else from nodes */
  ft_avatar* avatar;
  ft_clip* clip;
  ft_query* query;
  ft_solid* solid;
  Place* world; /* one per joint */
  Pose from, to;
  Pose last;  /* of the last step */
  Place node; /* of the last sweep, in the frame of joint 0 */
  bool has_begun;
  bool was_swept;       /* since the last step: the query ended elsewhere */
  ft_contact* contacts; /* of the last step */
  size_t contact_count;
  ft_solid_tick tick;
  ft_solid_contact* presses; /* of the last tick */
  size_t press_count, press_room;
  uint8_t* bytes;
  size_t byte_room;
  char error[1100];
} Body;

/* Writes what went wrong; returns -1. */
int64_t fail(Body* body, const char* format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;
int64_t fail_by_library(Body* body);

/* Where the bones are in the node (`place` NULL: where it is itself), as a pose. False:
 * body->error. */
bool read_pose(Body* body, void* node, const float* place, Pose* into);
ft_pose as_pose(const Body* body, const Pose* pose);
/* Bytes of a result; NULL: no memory. */
uint8_t* bytes_of(Body* body, size_t count);

/* Functions of steps.c and solid.c, for the table of methods. */
void body_step(void* self, const Value* arguments, Value* result);
void body_step_clip(void* self, const Value* arguments, Value* result);
void body_sweep(void* self, const Value* arguments, Value* result);
void body_restart(void* self, const Value* arguments, Value* result);
void place_of_node_at(void* self, const Value* arguments, Value* result);
void contact_joint(void* self, const Value* arguments, Value* result);
void contact_object(void* self, const Value* arguments, Value* result);
void contact_verdict(void* self, const Value* arguments, Value* result);
void contact_share(void* self, const Value* arguments, Value* result);
void contact_separation(void* self, const Value* arguments, Value* result);
void contact_point(void* self, const Value* arguments, Value* result);
void contact_normal(void* self, const Value* arguments, Value* result);
void step_bytes(void* self, const Value* arguments, Value* result);

void make_solid(void* self, const Value* arguments, Value* result);
void body_follow(void* self, const Value* arguments, Value* result);
void body_follow_clip(void* self, const Value* arguments, Value* result);
void body_show(void* self, const Value* arguments, Value* result);
void body_reset(void* self, const Value* arguments, Value* result);
void tick_state(void* self, const Value* arguments, Value* result);
void tick_deviation(void* self, const Value* arguments, Value* result);
void tick_is_certified(void* self, const Value* arguments, Value* result);
void press_joint(void* self, const Value* arguments, Value* result);
void press_object(void* self, const Value* arguments, Value* result);
void press_point(void* self, const Value* arguments, Value* result);
void press_normal(void* self, const Value* arguments, Value* result);
void press_push(void* self, const Value* arguments, Value* result);
void tick_bytes(void* self, const Value* arguments, Value* result);

#endif
