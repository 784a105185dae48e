#@ -Eprecision=128
# articulated/chain_nodes.cpp, storeMatrices(), storePosition(), storeRootPosition(), fused or
# not. Entries: on the diagonal 1 - (y y2 + z z2): two products of together at most 2 and two
# differences of at most 1 (4 u); off it two products of together at most 1, and their sum (2 u
# and u).
kMatrix = 16b-53;
kArm = 8b-53 + 8b-53;
kSum = 10 * 0x1p-53;
p = 1 + d; path = p * p * p - 1;
ofMatrix = sqrt(3 * (4 * d) * (4 * d) + 6 * (3 * d) * (3 * d));
# A translation at t: a product of at most 2 l, and a sum of parts of at most l; t itself half an
# ulp of 2 l.
ofArm = 2 * (p * p - 1) + d + sqrt(3) * path;
# Three sums onto the parent's place: each component at most |p_p| + l.
ofSum = 3 * d * (1 + sqrt(3));
# A root: translation less origin, t times drift, their sum: of the larger reach.
ofRoot = d + 2 * (p * p - 1) + d;
{ d in [0, 1b-53] -> ofMatrix / kMatrix <= 1 /\ ofArm / kArm <= 1 /\ ofSum / kSum <= 1 /\ ofRoot / kSum <= 1 }
