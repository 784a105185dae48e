#@ -Eprecision=128
# middleware/edges/edge_query.cpp, seenFrom(); robot.md 3: the prop's rotation 12 u as an angle,
# its product 8 u and norm 6 u, twice: 40 u, 56 u on the arc, of points at most 2 D away; the
# difference u, its rotation 32 u and 12 u of D + P.
kPropRounding = 0x1p-43;
angle = 1.4 * (12 + 2 * (8 + 6)) * d;
{ d in [0, 1b-53] -> (2 * angle + d + 32 * d + 12 * d) / kPropRounding <= 1 }
