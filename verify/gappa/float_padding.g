#@ -Eprecision=128
# lss/rounding.h, floatPaddedAbove(): static_cast<float>(x + |x| * kFloatPadding +
# kFloatUnderflow), all in double but the last (f); tessellation/swept_boxes.cpp, downward(), the
# same in lanes, fused or not. The padded sum is a float's normal number, or below one; |x| <=
# 3e38 (docs/guarantees.md 7).
@fl = float<ieee_32, ne>;
kFloatPadding = 0x1p-23;
kFloatUnderflow = 1e-40;
needed = 1 / ((1 + s1) * (1 + s2) * (1 + f)) - 1;
{ |m| <= 1b-53 /\ |s1| <= 1b-53 /\ |s2| <= 1b-53 /\ |f| <= 1b-24 /\ |y| in [0, 1b-126] ->
  needed / (kFloatPadding * (1 + m)) <= 1 /\ |fl(y) - y| / (kFloatUnderflow * (1 + s2)) <= 1 }
