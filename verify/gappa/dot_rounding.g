#@ -Eprecision=128
# tessellation/swept_sum.cpp, labelFacets(): of two heights, each of factors converted to double
# (two), a product and two sums, at most largestNormal * extent; their difference (2 of it). The
# extent's sums and two products lose five.
kDotRounding = 32 * 0x1p-53;
p = 1 + d; height = p * p * p * p * p - 1; e = 1 + k;
{ |d| <= 1b-53 /\ |k| <= 1b-53 -> |2 * height + 2 * d| / (kDotRounding * e * e * e * e * e) <= 1 }
