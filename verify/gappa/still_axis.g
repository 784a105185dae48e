#@ -Eprecision=128
# middleware/pair/still_axis.cpp, stillAxis(): a coordinate to float; in double a difference and
# R^T of it, Frobenius.
kToFloat = 2 * 0x1p-24;
kTurned = 32 * 0x1p-53;
p = 1 + d;
{ |f| <= 1b-24 /\ |d| <= 1b-53 -> |f| / kToFloat <= 1 /\ |sqrt(3) * (p * p * p - 1) + p - 1| / kTurned <= 1 }
