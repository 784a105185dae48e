#@ -Eprecision=128
# articulated/skeleton.cpp, unitQuaternion(): q / sqrt(q.q) must be found unit when it is asked
# again. q.q is a square and three sums (or two) of one sign (a^4); root, quotient; then the
# square of the result again (b^4), and the difference from 1, which is exact there.
kUnitNormSquareError = 16 * 0x1p-53;
a1 = 1 + a; first = a1 * a1 * a1 * a1;
b1 = 1 + b; again = b1 * b1 * b1 * b1;
unit = (1 + q) / (sqrt(first) * (1 + r));
{ |a| <= 1b-53 /\ |b| <= 1b-53 /\ |q| <= 1b-53 /\ |r| <= 1b-53 ->
  |unit * unit * again - 1| / kUnitNormSquareError <= 1 }
