#@ -Eprecision=128
# middleware/scene/scene_audit.cpp, onLine(): two differences and a product each; the difference
# of both is compared with kRounding times their sum, two roundings and its own (k^4). Above
# 1e-280 nothing underflows that counts.
kRounding = 4 * 0x1p-53;
p = 1 + d; e = 1 + k;
{ |d| <= 1b-53 /\ |k| <= 1b-53 -> |(p * p * p - 1) / (kRounding * e * e * e * e)| <= 1 }
