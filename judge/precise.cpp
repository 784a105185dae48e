// judge/precise.cpp: the only source that includes Boost's floating point.
#include "judge/precise.h"

#include <new>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace foretouch::oracle {
namespace {

namespace mp = boost::multiprecision;

template <unsigned kBits>
using Number = mp::number<mp::cpp_bin_float<kBits, mp::digit_base_2>, mp::et_off>;

}  // namespace

/// Numbers of fixed size need no destruction, so copying suffices.
template <unsigned kBits>
struct Digits<kBits>::Access {
  using N = Number<kBits>;
  static_assert(std::is_trivially_destructible_v<N>);

  static const N& of(const Digits& digits) {
    return *std::launder(reinterpret_cast<const N*>(digits.storage_.data()));
  }
  static N& of(Digits& digits) {
    return *std::launder(reinterpret_cast<N*>(digits.storage_.data()));
  }
  static void put(Digits& digits, const N& number) {
    static_assert(sizeof(N) <= sizeof(digits.storage_) && alignof(N) <= 16);
    new (digits.storage_.data()) N(number);
  }
  static Digits made(const N& number) {
    Digits digits;
    of(digits) = number;
    return digits;
  }
};

template <unsigned kBits>
Digits<kBits>::Digits(long double x, int) {
  Access::put(*this, Number<kBits>(x));
}
template <unsigned kBits>
Digits<kBits>::Digits(const std::string& decimal) {
  Access::put(*this, Number<kBits>(decimal));
}
template <unsigned kBits>
Digits<kBits>::Digits(const Digits& other) {
  Access::put(*this, Access::of(other));
}
template <unsigned kBits>
Digits<kBits>& Digits<kBits>::operator=(const Digits& other) {
  Access::of(*this) = Access::of(other);
  return *this;
}
template <unsigned kBits>
Digits<kBits>::operator double() const {
  return Access::of(*this).template convert_to<double>();
}
template <unsigned kBits>
Digits<kBits>::operator long double() const {
  return Access::of(*this).template convert_to<long double>();
}
template <unsigned kBits>
std::string Digits<kBits>::text() const {
  return Access::of(*this).str();
}
template <unsigned kBits>
Digits<kBits>& Digits<kBits>::operator+=(const Digits& other) {
  Access::of(*this) += Access::of(other);
  return *this;
}
template <unsigned kBits>
Digits<kBits>& Digits<kBits>::operator-=(const Digits& other) {
  Access::of(*this) -= Access::of(other);
  return *this;
}
template <unsigned kBits>
Digits<kBits>& Digits<kBits>::operator*=(const Digits& other) {
  Access::of(*this) *= Access::of(other);
  return *this;
}
template <unsigned kBits>
Digits<kBits>& Digits<kBits>::operator/=(const Digits& other) {
  Access::of(*this) /= Access::of(other);
  return *this;
}
template <unsigned kBits>
int Digits<kBits>::compare(const Digits& other) const {
  return Access::of(*this).compare(Access::of(other));
}
template <unsigned kBits>
Digits<kBits> Digits<kBits>::squareRoot() const {
  return Access::made(sqrt(Access::of(*this)));
}
template <unsigned kBits>
Digits<kBits> Digits<kBits>::sine() const {
  return Access::made(sin(Access::of(*this)));
}
template <unsigned kBits>
Digits<kBits> Digits<kBits>::cosine() const {
  return Access::made(cos(Access::of(*this)));
}
template <unsigned kBits>
Digits<kBits> Digits<kBits>::angleOver(const Digits& x) const {
  return Access::made(atan2(Access::of(*this), Access::of(x)));
}

template <unsigned kBits>
Digits<kBits> Digits<kBits>::pi() {
  return Access::made(boost::math::constants::pi<Number<kBits>>());
}
template <unsigned kBits>
VeryPrecise Digits<kBits>::widened() const {
  return VeryPrecise::Access::made(Number<334>(Access::of(*this)));
}

template class Digits<168>;
template class Digits<334>;

template Exact::Digits(long double, int);
template Exact::Digits(const Exact&);
template Exact& Exact::operator=(const Exact&);
template Exact& Exact::operator+=(const Exact&);
template Exact& Exact::operator-=(const Exact&);
template Exact& Exact::operator*=(const Exact&);
template Exact& Exact::operator/=(const Exact&);
template int Exact::compare(const Exact&) const;

}  // namespace foretouch::oracle
