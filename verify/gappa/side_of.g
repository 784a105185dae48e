#@ -Eprecision=128
# middleware/exact/side_of.cpp: a product of three differences passes three differences, two
# products and three sums; so does the sum of magnitudes, and the bound two more. Six products
# below 2^-1022, flushed, times at most 2e100.
kSideOfRounding = 16 * 0x1p-53;
kSideOfUnderflow = 1e-200;
p = 1 + d; p2 = p * p; p8 = p2 * p2 * p2 * p2; e = 1 + k; e2 = e * e; e10 = e2 * e2 * e2 * e2 * e2;
{ |d| <= 1b-53 /\ |k| <= 1b-53 /\ flushed in [0, 1b-1022] ->
  |p8 - 1| / (kSideOfRounding * e10) <= 1 /\ 6 * flushed * 2.1e100 / kSideOfUnderflow <= 1 }
