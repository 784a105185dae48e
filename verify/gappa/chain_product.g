#@ -Eprecision=128
# articulated/motion.cpp, composed(): R_p R, a row of three products and two sums (path),
# Frobenius norms of the root of three each; R_p times the translation at t, which itself passes a
# product and a sum, of parts at most l and 2 l; p_p + arm and w_p + R rate, one sum; v_p + w x
# arm + R rate', two, and kProduct's share of both products: the cross product's 2/sqrt(3) of two
# roundings twice (2 Omega f l).
kProduct = 16 * 0x1p-53;
kSum = 2 * 0x1p-53;
kVelocitySum = 4 * 0x1p-53;
p = 1 + d; path = p * p * p - 1;
product = 3 * |path|;
arm = sqrt(3) * |path| + 2 * |d| + 2 * |d| + |d| * |d|;
twoSums = p * p - 1;
{ |d| <= 1b-53 -> product / kProduct <= 1 /\ arm / kProduct <= 1 /\ |d| / kSum <= 1 /\ |twoSums| / kVelocitySum <= 1 }
