#@ -Eprecision=128
# articulated/chain_nodes.cpp, boundRoundings() and versinesByTerms(). Products of two errors: 256
# joints (refused beyond) of kQuaternion each, 4 of them as an angle, times as much again; and a
# dozen roundings. pow() is within a few units in the last place, for which 1,000 are counted,
# times its argument's forty-six terms.
@rnd = float<ieee_64, ne>;
kNodeInflation = rnd(1 + rnd(1e-9));
kRoundedDown = rnd(1 - rnd(1e-9));
eta = 256 * 4 * (96b-53 + 2b-44);
{ d in [-1024b-53, 1024b-53] ->
  (eta * 2 + eta * eta + |d|) / (kNodeInflation - 1) <= 1 /\ |d| / (1 - kRoundedDown) <= 1 }
