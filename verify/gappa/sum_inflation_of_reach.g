#@ -Eprecision=128
# middleware/pair/open_pairs.cpp: past the rounding of a sum or two in double or float and the
# product with it (three of float), and what the kernel's sum of bend h^2/8 and reach rounds by, a
# product and a sum (node_planes.md 2): (1 + d)^5.
kSumInflationOfReach = 1 + 0x1p-21;
p = 1 + d;
{ |d| <= 1b-24 -> (1 / (p * p * p * p * p) - 1) / (kSumInflationOfReach - 1) <= 1 }
