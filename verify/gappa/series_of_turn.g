#@ -Eprecision=128
# verify/motion.cpp, turned(): by Taylor the rest is below |x|^13 / 13!, |x| <= 1/8 (halved until
# then), and so is that of cosine, as |x|^14 / 14! is less. Twice kRest is taken.
kRest = 0x1p-39 / 6227020800;
x2 = x * x; x4 = x2 * x2; x12 = x4 * x4 * x4;
{ x in [0, 0.125] -> x12 * x / 6227020800 / (2 * kRest) <= 1 }
