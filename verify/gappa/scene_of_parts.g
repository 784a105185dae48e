#@ -Eprecision=128
# middleware/pair/part_lanes.cpp, setFrame(), add(), box(), put(); frame_lanes.md 4. A vertex less
# the origin, in double, then float; the norm's own (k^4). The origin is a sum of two. A bound:
# the difference with the pad, and the last one, by v of the bound each. Floor and radius: a sum,
# once more where two parts share it, and the product.
kVertexRounding = 2 * 0x1p-24;
kOriginRounding = 2 * 0x1p-53;
kSceneBoxRounding = 8 * 0x1p-24;
kFloorInflation = 1 + 4 * 0x1p-24;
e = 1 + k; p = 1 + f;
{ |f| <= 1b-24 /\ |d| <= 1b-53 /\ |k| <= 1b-53 -> |(1 + f) * (1 + d) - 1| / (kVertexRounding * e * e * e * e) <= 1 /\
  |d| / (kOriginRounding * e * e * e * e) <= 1 /\ |p * p - 1| / (kSceneBoxRounding * p) <= 1 /\ (1 / (p * p) - 1) / (kFloorInflation - 1) <= 1 }
