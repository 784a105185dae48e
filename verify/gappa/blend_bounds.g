#@ -Eprecision=128
# middleware/lanes/blend_lanes.cpp, sumsOf(), boundsOf(), blendHull(). Sums in float of K shares:
# two products, their sum and up to K more, the weight's own rounding, in double six more: K + 6
# of 64 + 8 K; shown for K = 1 and the slope in K. A box: a term's seven sums, the two last
# operations, 2 v of all (p^12 of terms); the pad's three sums and its product. A product may lose
# 2^-126 times a coordinate below 2^27: 32 K + 64 of them, K at most 64 in what a float can blend.
kBoundRoundings = 64;
kShareRoundings = 8;
kBlendUnderflow = 0x1p-90;
kBlendBoxRounding = 32 * 0x1p-24;
kBlendBoxInflation = 1 + 16 * 0x1p-24;
p = 1 + d; p4 = p * p * p * p;
own = p4 * p * p - 1;
{ |d| <= 1b-24 /\ flushed in [0, 1b-126] -> |own| / (kBoundRoundings * 1b-24) <= 1 /\ |p * p - 1| / (kShareRoundings * 1b-24) <= 1 /\
  (32 * 64 + 64) * flushed * 0x1p22 / kBlendUnderflow <= 1 /\
  |p4 * p4 * p4 - 1| / (kBlendBoxRounding * p4) <= 1 /\ (1 / (p4 * p) - 1) / (kBlendBoxInflation - 1) <= 1 }
