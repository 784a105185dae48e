#@ -Eprecision=128
# lss/rounding.h. Binary32, as in unit_roundoff.g.
@fl = float<ieee_32, ne>;
kUnitRoundoffOfFloat = 0x1p-24;
{ x in [1, 2] /\ |y| in [0, 1b-126] ->
  |fl(x) - x| / kUnitRoundoffOfFloat <= 1 /\ |fl(y) - y| / 1b-150 <= 1 }
