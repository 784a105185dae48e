#@ -Eprecision=128
# articulated/motion.h, LinkState::pointAt() and velocityAt(): p + R x and v + w x (R x), bounded
# by kPointRounding (reach + rho) and kPointRounding speed, beside kPointRounding rho for R x. A
# row of R passes a product and two sums (path), of norms at most the root of three (Frobenius)
# times rho; a cross product, products and a difference, at most 2/sqrt(3) of |w||x|; the last sum
# rounds once.
kPointRounding = 16 * 0x1p-53;
p = 1 + d; path = p * p * p - 1;
turned = sqrt(3) * path;
crossed = 1.1548 * (p * p - 1);
{ |d| <= 1b-53 -> (|turned| + |d|) / (kPointRounding * 2) <= 1 /\ (|crossed| + |d|) / kPointRounding <= 1 }
