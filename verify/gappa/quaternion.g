#@ -Eprecision=128
# articulated/chain_nodes.cpp, weights(), turned(), product(); chain_nodes.md 1 and 2. The
# weights' series has terms >= 0 that fall at least by halves from 0.1283000599
# (chain_nodes.sollya): term j passes 8 j + 1 roundings. Their weighted sum: 1 + 0.1283000599 *
# sum (8 j + 1) / 2^(j-1) = 34 times u; 1 - t and its slope pi/2.
kLeftOut = 0x1p-44;
kQuaternion = 96 * 0x1p-53 + 2 * 0x1p-44;
ofSeries = (1 + 0.1283000599 * 34) * 1b-53 + 1.571 * 0.75 * 1b-53;
# The versine: six roundings of y <= 1, and the norms' 12 u each: 2 sqrt(2) 12 u; the weight moves
# by 0.52 of it.
ofVersine = 0.52 * (6b-53 + 2 * sqrt(2) * 12b-53);
ofQuaternion = 2 * (ofSeries + ofVersine) + sqrt(2) * 12b-53 + 3 * d;
# Four products and three sums a component (p^4): by Cauchy of |a||b|, for four components twice
# that.
p = 1 + d;
ofProduct = 2 * (p * p * p * p - 1);
# termsFor() stops where the first omitted term is at most half of kLeftOut; the rest is as large
# again.
leftOut = 0.5 * kLeftOut * 2;
{ d in [0, 1b-53] ->
  (ofQuaternion + ofProduct + 2 * leftOut) / kQuaternion <= 1 /\ leftOut / kLeftOut <= 1 }
