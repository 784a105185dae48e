#@ -Eprecision=128
# middleware/scene/flat_bvh_build.cpp, vertexRoundingOf(): a difference in double, then to float;
# the extent rounds once, its product and sum twice (k^3). The norm's four are in its last factor.
# Subnormals: half of 2^-149.
kRelative = 0x1.00001p-24;
kSubnormal = 0x1p-149;
off = (1 + d) * (1 + f) - 1; e = 1 + k;
{ |d| <= 1b-53 /\ |k| <= 1b-53 /\ |f| <= 1b-24 /\ half in [0, 1b-150] ->
  |off| / (kRelative * e * e * e) <= 1 /\ half / kSubnormal <= 1 }
