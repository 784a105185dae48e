// bench/world/meeting.h: two people, one of them tracked 30 times per second and the other one
// 90 times, walk through each other: for the judge, and for a game that looks at the newest
// samples.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bench/world/judged_world.h"
#include "bench/world/people.h"

namespace foretouch::tools {

inline constexpr double kGameHz = 90.0;
inline constexpr auto kGameTickUs = static_cast<std::int64_t>(1e6 / kGameHz);

/// One of the two, with all of his samples.
struct MetWalker {
  const ClipPoses* clip = nullptr;
  std::int64_t offsetUs = 0;
  std::vector<Pose> samples;

  [[nodiscard]] const Avatar& avatar() const { return clip->actor->avatar; }
  [[nodiscard]] std::int64_t instant(std::size_t k) const {
    return offsetUs + clip->periodUs * static_cast<std::int64_t>(k);
  }
  [[nodiscard]] const Pose& newestAt(std::int64_t us) const {
    const auto k =
        static_cast<std::size_t>(std::max<std::int64_t>(us - offsetUs, 0) / clip->periodUs);
    return samples[std::min(k, samples.size() - 1)];
  }
};

class Meeting {
 public:
  Meeting(MetWalker one, MetWalker other);

  [[nodiscard]] const MetWalker& one() const { return one_; }
  [[nodiscard]] const MetWalker& other() const { return other_; }
  [[nodiscard]] const oracle::OracleWorld& judge() const { return judge_; }
  /// The pairs of a link of the one and a link of the other, row after row.
  [[nodiscard]] std::size_t pairs() const {
    return countOf(one_.avatar().numLinks()) * linksOfOther();
  }
  [[nodiscard]] std::size_t pairOf(LinkId ofOne, LinkId ofOther) const {
    return slotOf(ofOne) * linksOfOther() + slotOf(ofOther);
  }
  [[nodiscard]] oracle::OracleTouch firstTouch(std::size_t pair, std::int64_t fromUs,
                                               std::int64_t toUs) const;
  /// Metres, by the judge, at `us` after `fromUs`.
  [[nodiscard]] double gapAt(std::size_t pair, std::int64_t fromUs, double us) const;
  /// Which pairs overlap in the newest samples: a sample is there as soon as it is taken.
  void overlapsAt(std::int64_t us, std::vector<bool>& overlaps) const;

 private:
  [[nodiscard]] std::size_t linksOfOther() const { return countOf(other_.avatar().numLinks()); }
  [[nodiscard]] bool overlap(LinkId i, const LinkState& atI, LinkId j, const LinkState& atJ) const;

  MetWalker one_, other_;
  oracle::OracleWorld judge_;
};

/// The n-th of the meetings; the other's clock begins within a sample of the one's. For so long.
[[nodiscard]] Meeting meetingOf(const std::vector<ClipPoses>& slow,
                                const std::vector<ClipPoses>& quick, int n, std::int64_t untilUs);

}  // namespace foretouch::tools
