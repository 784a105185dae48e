// middleware/world/bodies_apart.h: two bodies proven apart in a span of both by what is known of
// each alone: boxes, and planes between the ends of their LSS. Proof: middleware/world/world.md 4.
// Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "middleware/contact.h"
#include "middleware/lanes/node_planes.h"
#include "middleware/lanes/pair_boxes.h"
#include "middleware/world/body_sweep.h"

namespace foretouch::internal {

enum class Apart : std::uint8_t {
  ByBoxes,   ///< No two boxes of their LSS meet.
  ByPlanes,  ///< Two do, but planes keep apart all that do.
  Unproven,
};

/// For one thread; keeps its memory.
class BodiesApart {
 public:
  /// How far the two are proven to stay apart by more than `floor` (m) beyond all radii from
  /// `fromUs` to `toUs`, which are in the spans of both. O(LSS^2) divided by 16.
  [[nodiscard]] Apart prove(const SpanSweep& one, const SpanSweep& other, std::int64_t fromUs,
                            std::int64_t toUs, double floor, QueryCounters& counters);

  /// After `Unproven`: the pairs whose boxes meet, and those of them that are open; i of the first
  /// body's LSS, j of the other's. Pieces are those of the nodes of both, or all.
  [[nodiscard]] const MeetingPairs& meeting() const { return meeting_; }
  [[nodiscard]] std::vector<PlanePair>& open() { return pairs_; }

 private:
  void collect(const SpanSweep& one, const SpanSweep& other);
  void moveRows(const SpanSweep& one, const Eigen::Vector3d& shift);
  void addPairs(const SpanSweep& one, const SpanSweep& other, double floor);
  void closeAtRest(const SpanSweep& one, const SpanSweep& other, std::int64_t fromUs,
                   std::int64_t toUs, QueryCounters& counters);
  void closeAtNodes(const SpanSweep& one, const SpanSweep& other, QueryCounters& counters);
  void dropClosed();

  std::array<std::vector<float>, 3> lower_, upper_;  // one body's, relative to the other's origin
  std::vector<LssBox> boxes_;
  MeetingPairs meeting_;
  NodePlanes planes_{};
  std::vector<PlanePair> pairs_;
};

}  // namespace foretouch::internal
