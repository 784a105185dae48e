// A Result that is taken without asking stops the program and says why, in every build: these run
// in Release, where FORETOUCH_ASSERT is empty.
#include "articulated/result.h"

#include <gtest/gtest.h>

#include "articulated/skeleton.h"

namespace foretouch {
namespace {

Result<Skeleton> withParentThatIsMissing() {
  RawSkeleton raw;
  raw.joints.push_back({"hand", 3, {0, 0, 0}, Quaternion::Identity()});
  return Skeleton::build(raw);
}

TEST(ResultDeathTest, ValueOfAFailureSaysTheErrorAndStops) {
  const Result<Skeleton> result = withParentThatIsMissing();
  ASSERT_FALSE(result.ok());
  EXPECT_DEATH_IF_SUPPORTED((void)result.value(), "value\\(\\) of a Result that failed: .*hand");
}

TEST(ResultDeathTest, ValueOfATemporaryStopsToo) {
  EXPECT_DEATH_IF_SUPPORTED((void)withParentThatIsMissing().value(),
                            "value\\(\\) of a Result that failed");
}

TEST(ResultDeathTest, ErrorOfASuccessStops) {
  const Result<int> result = 3;
  EXPECT_DEATH_IF_SUPPORTED((void)result.error(), "error\\(\\) of a Result that is ok");
}

}  // namespace
}  // namespace foretouch
