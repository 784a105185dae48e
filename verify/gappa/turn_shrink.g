#@ -Eprecision=128
# middleware/lanes/node_planes.cpp, turnIntoFrame(); node_planes.md 2: a direction no longer than
# 1 times a matrix rounded to float, fused or not: a coefficient's rounding (Frobenius), a product
# and two sums, the factor's product (p^5).
kTurnShrink = 1 - 32 * 0x1p-24;
p = 1 + d;
longer = 1 + sqrt(3) * (p * p * p * p * p - 1);
{ |d| <= 1b-24 -> (1 - 1 / longer) / (1 - kTurnShrink) <= 1 }
