// judge/rational_polynomial.h: real roots of integer polynomials, and the signs of other
// polynomials at them, by Sturm sequences: exact, without a single rounding. Source: [Basu06]
// chapter 2 (Sturm's theorem; Tarski queries for signs at roots).
//
// A form sum c_i (1-t)^(n-i) t^i is the polynomial sum c_i x^i in x = t/(1-t), whose positive roots
// are the form's roots inside (0,1); signs agree.
#pragma once

#include <vector>

#include <boost/multiprecision/gmp.hpp>

namespace foretouch::oracle {

using Integer =
    boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
/// Coefficients of x^0, x^1, ...; the last is not zero. Empty: the zero polynomial.
using Polynomial = std::vector<Integer>;

/// t = numerator / 2^exponent.
struct Dyadic {
  Integer numerator = 0;
  unsigned exponent = 0;
};
[[nodiscard]] Dyadic between(const Dyadic& low, const Dyadic& high, unsigned eighths);
/// The largest double that is not above t, or the smallest that is not below it.
[[nodiscard]] double roundedDown(const Dyadic& t);
[[nodiscard]] double roundedUp(const Dyadic& t);

/// The sign at x = t/(1-t) for t inside (0,1).
[[nodiscard]] int signAt(const Polynomial& p, const Dyadic& t);

/// A polynomial with the same roots in x other than zero, each of them simple.
[[nodiscard]] Polynomial interiorPart(Polynomial p);

/// A root of `of` inside (0,1), the only one in (low, high); neither end is a root.
struct Root {
  Polynomial of;  ///< Square-free.
  Dyadic low, high;
};
/// All roots inside (0,1) of a non-zero polynomial, in increasing order.
[[nodiscard]] std::vector<Root> interiorRoots(const Polynomial& p);

/// The sign of g at the root.
[[nodiscard]] int signAt(const Polynomial& g, const Root& root);

/// Halves the bracket until high - low <= 2^-bits, or low = high is the root itself.
void refine(Root& root, unsigned bits);

}  // namespace foretouch::oracle
