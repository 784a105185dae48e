/* mechanics.h: what a collision does to the bodies that collide, in C99 and C++: the impulse of
 * restitution and friction at one point. Pure functions, for any thread; they go with the events of
 * events.h, which have the normal, the velocity and the points. Kilograms, metres, newton seconds,
 * in W. What is promised: docs/moving.md, "What a collision does". */
#ifndef FORETOUCH_MECHANICS_H
#define FORETOUCH_MECHANICS_H

#include <foretouch/foretouch.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a free rigid body's point answers an impulse there: velocity change per N s, row after row in
 * inverse_mass[9], symmetric. `center[3]` and `inertia[9]` (about the centre) are in the body's
 * frame, which `rotation` (w, x, y, z) and `translation` put into W; `point` is in W. Errors: a
 * mass that nothing can have, a rotation that is not unit, numbers that are not finite. */
FT_API ft_status ft_inverse_mass_at(double kg, const double* center, const double* inertia,
                                    const double* rotation, const double* translation,
                                    const double* point, double* inverse_mass);

/* A point where a and b meet, as an ft_event has it. */
typedef struct ft_collision_point {
  uint32_t size;
  int32_t reserved;       /* 0 */
  double normal[3];       /* unit, from b to a */
  double velocity[3];     /* of a's point less b's */
  double inverse_mass[9]; /* the sum of both; a body that nothing moves adds nothing */
  double restitution;     /* 0 to 1 */
  double friction;        /* Coulomb's coefficient, at least 0 */
} ft_collision_point;

typedef struct ft_collision_impulse {
  uint32_t size;
  int32_t sticks;        /* 1: they do not slide on each other afterwards */
  double on_a[3];        /* N s; b gets the opposite */
  double restitution;    /* the one applied: less where more would have made energy */
  double friction;       /* the one applied, as above */
  double effective_mass; /* kg that meet along the normal; infinite if neither can be moved */
} ft_collision_impulse;

/* No impulse if they part, or if neither can be moved. It pushes, stays in the cone of friction,
 * and never adds kinetic energy. Errors: numbers that are not finite, a restitution outside
 * [0, 1], a friction below 0. */
FT_API ft_status ft_collide(const ft_collision_point* point, ft_collision_impulse* impulse);

#ifdef __cplusplus
}
#endif

#endif /* FORETOUCH_MECHANICS_H */
