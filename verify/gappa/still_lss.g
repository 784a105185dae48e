#@ -Eprecision=128
# middleware/lanes/near_triangles.cpp, stillLss(): an end's coordinates become floats: v of each;
# sums of them in double.
kRounding = 2 * 0x1p-24;
{ |f| <= 1b-24 /\ |k| <= 8b-53 -> |f| / (kRounding * (1 + k)) <= 1 }
