// judge/rational_polynomial.cpp: Sturm sequences over the integers.
#include "judge/rational_polynomial.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace foretouch::oracle {
namespace {

int signOf(const Integer& i) {
  return i.sign();
}

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

/// Divides by the content, a positive number, so that coefficients stay short.
void makePrimitive(Polynomial& p) {
  trim(p);
  Integer content = 0;
  for (const Integer& c : p) content = gcd(content, c);
  if (content <= 1) return;
  for (Integer& c : p) c /= content;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<unsigned>(i));
  return d;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial p(a.size() + b.size() - 1, Integer(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
  }
  return p;
}

/// A positive multiple of the remainder of a by b.
Polynomial remainder(Polynomial a, const Polynomial& b) {
  const Integer lead = abs(b.back());
  const int sign = signOf(b.back());
  while (a.size() >= b.size()) {
    const Integer top = sign * a.back();
    const std::size_t shift = a.size() - b.size();
    for (Integer& c : a) c *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= top * b[i];
    trim(a);
  }
  makePrimitive(a);
  return a;
}

/// A non-zero multiple of the quotient; `b` divides `a`.
Polynomial quotient(Polynomial a, const Polynomial& b) {
  Polynomial q(a.size() - b.size() + 1, Integer(0));
  while (a.size() >= b.size()) {
    const Integer top = a.back();
    const std::size_t shift = a.size() - b.size();
    for (Integer& c : a) c *= b.back();
    for (Integer& c : q) c *= b.back();
    q[shift] += top;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= top * b[i];
    trim(a);
  }
  makePrimitive(q);
  return q;
}

using Sequence = std::vector<Polynomial>;

/// first, second, and then the negated remainder of the two before, down to the last non-zero one.
Sequence sturmSequence(const Polynomial& first, Polynomial second) {
  Sequence s{first};
  makePrimitive(second);
  while (!second.empty()) {
    s.push_back(std::move(second));
    second = remainder(s[s.size() - 2], s.back());
    for (Integer& c : second) c = -c;
  }
  return s;
}

template <typename SignOfMember>
int variations(const Sequence& sequence, SignOfMember sign) {
  int changes = 0, last = 0;
  for (const Polynomial& p : sequence) {
    const int now = sign(p);
    if (now != 0 && last != 0 && now != last) ++changes;
    if (now != 0) last = now;
  }
  return changes;
}

int variationsAt(const Sequence& sequence, const Dyadic& t) {
  return variations(sequence, [&](const Polynomial& p) { return signAt(p, t); });
}

/// Splits until each part holds one root. Ends are never roots: of seven places to split at, at
/// most as many are roots as the degree says, and the last is taken only if the others are.
void isolate(const Polynomial& p, const Sequence& sequence, const Dyadic& low, int atLow,
             const Dyadic& high, int atHigh, std::vector<Root>& roots) {
  if (atLow == atHigh) return;
  if (atLow - atHigh == 1) {
    roots.push_back({p, low, high});
    return;
  }
  for (const unsigned eighths : {4u, 3u, 5u, 2u, 6u, 1u, 7u}) {
    const Dyadic middle = between(low, high, eighths);
    if (signAt(p, middle) == 0) continue;
    const int atMiddle = variationsAt(sequence, middle);
    isolate(p, sequence, low, atLow, middle, atMiddle, roots);
    isolate(p, sequence, middle, atMiddle, high, atHigh, roots);
    return;
  }
}

}  // namespace

Dyadic between(const Dyadic& low, const Dyadic& high, unsigned eighths) {
  const unsigned exponent = std::max(low.exponent, high.exponent);
  const Integer a = low.numerator << (exponent - low.exponent);
  const Integer b = high.numerator << (exponent - high.exponent);
  Dyadic t{a * (8 - eighths) + b * eighths, exponent + 3};
  while (t.exponent > 0 && !bit_test(t.numerator, 0)) {
    t.numerator >>= 1;
    --t.exponent;
  }
  return t;
}

double roundedDown(const Dyadic& t) {
  if (t.numerator == 0) return 0.0;
  const auto length = static_cast<unsigned>(msb(t.numerator)) + 1;
  const unsigned drop = length > 53 ? length - 53 : 0;
  const Integer kept = t.numerator >> drop;
  return std::ldexp(kept.convert_to<double>(),
                    static_cast<int>(drop) - static_cast<int>(t.exponent));
}

double roundedUp(const Dyadic& t) {
  const double down = roundedDown(t);
  const auto length = t.numerator == 0 ? 0u : static_cast<unsigned>(msb(t.numerator)) + 1;
  const bool exact = length <= 53 || lsb(t.numerator) >= length - 53;
  return exact ? down : std::nextafter(down, 2.0);
}

// At x = t/(1-t) with t = m/2^k: the sign of sum c_i m^i (2^k - m)^(n-i).
int signAt(const Polynomial& p, const Dyadic& t) {
  if (p.empty()) return 0;
  const Integer rest = (Integer(1) << t.exponent) - t.numerator;
  if (rest == 0) return signOf(p.back());
  Integer value = p.back(), power = 1;
  for (std::size_t i = p.size() - 1; i-- > 0;) {
    power *= rest;
    value = value * t.numerator + p[i] * power;
  }
  return signOf(value);
}

Polynomial interiorPart(Polynomial p) {
  trim(p);
  const auto isNotZero = [](const Integer& c) { return c != 0; };
  p.erase(p.begin(), std::find_if(p.begin(), p.end(), isNotZero));
  if (p.size() < 2) return p;
  makePrimitive(p);
  const Sequence sequence = sturmSequence(p, derivative(p));
  return sequence.back().size() > 1 ? quotient(p, sequence.back()) : p;
}

std::vector<Root> interiorRoots(const Polynomial& p) {
  const Polynomial f = interiorPart(p);
  std::vector<Root> roots;
  if (f.size() < 2) return roots;
  const Sequence sequence = sturmSequence(f, derivative(f));
  const Dyadic zero{0, 0}, one{1, 0};
  isolate(f, sequence, zero, variationsAt(sequence, zero), one, variationsAt(sequence, one), roots);
  return roots;
}

// The Tarski query of (f, g) on an interval with one root of f is the sign of g there.
int signAt(const Polynomial& g, const Root& root) {
  if (g.empty()) return 0;
  if (root.low.numerator << root.high.exponent == root.high.numerator << root.low.exponent) {
    return signAt(g, root.low);
  }
  const Polynomial reduced = remainder(g, root.of);
  if (reduced.empty()) return 0;
  const Polynomial second = remainder(product(derivative(root.of), reduced), root.of);
  if (second.empty()) return 0;
  const Sequence sequence = sturmSequence(root.of, second);
  return variationsAt(sequence, root.low) - variationsAt(sequence, root.high);
}

void refine(Root& root, unsigned bits) {
  const int atLow = signAt(root.of, root.low);
  for (;;) {
    const unsigned exponent = std::max(root.low.exponent, root.high.exponent);
    const Integer width = (root.high.numerator << (exponent - root.high.exponent)) -
                          (root.low.numerator << (exponent - root.low.exponent));
    if (exponent >= bits && width <= (Integer(1) << (exponent - bits))) return;
    const Dyadic middle = between(root.low, root.high, 4);
    const int sign = signAt(root.of, middle);
    if (sign == 0) {
      root.low = root.high = middle;
      return;
    }
    (sign == atLow ? root.low : root.high) = middle;
  }
}

}  // namespace foretouch::oracle
