// judge/wide.h: thirty-four digits, for cases that long double cannot decide: the compiler's 113
// bits of mantissa in a class, so that templates find its functions.
#pragma once

#if __has_include(<quadmath.h>)
#include <quadmath.h>
#else
#include <cmath>
#include <limits>
#endif

namespace foretouch::oracle {

class Wide {
 public:
  Wide() = default;
  Wide(double x) : value_(x) {}       // NOLINT: exact
  Wide(long double x) : value_(x) {}  // NOLINT: exact
  Wide(int x) : value_(x) {}          // NOLINT: exact
  explicit operator double() const { return static_cast<double>(value_); }
  explicit operator long double() const { return static_cast<long double>(value_); }

  Wide operator-() const { return of(-value_); }
  friend Wide operator+(const Wide& a, const Wide& b) { return of(a.value_ + b.value_); }
  friend Wide operator-(const Wide& a, const Wide& b) { return of(a.value_ - b.value_); }
  friend Wide operator*(const Wide& a, const Wide& b) { return of(a.value_ * b.value_); }
  friend Wide operator/(const Wide& a, const Wide& b) { return of(a.value_ / b.value_); }
  Wide& operator+=(const Wide& o) { return *this = *this + o; }
  friend bool operator==(const Wide& a, const Wide& b) { return a.value_ == b.value_; }
  friend bool operator!=(const Wide& a, const Wide& b) { return a.value_ != b.value_; }
  friend bool operator<(const Wide& a, const Wide& b) { return a.value_ < b.value_; }
  friend bool operator>(const Wide& a, const Wide& b) { return a.value_ > b.value_; }
  friend bool operator<=(const Wide& a, const Wide& b) { return a.value_ <= b.value_; }
  friend bool operator>=(const Wide& a, const Wide& b) { return a.value_ >= b.value_; }
#if __has_include(<quadmath.h>)
  friend Wide sqrt(const Wide& x) {
    return of(sqrtq(x.value_));
  }
  friend Wide abs(const Wide& x) {
    return of(fabsq(x.value_));
  }

 private:
  __extension__ using Float = __float128;
#else
  // Where GCC has no such library, long double is that format.
  static_assert(std::numeric_limits<long double>::digits == 113);
  friend Wide sqrt(const Wide& x) {
    return of(std::sqrt(x.value_));
  }
  friend Wide abs(const Wide& x) {
    return of(std::fabs(x.value_));
  }

 private:
  using Float = long double;
#endif
  static Wide of(Float value) {
    Wide wide;
    wide.value_ = value;
    return wide;
  }
  Float value_ = 0;
};

}  // namespace foretouch::oracle
