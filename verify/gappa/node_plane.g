#@ -Eprecision=128
# middleware/lanes/node_planes.cpp, openPieces(), restsBetween(); node_planes.md 2 and 3. R n: the
# matrix rounded, a product, two sums (p^4); an end stored in float, its product and sums (p^4);
# two differences of three heights.
kNodePlaneRounding = 16 * 0x1p-24;
p = 1 + d; p4 = p * p * p * p;
{ |d| <= 1b-24 -> |p4 * p4 - 1 + 2 * d * p4 * p4 * 2| / kNodePlaneRounding <= 1 }
