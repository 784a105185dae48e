#@ -Eprecision=128
# tessellation/curve_lanes-inl.h, combined(): eight products of matrix entries, which are rounded
# themselves (and by a few roundings of long double, counted as one), and seven sums: (1 + d)^10.
# Over all entries they add up to 375 at most (lebesgue.sollya), |f| to weighted / 2. The control
# points' entries are at most 42, of |c_j| <= weighted / 4 for j >= 1, whose norm rounds three
# more. kInstantRounding: chain_nodes.cpp, setInstants(), absolute, in [0,1], where each rounds by
# 2^-54 (off): the length, the time as given, the product, the sum; both ends are exact.
kFitting = 4096;
kControlRounding = 1e-13;
kInstantRounding = 0x1p-52;
p = 1 + d; p2 = p * p; p10 = p2 * p2 * p2 * p2 * p2;
fit = 375 * (p10 - 1) / 2;
control = 42 * (p10 * p2 * p - 1) / 2;
instant = off * time + off + off + off;
{ |d| <= 1b-53 /\ time in [0.0495, 0.9505] /\ off in [0, 1b-54] ->
  |fit| / (kFitting * 1b-53) <= 1 /\ |control| / kControlRounding <= 1 /\
  instant / kInstantRounding <= 1 }
