#@ -Eprecision=128
# lss/rounding.h. Binary64, to nearest, over a binade (all others are alike, scaled by a power of
# two): each operation is off by a factor 1 + d, |d| <= u, if it does not underflow; if it does,
# by 2^-1075 at most. All other scripts stand on these two lines: they write a rounding as a
# factor, and underflow.g counts what underflows. A fused operation is one whose product's factor
# is 1.
@rnd = float<ieee_64, ne>;
kUnitRoundoff = 0x1p-53;
{ x in [1, 2] /\ |y| in [0, 1b-1022] ->
  |rnd(x) - x| / kUnitRoundoff <= 1 /\ |rnd(y) - y| / 1b-1075 <= 1 }
