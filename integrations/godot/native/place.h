/* place.h: places of rigid bodies with one scale, in doubles, and Godot's transforms, which are
 * floats. */
#ifndef FORETOUCH_GODOT_PLACE_H
#define FORETOUCH_GODOT_PLACE_H

#include <stdbool.h>

typedef struct Place {
  double rotation[4]; /* w, x, y, z, unit */
  double position[3];
  double scale;
} Place;

/* An affine map: rows of the basis, then the origin, as Godot keeps it. */
typedef struct Affine {
  double basis[9], origin[3];
} Affine;

Affine affine_of(const float place[12]);
Affine affine_product(const Affine* outer, const Affine* inner);
/* By so much, of itself, may a scale differ along its axes, and from what it was. */
#define SCALE_SLACK 1e-3
/* False: it is not finite, mirrored, skewed, or has several scales, which `scales` then says. */
bool place_of(const Affine* from, Place* place, double scales[3]);
void place_to_floats(const Place* from, float place[12]);

/* Where what is at `local` in the frame of `parent` is; and back. Scales multiply, and divide. */
Place place_product(const Place* parent, const Place* local);
Place place_within(const Place* parent, const Place* world);

#endif
