#@ -Eprecision=128
# tessellation/ball_polytope.cpp, swept_surface.cpp: rounding to the lattice moves each coordinate
# by half a spacing. A norm of integers: conversions, squares, two sums, the root, a quotient and
# the product: (1 + d)^8.
@rnd = float<ieee_64, ne>;
kCornerRounding = 0.8661;
kOutward = rnd(1 + rnd(1e-14));
kInward = rnd(1 - rnd(1e-14));
p = 1 + d; p2 = p * p; p8 = p2 * p2 * p2 * p2;
{ |d| <= 1b-53 /\ half in [0, 0.5] -> sqrt(3 * half * half) / kCornerRounding <= 1 /\
  (1 / p8 - 1) / (kOutward - 1) <= 1 /\ (1 - 1 / p8) / (1 - kInward) <= 1 }
