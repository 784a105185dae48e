// tests/support/name_of_simd.h: for tests of every vector width, each told by its name.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "lss/simd.h"

namespace foretouch::test {

inline std::string nameOfSimd(const testing::TestParamInfo<Simd>& tested) {
  return toString(tested.param);
}

}  // namespace foretouch::test
