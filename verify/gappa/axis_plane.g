#@ -Eprecision=128
# middleware/lanes/lss_pairs-inl.h, planeAlong(), trianglesOf(), spheresOf(); lss_pairs.md 2. A
# height passes a product and two sums; the vertex its difference, too; then two differences, by v
# of |a| + |V| each and of reach. A sum of three terms, and v reach. The largest coordinate times
# the root of three; a sphere's radius rounds with the last difference.
@fl = float<ieee_32, ne>;
kAxisPlaneRounding = 12 * 0x1p-24;
kRoundingOfCoordinate = fl(1.7321 * 12 * 0x1p-24);
kSphereInflation = 1 + 0x1p-20;
kSumInflation = 1 + 0x1p-21;
p = 1 + d;
ofHeight = p * p * p * p - 1 + 2 * d * p * p * p * p;
{ |d| <= 1b-24 -> |ofHeight| / kAxisPlaneRounding <= 1 /\ sqrt(3) * 12b-24 / kRoundingOfCoordinate + 0 * d <= 1 /\
  (1 / (p * p * p) - 1) / (kSphereInflation - 1) <= 1 /\ ((1 + d) / (p * p * p) - 1 + d) / (kSumInflation - 1) <= 1 }
