#@ -Eprecision=128
# middleware/lanes/lss_pairs-inl.h, EndSteps: as safe_step.g, in float; the bend's sum and two
# products under the root. next = (time + step) - kTimeRounding, both results below 2: absolute.
@fl = float<ieee_32, ne>;
kStepShrinkOfFloat = 1 - 16 * 0x1p-24;
kTimeRounding = 0x1p-22;
root = sqrt((1 + a) * (1 + b) * (1 + g)) * (1 + r) * (1 + s);
opening = root * (1 + q) * (1 + m) * (1 + c) * (1 + h);
closing = (1 + q) * (1 + m) * (1 + c) / root;
next = fl(fl(time + step) - kTimeRounding);
{ |a| <= 1b-24 /\ |b| <= 1b-24 /\ |g| <= 1b-24 /\ |h| <= 1b-24 /\ |r| <= 1b-24 /\ |s| <= 1b-24 /\ |q| <= 1b-24 /\ |m| <= 1b-24 /\
  |c| <= 1b-24 /\ time in [-1, 1] /\ step in [0, 2] /\ time + step in [-1, 1.9999] ->
  (1 - 1 / opening) / (1 - kStepShrinkOfFloat) <= 1 /\ (1 - 1 / closing) / (1 - kStepShrinkOfFloat) <= 1 /\
  |next - (time + step - kTimeRounding)| / kTimeRounding <= 1 }
