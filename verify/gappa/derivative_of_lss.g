#@ -Eprecision=128
# middleware/lanes/lss_pairs.cpp, laneLss(); lss_pairs.md 3: coefficient j arrives by j ways of 13
# roundings, in 2 j + 2.
kDerivativeRounding = 20 / 2;
p = 1 + d; p2 = p * p; p4 = p2 * p2;
{ |d| <= 1b-24 -> |7 * (p4 * p4 * p4 * p - 1) / (2 * 7 + 2)| / (kDerivativeRounding * 1b-24) <= 1 }
