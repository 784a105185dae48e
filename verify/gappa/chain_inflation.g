#@ -Eprecision=128
# articulated/motion.cpp, sumsOf(): sums of at most kMaxChainDepth = 256 joints (skeleton.cpp
# refuses deeper ones), all terms >= 0. A term holds the eighth power of a sum of 256: 8 * 256 + 7
# roundings, ten more, and 256 for its own sum. ChainSums::bounds() adds twenty. In all below
# 2,432: (1 + d)^2432.
@rnd = float<ieee_64, ne>;
kChainInflation = rnd(1 + rnd(2e-12));
p1 = 1 + d; p2 = p1 * p1; p4 = p2 * p2; p8 = p4 * p4; p16 = p8 * p8; p32 = p16 * p16; p64 = p32 * p32;
p128 = p64 * p64; p256 = p128 * p128; p512 = p256 * p256; p1024 = p512 * p512; p2048 = p1024 * p1024;
p2432 = p2048 * p256 * p128;
# What the recurrences of the roundings leave out: products of two errors, 1e-12 of what they
# keep.
{ |d| <= 1b-53 -> (1 / p2432 - 1 + 1e-12) / (kChainInflation - 1) <= 1 }
