#@ -Eprecision=128
# middleware/pair/side.cpp, addInfluence(): a sum of weights times points, a product and at most
# fifteen sums for sixteen shares (p^16), of the reach and rho that each point's own rounding is
# 32 u of at least (positionRoundingAt(): twice kPointRounding, chain_product.g). More shares are
# counted in proportion. In units of a point's own rounding: once for itself, and this.
kBlendedRounding = 2;
p = 1 + d; p2 = p * p; p4 = p2 * p2;
{ |d| <= 1b-53 -> (1 + |p4 * p4 * p4 * p4 - 1| / 32b-53) / kBlendedRounding <= 1 }
