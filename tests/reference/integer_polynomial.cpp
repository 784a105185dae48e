// Why each loop ends and why each answer is exact: tests/reference/linear_query.md 4.
#include "tests/reference/integer_polynomial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lss/assert.h"
#include "tests/reference/cubic.h"

namespace foretouch::internal {
namespace {

/// Halvings after which we suspect a cluster of roots to be a multiple root. Cost only.
constexpr int kClusterDepth = 8;
/// More halvings than any two roots of polynomials with the admitted coefficients need to separate
/// (linear_query.md 4): a loop that reaches it is a bug.
constexpr int kSeparationDepth = 200000;
/// Bits for which we trust a guess in doubles, and guesses before we test whether the sign is zero.
/// Cost only.
constexpr int kNarrowingBits = 40;
constexpr int kNarrowings = 2;

int signOf(const Integer& value) {
  return value.sign();
}

/// Bernstein coefficients of a cubic, up to a common positive factor.
using Coefficients = std::array<Integer, 4>;

Coefficients bernstein(const Polynomial& p) {
  const Integer three = 3 * p.c[0];
  return {three, three + p.c[1], three + 2 * p.c[1] + p.c[2],
          3 * (p.c[0] + p.c[1] + p.c[2] + p.c[3])};
}

/// Those of p on [low, low + 2^-log2].
Coefficients bernstein(const Polynomial& p, const Dyadic& low) {
  // Shift by k and scale by 2^n: p((k + s) / 2^n) * 2^3n.
  const int n = low.log2;
  const Integer& k = low.numerator;
  const Integer c0 = p.c[0] << (3 * n), c1 = p.c[1] << (2 * n), c2 = p.c[2] << n;
  const Integer& c3 = p.c[3];
  const Integer c3k = c3 * k;
  Polynomial q;
  q.c[0] = c0 + k * (c1 + k * (c2 + c3k));
  q.c[1] = c1 + k * (2 * c2 + 3 * c3k);
  q.c[2] = c2 + 3 * c3k;
  q.c[3] = c3;
  return bernstein(q);
}

std::pair<Coefficients, Coefficients> halve(const Coefficients& b) {
  const Integer a = b[0] + b[1], m = b[1] + b[2], d = b[2] + b[3];
  const Integer e = a + m, f = m + d;
  const Integer g = e + f;
  return {{b[0] << 3, a << 2, e << 1, g}, {g, f << 1, d << 2, b[3] << 3}};
}

/// Changes of sign, without zeros: no fewer than the roots in the open span, and one means one.
int variations(const Coefficients& b) {
  int changes = 0, last = 0;
  for (const Integer& value : b) {
    const int sign = signOf(value);
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

int firstSign(const Coefficients& b) {
  for (const Integer& value : b) {
    if (value != 0) return signOf(value);
  }
  return 0;
}

/// One common sign of all coefficients, none zero; else 0.
int strictSign(const Coefficients& b) {
  const int sign = signOf(b[0]);
  return signOf(b[1]) == sign && signOf(b[2]) == sign && signOf(b[3]) == sign ? sign : 0;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  d.c = {p.c[1], 2 * p.c[2], 3 * p.c[3], 0};
  return d;
}

/// Divides a power of the divisor's leading coefficient times p: quotient and remainder, each up to
/// a factor that is not zero.
std::pair<Polynomial, Polynomial> divide(Polynomial p, const Polynomial& divisor) {
  const int low = divisor.degree();
  const Integer& lead = divisor.c[low];
  Polynomial quotient;
  for (int high = p.degree(); high >= low; --high) {
    const Integer factor = p.c[high];
    for (Integer& c : quotient.c) c *= lead;
    quotient.c[high - low] += factor;
    for (int i = 0; i <= high; ++i) {
      p.c[i] *= lead;
      if (i >= high - low) p.c[i] -= factor * divisor.c[i - (high - low)];
    }
  }
  return {quotient, p};
}

Polynomial greatestCommonDivisor(Polynomial a, Polynomial b) {
  if (a.degree() < b.degree()) std::swap(a, b);
  while (!b.isZero()) {
    Polynomial remainder = divide(std::move(a), b).second;
    a = std::move(b);
    b = std::move(remainder);
  }
  return a;
}

/// The coefficients as doubles, up to a common positive factor.
Cubic inDoubles(const Coefficients& b) {
  unsigned bits = 0;
  for (const Integer& value : b) {
    if (value != 0) bits = std::max<unsigned>(bits, msb(abs(value)));
  }
  const unsigned shift = bits > 900 ? bits - 900 : 0;
  Cubic cubic{};
  for (int i = 0; i < 4; ++i) cubic[i] = static_cast<double>(Integer(b[i] >> shift));
  return cubic;
}

Dyadic nextAt(const Dyadic& t) {
  return {t.numerator + 1, t.log2};
}

/// Halves the bracket, or finds that the root is its middle.
void bisect(Root& root) {
  const Dyadic middle{2 * root.low.numerator + 1, root.low.log2 + 1};
  const int sign = signAt(*root.of, middle);
  root.isDyadic = sign == 0;
  root.low = sign == 0 || sign == root.signBefore
                 ? middle
                 : Dyadic{2 * root.low.numerator, root.low.log2 + 1};
}

/// Narrows the bracket by up to `bits` bits at once, at least by one: a guess in doubles, checked
/// by exact signs on both sides.
void narrow(Root& root, int bits) {
  const Coefficients b = bernstein(*root.of, root.low);
  if (b[0] == 0 || b[3] == 0) return bisect(root);  // another root at an end misleads the guess
  const double guess = rootOf(inDoubles(b));
  if (!(guess >= 0.0 && guess <= 1.0)) return bisect(root);
  const double cells = std::ldexp(1.0, bits);
  const double cell = std::clamp(std::floor(guess * cells), 0.0, cells - 1.0);
  const Dyadic low{(root.low.numerator << bits) + Integer(cell), root.low.log2 + bits};
  const int atLow = cell == 0.0 ? root.signBefore : signAt(*root.of, low);
  const int atHigh = cell == cells - 1.0 ? -root.signBefore : signAt(*root.of, nextAt(low));
  if (atLow == 0 || atHigh == 0) {
    root.isDyadic = true;
    root.low = atLow == 0 ? low : nextAt(low);
  } else if (atLow == root.signBefore && atHigh == -root.signBefore) {
    root.low = low;
  } else {
    bisect(root);
  }
}

}  // namespace

int Polynomial::degree() const {
  int d = 3;
  while (d >= 0 && c[d] == 0) --d;
  return d;
}

int signAt(const Polynomial& p, const Dyadic& t) {
  if (t.numerator == 0) return signOf(p.c[0]);
  Integer value = p.c[3];
  for (int i = 2; i >= 0; --i) value = value * t.numerator + (p.c[i] << (t.log2 * (3 - i)));
  return signOf(value);
}

Roots::Roots(const Polynomial& p) : p_(p) {
  FORETOUCH_ASSERT(!p.isZero());
  if (!isolate(kClusterDepth)) {
    p_ = divide(p_, greatestCommonDivisor(p_, derivative(p_))).first;  // every root simple
    const bool isolated = isolate(kSeparationDepth);
    FORETOUCH_ASSERT(isolated);
    (void)isolated;
  }
  for (int i = 0; i < count_; ++i) {
    Root& root = roots_[i];
    while (!root.isDyadic && root.low.log2 < kRootBits) narrow(root, kRootBits - root.low.log2);
  }
}

/// Halves spans until each holds one root or none; false if that needs more than `depth`.
bool Roots::isolate(int depth) {
  struct Span {
    Coefficients b;
    Dyadic low;
  };
  count_ = 0;
  std::vector<Span> stack;
  stack.push_back({bernstein(p_), Dyadic{}});
  if (stack.back().b[0] == 0) roots_[count_++] = {Dyadic{}, true, &p_, 0};
  while (!stack.empty()) {
    const Span span = std::move(stack.back());
    stack.pop_back();
    const int changes = variations(span.b);
    if (changes == 1) roots_[count_++] = {span.low, false, &p_, firstSign(span.b)};
    if (changes > 1) {
      if (span.low.log2 >= depth) return false;
      auto [left, right] = halve(span.b);
      const Dyadic middle{2 * span.low.numerator + 1, span.low.log2 + 1};
      stack.push_back({std::move(right), middle});
      stack.push_back({std::move(left), {2 * span.low.numerator, span.low.log2 + 1}});
      continue;
    }
    if (span.b[3] == 0) roots_[count_++] = {nextAt(span.low), true, &p_, 0};
  }
  return true;
}

int signAt(const Polynomial& p, Root& root) {
  if (p.isZero()) return 0;
  for (int round = 0; round < kSeparationDepth; ++round) {
    if (root.isDyadic) return signAt(p, root.low);
    const int sign = strictSign(bernstein(p, root.low));
    if (sign != 0) return sign;
    // A simple root of root.of, alone in its bracket: a divisor has it, once, or has none there;
    // variations exceed the roots by an even number.
    if (round == kNarrowings) {
      const Polynomial common = greatestCommonDivisor(*root.of, p);
      if (variations(bernstein(common, root.low)) % 2 == 1) return 0;
    }
    narrow(root, kNarrowingBits);
  }
  FORETOUCH_ASSERT(false);
  return 0;
}

}  // namespace foretouch::internal
