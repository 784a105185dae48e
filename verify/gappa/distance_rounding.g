#@ -Eprecision=128
# lss/fit.cpp, growToContain(): axisDistance() computes |w - s u|, w = p - a, u = b - a, for some
# s in [0,1] (clamped); any such s is a point of the axis, so the true distance is at most the
# exact |w - s u|. A component of w passes its difference and the last one, of s u also a product;
# then the norm. Relative to |w| + |u|, of which the code takes norms, a sum and a product (n^6,
# down). The radius is their sum (t).
kDistanceRounding = 16 * 0x1p-53;
norm = sqrt((1 + s1) * (1 + s2) * (1 + s3)) * (1 + r) * (1 + t);
ofW = (1 + a) * (1 + b) * norm - 1;
ofU = (1 + a) * (1 + b) * (1 + m) * norm - 1;
n1 = 1 + n; n2 = n1 * n1; available = kDistanceRounding * n2 * n2 * n2 * (1 + t);
{ |a| <= 1b-53 /\ |b| <= 1b-53 /\ |m| <= 1b-53 /\ |n| <= 1b-53 /\ |t| <= 1b-53 /\ |r| <= 1b-53 /\
  |s1| <= 1b-53 /\ |s2| <= 1b-53 /\ |s3| <= 1b-53 ->
  |ofW| / available <= 1 /\ |ofU| / available <= 1 }
