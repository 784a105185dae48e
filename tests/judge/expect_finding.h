// tests/judge/expect_finding.h: the tolerance that tests of the judge judge by, and how a finding
// is held against what it must be.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "judge/judge.h"

namespace foretouch::oracle {

inline constexpr double kTolerance = 1e-3;

inline void expectFinding(const Judgement& judgement, Finding expected) {
  ASSERT_EQ(toString(judgement.finding), std::string(toString(expected)))
      << judgement.what << " at t " << static_cast<double>(judgement.time) << ", separation "
      << static_cast<double>(judgement.separation);
}

}  // namespace foretouch::oracle
