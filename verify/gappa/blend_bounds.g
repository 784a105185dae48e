#@ -Eprecision=128
# middleware/lanes/blend_lanes.cpp, sumsOf(), boundsOf(), blendHull(); blend_lanes.md 2 and 5. Bounds
# are sums in float of K shares: two products, their sum and up to K more, and the weight's own
# rounding: four and K, and in double one of float at most. The own part and the slope in K are
# shown apart, of 64 and of 8 K.
# A box: a term passes seven sums, and the two last operations round by 2 v of all terms, twice: 12 v
# (p^12). What then grows it, pad and radius: two sums, the last two operations, and its product.
# Underflow, for 256 shares: a weight below 2^-126 may vanish and with it 2^-126 times a coordinate
# below 2^27; three coordinates of an arm, and 32 products, lose 2^-126 each at most.
kBoundRoundings = 64;
kShareRoundings = 8;
kBlendUnderflow = 0x1p-90;
kBlendBoxRounding = 32 * 0x1p-24;
kBlendBoxInflation = 1 + 16 * 0x1p-24;
p = 1 + d; p4 = p * p * p * p;
own = p4 * p - 1;
perShare = p - 1;
lost = 256 * flushed * (0x1p27 + 3 + 32);
{ |d| <= 1b-24 /\ flushed in [0, 1b-126] ->
  |own| / (kBoundRoundings * 1b-24) <= 1 /\ |perShare| / (kShareRoundings * 1b-24) <= 1 /\
  lost / kBlendUnderflow <= 1 /\
  |p4 * p4 * p4 - 1| / (kBlendBoxRounding * p4) <= 1 /\
  (1 / (p4 * p) - 1) / (kBlendBoxInflation - 1) <= 1 }
