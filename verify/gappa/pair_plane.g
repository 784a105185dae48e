#@ -Eprecision=128
# middleware/lanes/triangle_planes-inl.h and triangle_pairs.cpp, slackOf(), answer();
# triangle_pairs.md 2 and 3. A height passes the vertex's difference, a product and two sums
# (p^4), then the difference of both and of the slack, by v of X + Y each. The extent, two roots
# of squares and their sum, and the products lose seven (e^7). Velocities have no difference
# before; two of them, where both move, a relative speed's. The pad's product, its sum (of 2^-80:
# no rounding above 2^-55) and the slack's, and v of it in the last difference. A norm whose
# square vanishes is below 2^-62.
kPairPlaneRounding = 6.5 * 0x1p-24;
kSpeedRounding = 4.5 * 0x1p-24;
kRelativeSpeedRounding = 5.5 * 0x1p-24;
kPadInflation = 1 + 4 * 0x1p-24;
kPairUnderflow = 0x1p-80;
p = 1 + d; p3 = p * p * p; p4 = p3 * p;
e = 1 + k; e7 = e * e * e * e * e * e * e;
{ |d| <= 1b-24 /\ |k| <= 1b-24 /\ |o| <= 1b-24 /\ small in [0, 1b-62] ->
  |p4 - 1 + o * p4 + o * p4 * p| / (kPairPlaneRounding * e7) <= 1 /\
  |p3 - 1 + o * p3| / (kSpeedRounding * e7) <= 1 /\ |p3 - 1 + o * p3 + o * p3 * p| / (kRelativeSpeedRounding * e7) <= 1 /\
  ((1 + o) / (p * p) - 1) / (kPadInflation - 1) <= 1 /\ 6.5 * 1b-24 * small / kPairUnderflow <= 1 }
