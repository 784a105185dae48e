#include "middleware/exact/scaled_integer.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace foretouch::internal {
namespace {

/// The integer m and the exponent e with value == m * 2^e, m odd or zero.
std::pair<std::int64_t, int> decompose(double value) {
  if (value == 0.0) return {0, 0};
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  const int zeros = __builtin_ctzll(static_cast<unsigned long long>(mantissa));
  return {mantissa >> zeros, exponent + zeros};
}

}  // namespace

int exponentOf(double value) {
  return value == 0.0 ? kNoExponent : decompose(value).second;
}

Integer scaled(double value, int lowest) {
  const auto [mantissa, exponent] = decompose(value);
  Integer result = mantissa;
  if (mantissa != 0) result <<= exponent - lowest;
  return result;
}

}  // namespace foretouch::internal
