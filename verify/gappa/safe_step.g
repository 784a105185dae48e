#@ -Eprecision=128
# lss/safe_step.h: root = sqrt(speed * speed + 2 A clearance), all terms >= 0 (asserted). The
# radicand passes a product and a sum (a b), the root one (r), the sum with |speed| one (s), then
# a quotient (q) and the product with kStepShrink (m). The clearance itself is a difference that
# rounds (c), and the step grows with it no faster than in proportion.
@rnd = float<ieee_64, ne>;
kStepShrink = rnd(1 - rnd(1e-12));
root = sqrt((1 + a) * (1 + b)) * (1 + r) * (1 + s);
opening = root * (1 + q) * (1 + m) * (1 + c);
closing = (1 + q) * (1 + m) * (1 + c) / root;
{ |a| <= 1b-53 /\ |b| <= 1b-53 /\ |r| <= 1b-53 /\ |s| <= 1b-53 /\ |q| <= 1b-53 /\ |m| <= 1b-53 /\ |c| <= 1b-53 ->
  (1 - 1 / opening) / (1 - kStepShrink) <= 1 /\ (1 - 1 / closing) / (1 - kStepShrink) <= 1 }
