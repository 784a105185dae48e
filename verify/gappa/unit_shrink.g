#@ -Eprecision=128
# lss/separation.cpp, tryDirection(): nhat = (kUnitShrink / norm) * direction, norm the root of
# three squares. A component passes a square and two sums under the root (s1 s2 s3), the root (r),
# a quotient (q) and a product (m). The norm is above zero and finite, as tryDirection() and
# LeastNeed::offer() check; what underflows makes it shorter than kUnderflow allows for
# (underflow.g).
kUnitShrink = 1 - 0x1p-50;
inverse = sqrt((1 + s1) * (1 + s2) * (1 + s3)) * (1 + r) / ((1 + q) * (1 + m));
{ |s1| <= 1b-53 /\ |s2| <= 1b-53 /\ |s3| <= 1b-53 /\ |r| <= 1b-53 /\ |q| <= 1b-53 /\ |m| <= 1b-53 ->
  (1 - inverse) / (1 - kUnitShrink) <= 1 }
