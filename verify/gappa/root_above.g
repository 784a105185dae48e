#@ -Eprecision=128
# articulated/joint_arcs.cpp, rootAbove(): (double) sqrtf((float) square) * kRootInflation +
# kLeastRoot is not below the root of the exact square. The square passes a difference (twice, as
# it is squared), a product and three sums in double (a^6), then becomes a float (f); root (r) in
# float; product and sum in double, and the product of the turn's rate with it, 2 c (1 +
# kArcExcess c^2), five more (b^7). At most 3e38. Below the least normal float the square may be
# zero.
kRootInflation = 1 + 0x1p-23;
kLeastRoot = 1.1e-19;
a2 = (1 + a) * (1 + a); a6 = a2 * a2 * a2;
b1 = 1 + b; b7 = b1 * b1 * b1 * b1 * b1 * b1 * b1;
needed = 1 / (sqrt(a6 * (1 + f)) * (1 + r) * b7) - 1;
{ |a| <= 1b-53 /\ |b| <= 1b-53 /\ |f| <= 1b-24 /\ |r| <= 1b-24 /\ square in [0, 1b-126] ->
  needed / (kRootInflation - 1) <= 1 /\ sqrt(square / a6) / (kLeastRoot * b1 * b1) <= 1 }
