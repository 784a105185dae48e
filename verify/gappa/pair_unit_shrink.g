#@ -Eprecision=128
# middleware/lanes/triangle_planes-inl.h, tryDirection(): as unit_shrink.g, in float; squares
# between kLeastSquare and kMostSquare, so that what three flushed squares lose (2^-126 each) is
# below v / 128 of the least.
kPairUnitShrink = 1 - 5 * 0x1p-24;
kLeastSquare = 0x1p-90;
inverse = sqrt((1 + s1) * (1 + s2) * (1 + s3) - lost) * (1 + r) / ((1 + q) * (1 + m));
{ |s1| <= 1b-24 /\ |s2| <= 1b-24 /\ |s3| <= 1b-24 /\ |r| <= 1b-24 /\ |q| <= 1b-24 /\ |m| <= 1b-24 /\ lost in [0, 1b-34] /\
  flushed in [0, 1b-126] ->
  (1 - inverse) / (1 - kPairUnitShrink) <= 1 /\ 3 * flushed / 1b-31 / kLeastSquare <= 1 }
