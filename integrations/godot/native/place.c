#include "integrations/godot/native/place.h"

#include <math.h>

Affine affine_of(const float place[12]) {
  Affine to;
  int i;
  for (i = 0; i < 9; ++i) to.basis[i] = place[i];
  for (i = 0; i < 3; ++i) to.origin[i] = place[9 + i];
  return to;
}

static void apply(const double basis[9], const double v[3], double to[3]) {
  int row;
  for (row = 0; row < 3; ++row)
    to[row] = basis[3 * row] * v[0] + basis[3 * row + 1] * v[1] + basis[3 * row + 2] * v[2];
}

Affine affine_product(const Affine* outer, const Affine* inner) {
  Affine to;
  int i, row, column;
  for (row = 0; row < 3; ++row) {
    for (column = 0; column < 3; ++column) {
      to.basis[3 * row + column] = 0;
      for (i = 0; i < 3; ++i)
        to.basis[3 * row + column] += outer->basis[3 * row + i] * inner->basis[3 * i + column];
    }
  }
  apply(outer->basis, inner->origin, to.origin);
  for (i = 0; i < 3; ++i) to.origin[i] += outer->origin[i];
  return to;
}

static double determinant(const double m[9]) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/* A rotation matrix times `scale` to a quaternion, by its largest component: nothing cancels. */
static void quaternion_of(const double m[9], double scale, double q[4]) {
  const double trace[4] = {m[0] + m[4] + m[8], m[0] - m[4] - m[8], m[4] - m[0] - m[8],
                           m[8] - m[0] - m[4]};
  double length = 0;
  int largest = 0, i;
  for (i = 1; i < 4; ++i)
    if (trace[i] > trace[largest]) largest = i;
  {
    const double wx = m[7] - m[5], wy = m[2] - m[6], wz = m[3] - m[1];
    const double xy = m[3] + m[1], xz = m[2] + m[6], yz = m[7] + m[5];
    const double own = scale + trace[largest];
    const double rows[4][4] = {{own, wx, wy, wz}, {wx, own, xy, xz}, {wy, xy, own, yz}, {wz, xz, yz, own}};
    for (i = 0; i < 4; ++i) {
      q[i] = rows[largest][i];
      length += q[i] * q[i];
    }
  }
  length = 1 / sqrt(length);
  for (i = 0; i < 4; ++i) q[i] *= length;
}

/* Roots and quotients are most of what it costs to read a skeleton: one root and no quotient here. */
bool place_of(const Affine* from, Place* place, double scales[3]) {
  const double* m = from->basis;
  double squares[3], volume = determinant(m);
  bool is_even = true;
  int i;
  for (i = 0; i < 3; ++i) {
    squares[i] = m[i] * m[i] + m[3 + i] * m[3 + i] + m[6 + i] * m[6 + i];
    is_even = is_even && isfinite(from->origin[i]) && fabs(squares[i] - squares[0]) <= 2 * SCALE_SLACK * squares[0];
  }
  place->scale = sqrt(squares[0]);
  /* For axes at right angles the volume is the product of their lengths, and below it where they are mirrored. */
  if (!is_even || !(volume > 0) || !isfinite(place->scale) ||
      !(volume * volume > (1 - 2 * SCALE_SLACK * SCALE_SLACK) * squares[0] * squares[1] * squares[2])) {
    for (i = 0; i < 3; ++i) scales[i] = sqrt(squares[i]);
    return false;
  }
  quaternion_of(m, place->scale, place->rotation);
  for (i = 0; i < 3; ++i) place->position[i] = from->origin[i];
  return true;
}

void place_to_floats(const Place* from, float place[12]) {
  const double w = from->rotation[0], x = from->rotation[1], y = from->rotation[2], z = from->rotation[3];
  const double basis[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                           2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                           2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
  int i;
  for (i = 0; i < 9; ++i) place[i] = (float)(from->scale * basis[i]);
  for (i = 0; i < 3; ++i) place[9 + i] = (float)from->position[i];
}

/* v + 2 w (u x v) + 2 u x (u x v), for a unit q = (w, u). */
static void turned(const double q[4], const double v[3], double to[3]) {
  const double x = 2 * (q[2] * v[2] - q[3] * v[1]), y = 2 * (q[3] * v[0] - q[1] * v[2]),
               z = 2 * (q[1] * v[1] - q[2] * v[0]);
  const double a[3] = {v[0], v[1], v[2]};
  to[0] = a[0] + q[0] * x + q[2] * z - q[3] * y;
  to[1] = a[1] + q[0] * y + q[3] * x - q[1] * z;
  to[2] = a[2] + q[0] * z + q[1] * y - q[2] * x;
}

static void product(const double a[4], const double b[4], double to[4]) {
  to[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  to[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
  to[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
  to[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

Place place_product(const Place* parent, const Place* local) {
  Place to;
  double scaled[3];
  int i;
  for (i = 0; i < 3; ++i) scaled[i] = parent->scale * local->position[i];
  turned(parent->rotation, scaled, to.position);
  for (i = 0; i < 3; ++i) to.position[i] += parent->position[i];
  product(parent->rotation, local->rotation, to.rotation);
  to.scale = parent->scale * local->scale;
  return to;
}

Place place_within(const Place* parent, const Place* world) {
  const double back[4] = {parent->rotation[0], -parent->rotation[1], -parent->rotation[2], -parent->rotation[3]};
  double apart[3];
  Place to;
  int i;
  for (i = 0; i < 3; ++i) apart[i] = world->position[i] - parent->position[i];
  turned(back, apart, to.position);
  for (i = 0; i < 3; ++i) to.position[i] /= parent->scale;
  product(back, world->rotation, to.rotation);
  to.scale = world->scale / parent->scale;
  return to;
}
