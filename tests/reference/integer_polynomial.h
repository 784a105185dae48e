// tests/reference/integer_polynomial.h: polynomials of degree three or less with integer
// coefficients, their roots in [0,1] and their signs there, all exact.
#pragma once

#include <array>
#include <vector>

#include "middleware/exact/scaled_integer.h"

namespace foretouch::internal {

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3.
struct Polynomial {
  std::array<Integer, 4> c;

  [[nodiscard]] int degree() const;  ///< -1: identically zero.
  [[nodiscard]] bool isZero() const { return degree() < 0; }
};

/// The instant numerator / 2^log2.
struct Dyadic {
  Integer numerator = 0;
  int log2 = 0;
};
[[nodiscard]] int signAt(const Polynomial& p, const Dyadic& t);

/// One root. Either a simple root, the polynomial's only one in the open bracket (low, low +
/// 2^-log2); or, if `isDyadic`, `low` itself.
struct Root {
  Dyadic low;
  bool isDyadic = false;
  const Polynomial* of = nullptr;
  int signBefore = 0;  ///< Of the polynomial in the bracket, before the root.
};
inline constexpr int kRootBits = 32;  ///< A root's bracket is at most 2^-kRootBits wide.

/// The roots in [0,1] of a polynomial that is not identically zero, in order, each once. They refer
/// to the copy in this object.
class Roots {
 public:
  explicit Roots(const Polynomial& p);
  Roots(const Roots&) = delete;
  Roots& operator=(const Roots&) = delete;

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] Root& operator[](int i) { return roots_[i]; }

 private:
  bool isolate(int depth);

  Polynomial p_;
  std::array<Root, 4> roots_;
  int count_ = 0;
};

/// Sign of `p` at the root. May narrow the root's bracket.
[[nodiscard]] int signAt(const Polynomial& p, Root& root);

}  // namespace foretouch::internal
