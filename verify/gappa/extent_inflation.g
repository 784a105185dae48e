#@ -Eprecision=128
# tessellation/swept_boxes.cpp, extentOf(): three differences in float, three sums, the product:
# (1 + d)^5.
kExtentInflation = 1 + 0x1p-20;
p = 1 + d;
{ |d| <= 1b-24 -> (1 / (p * p * p * p * p) - 1) / (kExtentInflation - 1) <= 1 }
