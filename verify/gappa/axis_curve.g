#@ -Eprecision=128
# tessellation/axis_curve.cpp, placeEnd(), endsAt(); lss_polynomials.md 5. x - x_c: u of both
# reaches, at.reach each, and rho; the turn into the frame, Frobenius, of |x - x_c| <= weighted /
# 2. Horner: coefficient j passes 2 j + 1 roundings and moves with x, which is off by 6 u, by j:
# in 2 j + 2, at most that of j = 7. The rate: j ways of 13, and 18 u.
kFrameSum = 4;
kFrameTurn = 16;
kHorner = 8 + 8;
kHornerRate = 64;
p = 1 + d; path = p * p * p - 1;
place = (2 * 7 + 1 + 6 * 7) * d / (2 * 7 + 2) * 1.000001;
rate = (13 * 7 * d / (2 * 7 + 2) + 18 * d + 4 * d / 2) * 1.000001;
{ d in [0, 1b-53] -> 2 * d / (kFrameSum * 1b-53) <= 1 /\ sqrt(3) * path / 2 / (kFrameTurn * 1b-53) <= 1 /\
  place / (kHorner * 1b-53) <= 1 /\ rate / (kHornerRate * 1b-53) <= 1 }
