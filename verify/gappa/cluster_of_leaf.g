#@ -Eprecision=128
# middleware/scene/flat_bvh_build.cpp, clusterOf(): a difference, square and two sums under the
# root, the root, a sum with the vertices' rounding, the product.
kRounding = 1 + 16 * 0x1p-53;
p = 1 + d;
computed = p * sqrt(p * p * p) * p * p * p;
{ |d| <= 1b-53 -> (1 / computed - 1) / (kRounding - 1) <= 1 }
