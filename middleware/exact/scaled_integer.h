// middleware/exact/scaled_integer.h: doubles as integers, all of them by one power of two, so that
// signs of their sums and products are exact. Not installed.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace foretouch::internal {

/// Unbounded. Below 1024 bits, nearly always, it does not allocate.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<1024>,
                                              boost::multiprecision::et_off>;

/// Above the exponent of every double.
inline constexpr int kNoExponent = 2000;

/// The e of a value m * 2^e with m odd; kNoExponent for zero.
[[nodiscard]] int exponentOf(double value);

/// value / 2^lowest, an integer. Precondition: lowest <= exponentOf(value).
[[nodiscard]] Integer scaled(double value, int lowest);

}  // namespace foretouch::internal
