#@ -Eprecision=128
# middleware/surface/blend_table.cpp. merge(): two products, a sum, a quotient and the weights'
# sum per merged share, eight of them (p^5 each; more are counted in proportion, `crowd_`, by the
# vertex that has most) and a hull's norms. Sums of weights over a cluster's 64 triangles, 192 vertices.
kMergeRounding = 64 * 0x1p-53;
kWeightRounding = 256 * 0x1p-53;
p = 1 + d; p2 = p * p; p4 = p2 * p2; p8 = p4 * p4; p16 = p8 * p8; p32 = p16 * p16; p64 = p32 * p32; p128 = p64 * p64;
{ |d| <= 1b-53 -> |p32 * p8 * p4 - 1| / (kMergeRounding * (1 - 8b-53)) <= 1 /\ |p128 * p64 * p2 - 1| / (kWeightRounding * (1 - 1b-51)) <= 1 }
