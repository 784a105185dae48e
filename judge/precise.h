// judge/precise.h: floating point of many digits, the yardstick for rounding. The arithmetic is
// Boost's, behind functions that one source defines, because its headers cost seconds of compile
// time in every source that includes them.
#pragma once

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <type_traits>

namespace foretouch::oracle {

/// Numbers with `kBits` bits of mantissa. Doubles, long doubles and integers convert exactly.
template <unsigned kBits>
class Digits {
 public:
  Digits() : Digits(0.0L) {}
  template <typename T, typename = std::enable_if_t<std::is_arithmetic_v<T>>>
  Digits(T x) : Digits(static_cast<long double>(x), 0) {}  // NOLINT: exact
  /// The nearest to a decimal number.
  explicit Digits(const std::string& decimal);
  explicit Digits(const char* decimal) : Digits(std::string(decimal)) {}
  Digits(const Digits& other);
  Digits& operator=(const Digits& other);

  /// The nearest, like every result below.
  explicit operator double() const;
  explicit operator long double() const;
  [[nodiscard]] std::string text() const;

  Digits& operator+=(const Digits& other);
  Digits& operator-=(const Digits& other);
  Digits& operator*=(const Digits& other);
  Digits& operator/=(const Digits& other);
  Digits operator-() const { return Digits() -= *this; }
  /// Negative, zero or positive, as *this is below, at or above `other`.
  [[nodiscard]] int compare(const Digits& other) const;
  [[nodiscard]] Digits squareRoot() const;
  [[nodiscard]] Digits sine() const;
  [[nodiscard]] Digits cosine() const;
  [[nodiscard]] Digits angleOver(const Digits& x) const;  ///< atan2(*this, x)
  [[nodiscard]] static Digits pi();
  /// The same number.
  [[nodiscard]] Digits<334> widened() const;

  friend Digits operator+(Digits a, const Digits& b) { return a += b; }
  friend Digits operator-(Digits a, const Digits& b) { return a -= b; }
  friend Digits operator*(Digits a, const Digits& b) { return a *= b; }
  friend Digits operator/(Digits a, const Digits& b) { return a /= b; }
  friend bool operator==(const Digits& a, const Digits& b) { return a.compare(b) == 0; }
  friend bool operator!=(const Digits& a, const Digits& b) { return a.compare(b) != 0; }
  friend bool operator<(const Digits& a, const Digits& b) { return a.compare(b) < 0; }
  friend bool operator>(const Digits& a, const Digits& b) { return a.compare(b) > 0; }
  friend bool operator<=(const Digits& a, const Digits& b) { return a.compare(b) <= 0; }
  friend bool operator>=(const Digits& a, const Digits& b) { return a.compare(b) >= 0; }
  friend Digits abs(const Digits& x) { return x < Digits() ? -x : x; }
  friend Digits sqrt(const Digits& x) { return x.squareRoot(); }
  friend Digits sin(const Digits& x) { return x.sine(); }
  friend Digits cos(const Digits& x) { return x.cosine(); }
  friend Digits atan2(const Digits& y, const Digits& x) { return y.angleOver(x); }
  friend std::ostream& operator<<(std::ostream& out, const Digits& x) { return out << x.text(); }

 private:
  template <unsigned>
  friend class Digits;
  struct Access;  // to the number that `storage_` holds
  Digits(long double x, int);

  alignas(16) std::array<unsigned char, kBits / 8 + 64> storage_;
};

using Precise = Digits<168>;      ///< Fifty digits.
using VeryPrecise = Digits<334>;  ///< A hundred.
/// Sums, differences and products of two differences of doubles without any rounding: doubles are
/// multiples of 2^-1074 below 2^1024. Supports only +, -, *, / and comparisons.
using Exact = Digits<4400>;

}  // namespace foretouch::oracle
