// tests/network/stream_fixture.h: a stream of the small avatar, and short helpers to talk to it.
#pragma once

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "network/stream/avatar_stream.h"
#include "tests/network/small_stream.h"

namespace foretouch::test {

inline constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

class StreamFixture : public testing::Test {
 protected:
  StreamFixture() : stream_(AvatarStream::make(smallAvatar(), {}).value()) {}

  [[nodiscard]] Reject say(const RawSkeleton& skeleton, std::int64_t session = 1,
                           std::int32_t generation = 0) {
    return stream_.take(skeletonMessage(skeleton, session, generation));
  }
  [[nodiscard]] Reject take(const PoseMessage& message) { return stream_.take(message, step_); }
  [[nodiscard]] Reject take(std::int64_t sequence, std::int64_t utimeUs, std::int64_t session = 1) {
    return take(poseMessage(skeleton_, sequence, utimeUs, session));
  }
  [[nodiscard]] std::uint64_t counted(Reject reject) const {
    return stream_.counts().rejects[static_cast<std::size_t>(reject)];
  }
  [[nodiscard]] UndecidedReason unknown(JointId link) const {
    return (*step_.unknown)[static_cast<std::size_t>(link)];
  }
  /// Sends the skeleton, and poses up to `n`, each accepted.
  void follow(std::int64_t n) {
    ASSERT_EQ(say(skeleton_), Reject::None);
    for (std::int64_t i = 0; i <= n; ++i) ASSERT_EQ(take(nthPose(i)), Reject::None);
  }

  RawSkeleton skeleton_ = smallSkeleton();
  AvatarStream stream_;
  StreamStep step_;
};

}  // namespace foretouch::test
