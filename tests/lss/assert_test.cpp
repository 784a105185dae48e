#include "lss/assert.h"

#include <gtest/gtest.h>

namespace foretouch {
namespace {

TEST(Assert, SaysWhatIsBrokenAndWhereBeforeItStops) {
  EXPECT_DEATH_IF_SUPPORTED(internal::assertionFailed("a < b", "there.cpp", 7),
                            "there.cpp:7: broken invariant: a < b");
}

}  // namespace
}  // namespace foretouch
