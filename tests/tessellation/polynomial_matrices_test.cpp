// The matrices of curves against fifty digits, in a host that has set the processor's long double
// to 53 bits before it asks for them, as Mono does. They are made once per process: run alone, as
// ctest runs it, this test is the first to ask.
#include "tessellation/polynomial_matrices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "judge/precise.h"

namespace foretouch {
namespace {

using Fifty = oracle::Precise;

void cutLongDouble() {
#if defined(__GNUC__) && defined(__x86_64__)
  const std::uint16_t kOfMono = 0x27f;
  __asm__ __volatile__("fldcw %0" : : "m"(kOfMono));
#endif
}

std::uint16_t controlWord() {
  std::uint16_t word = 0;
#if defined(__GNUC__) && defined(__x86_64__)
  __asm__ __volatile__("fnstcw %0" : "=m"(word));
#endif
  return word;
}

Fifty lobattoNode(int k) {
  return -cos(Fifty(k) * Fifty::pi() / (kNodes - 1));
}

/// The coefficient of u^power of the polynomial that is 1 at node k and 0 at all others: the
/// elementary symmetric sum of the other nodes, over the product of what they are away.
Fifty trueCoefficient(int k, int power) {
  Fifty sum = 0, away = 1;
  for (int chosen = 0; chosen < 1 << kNodes; ++chosen) {
    if ((chosen >> k & 1) != 0) continue;
    Fifty product = 1;
    int factors = 0;
    for (int other = 0; other < kNodes; ++other) {
      if ((chosen >> other & 1) == 0) continue;
      product *= -lobattoNode(other);
      ++factors;
    }
    if (factors == kNodes - 1 - power) sum += product;
  }
  for (int other = 0; other < kNodes; ++other) {
    if (other != k) away *= lobattoNode(k) - lobattoNode(other);
  }
  return sum / away;
}

TEST(PolynomialMatrices, AreNearestDoublesWhateverTheHostSetLongDoubleTo) {
  const std::uint16_t before = controlWord();
  cutLongDouble();
  const std::uint16_t cut = controlWord();
  const internal::PolynomialMatrices& matrices = internal::polynomialMatrices();
  EXPECT_EQ(controlWord(), cut) << "the host's setting stays";
  double worst = 0.0;
  for (int k = 0; k < kNodes; ++k) {
    for (int power = 0; power < kNodes; ++power) {
      const double found = matrices.coefficients[k][power];
      const double off = std::abs(static_cast<double>(Fifty(found) - trueCoefficient(k, power)));
      // In units of the last place. Those that are zero but for roundings are of the size of one.
      const double place = std::ldexp(1.0, std::ilogb(std::max(std::abs(found), 0x1p-4)) - 52);
      worst = std::max(worst, off / place);
    }
  }
  EXPECT_LE(worst, 0.51);  // half a place, and a few roundings of 64 bits
  EXPECT_GT(worst, 0.1);
#if defined(__GNUC__) && defined(__x86_64__)
  __asm__ __volatile__("fldcw %0" : : "m"(before));
#endif
  EXPECT_EQ(controlWord(), before);
}

/// The polynomial of these control points on [-1,1] (Bernstein's form), at x.
double bezier(const double* points, int degree, double x) {
  double sum = 0.0, binomial = 1.0;
  for (int i = 0; i <= degree; ++i) {
    sum +=
        binomial * std::pow(0.5 * (1.0 + x), i) * std::pow(0.5 * (1.0 - x), degree - i) * points[i];
    binomial *= static_cast<double>(degree - i) / (i + 1);
  }
  return sum;
}

TEST(PolynomialMatrices, HaveTheControlPointsOfBothDerivatives) {
  const internal::PolynomialMatrices& matrices = internal::polynomialMatrices();
  for (int power = 0; power < kNodes; ++power) {
    EXPECT_EQ(matrices.evaluation[power], 2 * power + 2);
    for (const double x : {-1.0, -0.7, -0.1, 0.4, 1.0}) {
      const double first = power < 1 ? 0.0 : power * std::pow(x, power - 1);
      const double second = power < 2 ? 0.0 : power * (power - 1) * std::pow(x, power - 2);
      EXPECT_NEAR(bezier(matrices.first[power], 6, x), first, 1e-13) << power << " " << x;
      EXPECT_NEAR(bezier(matrices.second[power], 5, x), second, 1e-12) << power << " " << x;
    }
    for (const double unused :
         {matrices.first[power][7], matrices.second[power][6], matrices.second[power][7]}) {
      EXPECT_EQ(unused, 0.0);
    }
  }
}

}  // namespace
}  // namespace foretouch
