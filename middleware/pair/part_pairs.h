// middleware/pair/part_pairs.h: pairs of parts that advance in lanes (lane_backtracking.h), and
// the order in which they do. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "lss/lss_hierarchy.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/part_lanes.h"
#include "middleware/pair/skin_lanes.h"
#include "middleware/pair/still_axis.h"

namespace foretouch::internal {

/// A part and a triangle of the scene, or two links' parts, proven apart before `freeUntil`.
struct PartPair {
  double freeUntil = 0.0;
  std::int32_t candidate = -1;  // whose LSS and triangle
  HierarchyChild part = HierarchyChild::node(0), otherPart = part;
  // The LSS itself, whatever its part says.
  bool isWhole = true, isOtherWhole = true;
  bool isEntered = false;  // for two links: both LSS were replaced by what is below them
};

/// A part of a mesh and an LSS of another link, at one instant at least so far apart (m).
struct StillPair {
  float nearest = 0.0F;
  std::int32_t candidate = -1;  // whose LSS
  HierarchyChild part = HierarchyChild::node(0);
};

/// Pairs by time, the earliest first up to 1/64 of the span. The order only decides how much work a
/// contact saves. Keeps its memory.
class TimeBuckets {
 public:
  void reset(double begin, double end);
  void push(const PartPair& pair) {
    const double place = (pair.freeUntil - begin_) * bucketsPerTime_;
    const auto bucket = static_cast<std::size_t>(std::min(std::max(place, 0.0), kBuckets - 1.0));
    const std::uint64_t bit = std::uint64_t{1} << bucket;
    const std::int32_t next = (occupied_ & bit) != 0 ? first_[bucket] : kNone;
    first_[bucket] = take({pair, next});
    occupied_ |= bit;
  }
  [[nodiscard]] bool isEmpty() const { return occupied_ == 0; }
  /// Holds a pair in an earlier bucket than every pair of `other`, whose span is the same.
  [[nodiscard]] bool isBefore(const TimeBuckets& other) const {
    const std::uint64_t mine = occupied_ & (~occupied_ + 1);
    return occupied_ != 0 && (other.occupied_ & (2 * mine - 1)) == 0;
  }
  /// Precondition: not empty.
  PartPair pop() {
    const auto bucket = static_cast<std::size_t>(__builtin_ctzll(occupied_));
    const std::int32_t index = first_[bucket];
    Entry& entry = entries_[slotOf(index)];
    if (entry.next == kNone) occupied_ &= occupied_ - 1;
    first_[bucket] = entry.next;
    entry.next = free_;
    free_ = index;
    return entry.pair;
  }

 private:
  static constexpr int kBuckets = 64;
  static constexpr std::int32_t kNone = -1;
  struct Entry {
    PartPair pair;
    std::int32_t next;
  };

  std::int32_t take(const Entry& entry) {
    if (free_ == kNone) {
      entries_.push_back(entry);
      return static_cast<std::int32_t>(entries_.size()) - 1;
    }
    const std::int32_t index = free_;
    free_ = entries_[slotOf(index)].next;
    entries_[slotOf(index)] = entry;
    return index;
  }

  double begin_ = 0.0, bucketsPerTime_ = kBuckets;
  std::uint64_t occupied_ = 0;  // bit k: the bucket holds something
  std::array<std::int32_t, kBuckets> first_{};
  std::int32_t free_ = kNone;
  std::vector<Entry> entries_;
};

/// A pair that may be in contact at the start; a point that both sides share has at least this x in
/// W (m).
struct StartPair {
  Candidate pair;
  double leastX;
};

/// Reusable memory for the descents of one thread's queries.
struct PartScratch {
  PartLanes lanes;
  GapBounds gaps{};  // of what is below a part, at one instant
  TimeBuckets lss, triangles;
  // For two links at one instant: the LSS by candidate, a stack of pairs, triangles, and what is
  // apart.
  std::vector<StillAxis> stillAxes;
  std::vector<StillPair> stillPairs, stillSurfaces, stillApart;
  std::vector<std::array<LanePart, 2>> wholeParts;  // by candidate: those of both LSS
  std::vector<HierarchyChild> parts;                // a stack
  std::vector<std::int32_t> linkTriangles;          // those the stack ended in
  SkinLanes skin;                                   // at skinned fidelity
  // A skin's pairs at the start: of clusters, triangles that may touch, parts, triangles apart.
  std::vector<StartPair> clusterPairs, startPairs;
  std::vector<Candidate> partPairs, nearPairs;
};

}  // namespace foretouch::internal
