#@ -Eprecision=128
# lss/rounding.h. What is computed of terms of one sign is off by one factor 1 + d per rounding. A
# bound has at most the 4,096 of them below, its product with the factor itself included: a norm
# has four, the longest formula that is multiplied by it some sixty.
@rnd = float<ieee_64, ne>;
kInflation = rnd(1 + rnd(1e-12));
p1 = 1 + d; p2 = p1 * p1; p4 = p2 * p2; p8 = p4 * p4; p16 = p8 * p8; p32 = p16 * p16;
p64 = p32 * p32; p128 = p64 * p64; p256 = p128 * p128; p512 = p256 * p256; p1024 = p512 * p512;
p2048 = p1024 * p1024; p4096 = p2048 * p2048;
{ |d| <= 1b-53 -> (1 / p4096 - 1) / (kInflation - 1) <= 1 }
