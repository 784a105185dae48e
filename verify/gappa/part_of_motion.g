#@ -Eprecision=128
# articulated/chain_nodes.cpp, posesAt(), and articulated/track.md 2. A weight is off by 29 u
# (quaternion.g: 8 u of sums, 21 u of the versine) and by what its series leaves out, 2^-44; two
# weights, of vectors of four at most unit; the stored quaternions' 12 u (norm_square.g), two
# products and a sum, the norm (4.5 u) and the scale. On the part's arc the weights add up to at
# most the root of 2; twice that is the rotation.
kTurnOfPart = 4096 * 0x1p-53;
kShiftOfPart = 8 * 0x1p-53;
kInstantOfPart = 4 * 0x1p-53;
quaternion = 2 * (29b-53 + 1b-44) + 2 * 12b-53 + 3b-53 + 4.5 * 0x1p-53 + 1b-53;
turn = 2 * sqrt(2) * quaternion;
# o + t d, |d| <= 2 l: a product (2 l) and a sum (l), and t itself (2 l u): at both ends, hence in
# between.
p = 1 + d;
shift = 2 * (p * p - 1) + 2 * d * p + d;
# s is one quotient of exact differences below 2^53; the ends' instants are off by u each, both of
# the piece.
instant = 2 * d;
{ |d| <= 1b-53 -> turn / kTurnOfPart <= 1 /\ |shift| / kShiftOfPart <= 1 /\ |instant| / kInstantOfPart <= 1 }
