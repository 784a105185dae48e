#@ -Eprecision=128
# middleware/depth/pair_depth.cpp. A facet's normal: both edges' differences, a product, a
# difference: (1 + d)^4, of |d|_1 |e|_1 in all three components together. Its height: corner's
# difference, product, two sums: (1 + d)^8 of that times the extent. Sizes and extent, sums of
# magnitudes, lose a dozen (k^12). pairOf() and partingPlaneAlong(): the radii's sum, products, a
# difference; need and its sum.
kFacetRounding = 32 * 0x1p-53;
kNormalRounding = 16 * 0x1p-53;
kReachRounding = 4 * 0x1p-53;
p = 1 + d; p4 = p * p * p * p; e = 1 + k; e4 = e * e * e * e; e12 = e4 * e4 * e4;
{ |d| <= 1b-53 /\ |k| <= 1b-53 -> |p4 * p4 - 1| / (kFacetRounding * e12) <= 1 /\ |p4 - 1| / (kNormalRounding * e12) <= 1 /\
  |p * p * p - 1| / kReachRounding <= 1 }
