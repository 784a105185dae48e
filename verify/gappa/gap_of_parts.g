#@ -Eprecision=128
# middleware/lanes/axis_parts.cpp, distancesFrom(), boundGapsInLanes(): radii: a sum and the
# product; a pad: a product, a sum and the product; the root of a square: three under it, its own,
# the product or the sum with the slack. The last difference rounds by v of the gap, its
# correction once more; 0.4 v of the lengths in it are left over in the slack (pair_plane.g: 0.49
# v of the extents) and in kSumOfRadii (2 v of the radii).
kSumOfRadii = 1 + 4 * 0x1p-24;
kLeastSumOfRadii = 1 - 4 * 0x1p-24;
kGapRounding = 2 * 0x1p-24;
p = 1 + d;
root = sqrt(p * p * p) * p * p;
{ |d| <= 1b-24 -> (1 / root - 1) / (kSumOfRadii - 1) <= 1 /\ (1 / (p * p * p) - 1) / (kSumOfRadii - 1) <= 1 /\
  (1 - 1 / (p * p)) / (1 - kLeastSumOfRadii) <= 1 /\ (|p * p - 1| - 0.4 * 1b-24) / (kGapRounding * p) <= 1 }
