#@ -Eprecision=128
# middleware/lanes/triangle_pairs.cpp, rootOf(): as safe_step.g, in float. Clearance and
# acceleration are at least the two least ones (compared there), so that a flushed square or
# product is below v / 4 of the radicand.
kPairStepShrink = 1 - 8 * 0x1p-24;
kLeastClearance = 0x1p-60;
kLeastAcceleration = 0x1p-40;
root = sqrt((1 + a) * (1 + b) + lost) * (1 + r) * (1 + s);
opening = root * (1 + q) * (1 + m) * (1 + c);
closing = (1 + q) * (1 + m) * (1 + c) / root;
{ |a| <= 1b-24 /\ |b| <= 1b-24 /\ |r| <= 1b-24 /\ |s| <= 1b-24 /\ |q| <= 1b-24 /\ |m| <= 1b-24 /\ |c| <= 1b-24 /\
  |lost| <= 1b-26 /\ flushed in [0, 1b-126] ->
  (1 - 1 / opening) / (1 - kPairStepShrink) <= 1 /\ (1 - 1 / closing) / (1 - kPairStepShrink) <= 1 /\
  flushed / 1b-26 / (2 * kLeastClearance * kLeastAcceleration) <= 1 }
