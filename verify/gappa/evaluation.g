#@ -Eprecision=128
# tessellation/lss_polynomials.cpp; lss_polynomials.md 4. Of coefficient 7 Horner's rule makes 15
# roundings and its own to float one (p^16): 16 v and, of second order, kEvaluation. Thirty
# operations may underflow by a least normal float each. frame_lanes.cpp, placeAxis(): R x + p:
# the product with z and three sums (p^4) of the root of three (a rotation to 1e-3) times rho, and
# x rounded to float; p passes three sums.
@rnd = float<ieee_64, ne>;
kEvaluation = rnd(1 + rnd(1e-5));
kPolynomialUnderflow = 1e-36;
kFloatPoint = 9;
kFloatSum = 4.1;
p = 1 + d; p2 = p * p; p4 = p2 * p2; p16 = p4 * p4 * p4 * p4;
ofPoint = 1.001 * sqrt(3) * (p4 - 1) * (1 + 1b-24) + 1.001 * d;
ofSum = p4 - 1;
{ |d| <= 1b-24 /\ flushed in [0, 1b-126] ->
  (|(p16 - 1) / 16b-24| - 1) / (kEvaluation - 1) <= 1 /\ 30 * flushed / kPolynomialUnderflow <= 1 /\
  |ofPoint| / (kFloatPoint * 1b-24) <= 1 /\ |ofSum| / (kFloatSum * 1b-24) <= 1 }
