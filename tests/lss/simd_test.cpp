#include "lss/simd.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

TEST(Simd, EveryWidthThatTheProcessorHasCanBeChosenAndTheWidestIsTakenByItself) {
  const std::vector<Simd> supported = supportedSimd();
  ASSERT_FALSE(supported.empty());
  EXPECT_EQ(std::adjacent_find(supported.begin(), supported.end()), supported.end());
  for (const Simd simd : supported) {
    if (simd == Simd::Other) continue;
    ASSERT_TRUE(useSimd(simd)) << toString(simd);
    EXPECT_EQ(activeSimd(), simd);
  }
  ASSERT_TRUE(useSimd(std::nullopt));
  EXPECT_EQ(activeSimd(), supported.back());
}

TEST(Simd, NamesAreReadBack) {
  for (const Simd simd : {Simd::Scalar, Simd::Ssse3, Simd::Sse4, Simd::Avx2, Simd::Avx512,
                          Simd::Neon, Simd::Simd128}) {
    EXPECT_EQ(simdFromName(toString(simd)), simd);
  }
  EXPECT_FALSE(simdFromName("mmx"));
}

}  // namespace
}  // namespace foretouch
