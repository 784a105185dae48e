#include "network/wire/messages.h"

#include <cstdint>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

RawSkeleton arm() {
  RawSkeleton skeleton;
  skeleton.joints.push_back({"Hips", kNoParent, {0.0, 1.0, 0.0}, Quaternion::Identity()});
  skeleton.joints.push_back({"Arm", 0, {0.2, 0.3, 0.0}, Quaternion(0.6, 0.8, 0.0, 0.0)});
  return skeleton;
}

// The hash is on the wire and in logs: it may not change, on any machine. Reckoned by Debian's
// xxhsum over the bytes that docs/formats.md says.
TEST(SkeletonHash, IsTheOneOnRecord) {
  EXPECT_EQ(skeletonHash({}), static_cast<std::int64_t>(0xef46db3751d8e999));
}

TEST(SkeletonHash, TellsEveryFieldApart) {
  std::set<std::int64_t> seen{skeletonHash(arm())};
  const auto isNew = [&](auto change) {
    RawSkeleton changed = arm();
    change(changed);
    return seen.insert(skeletonHash(changed)).second;
  };
  EXPECT_TRUE(isNew([](RawSkeleton& s) { s.joints[1].name = "Arm2"; }));
  EXPECT_TRUE(isNew([](RawSkeleton& s) { s.joints[1].parent = kNoParent; }));
  EXPECT_TRUE(isNew([](RawSkeleton& s) { s.joints[0].offset.z() = 1e-300; }));
  EXPECT_TRUE(isNew([](RawSkeleton& s) { s.joints[1].rotation.w() = -0.6; }));
  EXPECT_TRUE(isNew([](RawSkeleton& s) { s.joints.pop_back(); }));
  EXPECT_TRUE(isNew([](RawSkeleton& s) {
    s.joints[0].name = "HipsA";
    s.joints[1].name = "rm";
  }));
}

TEST(Words, OfReasonsAndRejectsDiffer) {
  std::set<std::string> words;
  for (std::size_t i = 0; i < kNumRejects; ++i) words.insert(toString(static_cast<Reject>(i)));
  EXPECT_EQ(words.size(), kNumRejects);
  words.clear();
  for (int i = 0; i < kNumUndecidedReasons; ++i)
    words.insert(toString(static_cast<UndecidedReason>(i)));
  EXPECT_EQ(words.size(), kNumUndecidedReasons);
}

}  // namespace
}  // namespace foretouch
