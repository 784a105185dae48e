#@ -Eprecision=128
# lss/separation.cpp, tryDirection() and gapAlong(), and middleware/pair/moving_pair.cpp on top of
# them. Relative to the sum of the points' 1-norms, `extent`, which the code computes with at most
# nine roundings (e^9); the slack's product with it and the sum with kUnderflow are two more.
# Errors are linear in the coordinates (docs/rounding.md, sums): those of one side's point and of
# the other's. A coordinate passes its difference from the origin, a product and two sums (p^4).
# Then, each by u of what it leaves, at most the extents: height less top (1), less the slack (1),
# top less height (2, of the other side alone), the sum of gap and spare (1), and less roundings,
# radii, floor (3).
kSeparationRounding = 16 * 0x1p-53;
p = 1 + d; path = p * p * p * p - 1;
e = 1 + k; e2 = e * e; e4 = e2 * e2; e8 = e4 * e4; available = kSeparationRounding * e8 * e2 * e;
once = o * (1 + path);
ofOne = path + 6 * once;
ofOther = path + 8 * once;
# The pair: a point of an edge, a + s u with u = b - a, passes the difference, a product and a sum
# (three, of both ends), of a face one product and sum more, and its weights may add up to 1 + u;
# the difference of two such points one, its norm a square's three under the root, and the root's.
q = 1 + f; weights = 1 + w;
norm = sqrt((1 + s1) * (1 + s2) * (1 + s3)) * (1 + r);
ofPair = q * q * q * q * q * q * weights * norm - 1;
{ |d| <= 1b-53 /\ |k| <= 1b-53 /\ |o| <= 1b-53 /\ |f| <= 1b-53 /\ |w| <= 1b-53 /\ |r| <= 1b-53 /\
  |s1| <= 1b-53 /\ |s2| <= 1b-53 /\ |s3| <= 1b-53 ->
  |ofOne| / available <= 1 /\ |ofOther| / available <= 1 /\ |ofPair| / available <= 1 }
