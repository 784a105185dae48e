#@ -Eprecision=128
# middleware/events/swept_tube.h, mayMeet(): the centre (two sums, a product, a rounded third),
# its difference from a, s times the axis and the difference (p^7; s is clamped, any is a place of
# the axis), the norm. Radii round within kInflation; that the ball is around a centre as computed
# costs its corners' differences, within it too.
kTubeRounding = 32 * 0x1p-53;
p = 1 + d; p2 = p * p;
{ |d| <= 1b-53 -> |p2 * p2 * p2 * p * sqrt(p2 * p) * p - 1| / (kTubeRounding * (1 - 10b-53)) <= 1 }
