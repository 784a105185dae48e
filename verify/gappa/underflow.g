#@ -Eprecision=128
# lss/rounding.h. A square loses 2^-1075 at most, 2^-1022 where the processor flushes subnormals;
# a norm of three then loses the root of three of these, a plane's heights two products of three
# for each side.
@rnd = float<ieee_64, ne>;
kUnderflow = 1e-150;
lost = |rnd(x * x) - x * x|;
heights = 4 * 3 * flushed;
{ |x| in [0, 1b-511] /\ flushed in [0, 1b-1022] ->
  (sqrt(3 * flushed) + heights) / kUnderflow <= 1 /\ lost / 1b-1022 <= 1 }
