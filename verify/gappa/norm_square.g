#@ -Eprecision=128
# articulated/joint_arcs.cpp, unit(): quaternions whose computed square is within kNormSquareError
# of 1 stay, others become q * (1 / sqrt(q.q)). Either way the norm is within 12 u of 1, on which
# chain_nodes.md and motion_bounds.md stand. The computed square is the true one times four
# roundings (a^4).
kNormSquareError = 16 * 0x1p-53;
a1 = 1 + a; path = a1 * a1 * a1 * a1;
kept = sqrt((1 + share * kNormSquareError) / path);
scaled = (1 + q) * (1 + m) / (sqrt(path) * (1 + r));
{ |a| <= 1b-53 /\ |q| <= 1b-53 /\ |m| <= 1b-53 /\ |r| <= 1b-53 /\ share in [-1, 1] ->
  |kept - 1| / 12b-53 <= 1 /\ |scaled - 1| / 12b-53 <= 1 }
