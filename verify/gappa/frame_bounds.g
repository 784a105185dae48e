#@ -Eprecision=128
# middleware/lanes/frame_lanes.cpp, bound(), placeLanes(), rateRounding(); frame_lanes.md 2 and 3:
# a product, a sum, the factor's product, |q| and five of the frame's own error; the pad has its
# sum and a second factor. A rate: 13 roundings of Horner's and four of the product with q and the
# sums (p^17). Underflow: eight operations.
kBoundInflation = 1 + 16 * 0x1p-24;
kRateRounding = 20 * 0x1p-24;
kFrameUnderflow = 0x1p-90;
p = 1 + d; p2 = p * p; p4 = p2 * p2; p16 = p4 * p4 * p4 * p4;
{ |d| <= 1b-24 /\ flushed in [0, 1b-126] -> (1 / (p4 * p4 * p) - 1) / (kBoundInflation - 1) <= 1 /\
  |p16 * p - 1| / kRateRounding <= 1 /\ 8 * flushed * 0x1p27 / kFrameUnderflow <= 1 }
