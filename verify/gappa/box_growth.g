#@ -Eprecision=128
# tessellation/aabb.h, Aabb::grow(): min -= distance + kRounding (|min| + distance). Relative to
# |min| + distance: the sum rounds by u of it and a little, and so does the last difference;
# kRounding's product and sum lose two (a b).
kRounding = 4 * 0x1p-53;
needed = d * (1 + 8b-53) + d * (1 + 8b-53);
{ d in [0, 1b-53] /\ |a| <= 1b-53 /\ |b| <= 1b-53 -> needed / (kRounding * (1 + a) * (1 + b)) <= 1 }
