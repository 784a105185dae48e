#@ -Eprecision=128
# middleware/lanes/lss_pairs-inl.h, direction(): as unit_shrink.g, in float. Squares below kTiny
# only make it shorter.
kUnitShrinkOfFloat = 1 - 8 * 0x1p-24;
inverse = sqrt((1 + s1) * (1 + s2) * (1 + s3)) * (1 + r) / ((1 + q) * (1 + m));
{ |s1| <= 1b-24 /\ |s2| <= 1b-24 /\ |s3| <= 1b-24 /\ |r| <= 1b-24 /\ |q| <= 1b-24 /\ |m| <= 1b-24 ->
  (1 - inverse) / (1 - kUnitShrinkOfFloat) <= 1 }
