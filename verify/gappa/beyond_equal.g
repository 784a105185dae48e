#@ -Eprecision=128
# middleware/near/near_reduction.cpp: the limit is (distance * distance) * kBeyondEqual, distance
# a computed root; a larger square has a larger computed root: its own root's rounding and the
# holder's (each twice), two products.
kBeyondEqual = 1 + 16 * 0x1p-53;
p = 1 + d; q = 1 + k;
{ |d| <= 1b-53 /\ |k| <= 1b-53 -> (p * p * p * p / (q * q) - 1) / (kBeyondEqual - 1) <= 1 }
