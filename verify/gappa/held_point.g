#@ -Eprecision=128
# middleware/events/contact_hold.cpp, heldPoint() and Slack::at(). A weighted point: an edge's
# difference, a product, a sum, twice (p^5); the difference of two, the drift's product and sum
# (p^3), the norm; then four differences. A determinant: the differences (three), product,
# difference, product and two sums (p^8), of at most 2/sqrt(3) of the lengths.
kPointRounding = 32 * 0x1p-53;
kDeterminantRounding = 64 * 0x1p-53;
p = 1 + d; p2 = p * p; p4 = p2 * p2;
ofPoint = p4 * p4 * sqrt(p * p * p) * p * p4 - 1;
ofDeterminant = 1.1548 * (p4 * p4 - 1); e = 1 + k; e2 = e * e; e10 = e2 * e2 * e2 * e2 * e2;
{ |d| <= 1b-53 /\ |k| <= 1b-53 -> |ofPoint| / (kPointRounding * e10) <= 1 /\ |ofDeterminant| / (kDeterminantRounding * e10) <= 1 }
