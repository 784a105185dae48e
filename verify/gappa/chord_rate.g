#@ -Eprecision=128
# articulated/joint_arcs.cpp, turns(): 2 c (1 + kArcExcess c^2) is never below the angle of the
# true chord c (chord_rate.sollya). The computed chord is that of quaternions off by 10 u each
# (norm_square.g), so at most 20 u from it; a computed rate adds kJointRate. The operations
# themselves are in kRootInflation.
kChordRate = 128 * 0x1p-53;
kArcExcess = 0.0556;
# f(c) - f(b), c - b = moved: the derivative's bound between both.
moves = moved * 2 * (1 + kArcExcess * (c * c + c * b + b * b));
{ c in [0, 1.41422] /\ b in [0, 1.41422] /\ |moved| <= 21b-53 ->
  (|moves| + 64b-53) / kChordRate <= 1 }
