#@ -Eprecision=128
# articulated/motion.cpp, jointMotion() and composed(). sin, cos and atan2 are within one unit in
# the last place, 2 u of the result (docs/guarantees.md 1). Derived in motion_bounds.md 3;
# spectral norms.
kJointRotation = 128 * 0x1p-53;
kJointRate = 64 * 0x1p-53;
# R0: entries 8.7 u Frobenius (diagonal at most (5, 5, 1) u, the rest 4.9 u); the quaternion's
# length is off by 3 u, so R0 - 1, at most 2 long, by 6 u of itself; its direction by u, which
# turns by 2 u.
ofMatrix = 8.7 * 0x1p-53 + 2 * 6b-53 + 2b-53;
# The relative quaternion, of four: three components of three roundings, one of four, and both
# directions.
ofProduct = sqrt(3 * 9 + 16) * 1b-53 + 2b-53;
# Along the turn, relative to pi: atan2, norm, quotient, product, the norm in atan2; norm and
# product with t.
along = 3.1416 * (2 + 2.5 + 1 + 1) * 1b-53 + 2.5 * 1b-53 + 3.1416 * (2.5 + 1) * 1b-53 + 2 * ofProduct;
# Across it: the axis; and against it: the length of K, four times 2.5 u, and sine and versine.
across = 2 * ofProduct + 2b-53;
against = 4 * 2.5 * 1b-53 + 4b-53;
# S and C, products with two terms: 2 u Frobenius, C with versine 2; the sums.
ofS = 2 * sqrt(3) * sqrt(2) * 1b-53;
ofC = 4b-53 + ofS;
ofFactors = sqrt(ofS * ofS + ofC * ofC) + ofC;
ofSums = (2 * sqrt(2) + 2 * sqrt(3)) * 1b-53;
ofTurn = sqrt(along * along + across * across + against * against);
# The rate R0 phi, of phi at most pi, and of a small one, where phi errs by twice the product's
# error.
ofPhi = 3.1416 * ofProduct + 3.1416 * 6.5 * 1b-53 + 2.5 * 1b-53;
ofRate = 3.1416 * (ofMatrix + 3 * sqrt(3) * 1b-53) + ofPhi;
{ one in [1, 1] ->
  one * (ofMatrix + ofTurn + ofFactors + ofSums) / kJointRotation <= 1 /\
  one * ofRate / (kJointRate * (1 + 3.1415)) <= 1 /\ 2 * one * ofProduct / kJointRate <= 1 }
