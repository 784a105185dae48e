#@ -Eprecision=128
# middleware/world/box_sweep.h, movedBounds(): bound + shift, the slack's sum; the shift is a
# difference of two places, each off by at most u of it, three at most in all. Of |bound| and of
# |shift|; the slack itself loses three (k^3).
kRoundingOfMove = 8 * 0x1p-53;
e = 1 + k;
ofBound = 2 * d * (1 + 4 * d);
ofShift = (3 + 2) * d * (1 + 4 * d);
{ d in [0, 1b-53] /\ |k| <= 1b-53 -> ofBound / (kRoundingOfMove * e * e * e) <= 1 /\ ofShift / (kRoundingOfMove * e * e * e) <= 1 }
