#@ -Eprecision=128
# tessellation/point_lanes-inl.h, pointAt(): p - shift, then three fused or unfused sums of R's
# row. R x: a product and its three sums' share, Frobenius; |shift| <= reach + 2 rho
# (point_rounding.h), so |p - shift| <= 2 (reach + rho). Each sum rounds by u of |p - shift| +
# sqrt(3) rho a component: as vectors |p - shift| + 3 rho.
kArm = 16 * 0x1p-53;
kSum = 32 * 0x1p-53;
ofProduct = sqrt(3) * d;
ofReach = 2 * d + 3 * d * 2 * (1 + d);
ofRho = 2 * d + 3 * d * (2 + 3) * (1 + 4 * d);
{ d in [0, 1b-53] -> ofProduct / kArm <= 1 /\ ofReach / kSum <= 1 /\ ofRho / kSum <= 1 }
