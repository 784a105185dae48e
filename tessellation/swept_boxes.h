// tessellation/swept_boxes.h: boxes of floats around everything that LSS cover over a span of a
// motion. Between two instants a point stays within A*h^2/8 of its chord; proof with rounding:
// tessellation/lss_polynomials.md 2. Metres. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "tessellation/lss_table.h"
#include "tessellation/node_ends.h"

namespace foretouch {

/// Boxes of floats, one lane per LSS in the table's order, as structure of arrays. Lanes from
/// `count` to `capacity` are empty boxes (lower +inf, upper -inf). Keeps its memory.
struct SweptBoxes {
  static constexpr std::int32_t kPadding = 16;  ///< Capacity is a multiple of it.
  std::int32_t count = 0, capacity = 0;
  float* lower[3] = {nullptr, nullptr, nullptr};  ///< [axis][lss], each aligned to 64 bytes.
  float* upper[3] = {nullptr, nullptr, nullptr};

  SweptBoxes() = default;
  SweptBoxes(const SweptBoxes&) = delete;
  SweptBoxes& operator=(const SweptBoxes&) = delete;
  /// Makes all lanes empty boxes. Allocates only if there are more than ever before.
  void resize(std::int32_t newCount);

 private:
  struct alignas(64) Block {
    float lanes[kPadding];
  };
  friend void sweptBoxes(const LssTable&, const ChainMotion&, const ChainNodes&, double,
                         SweptBoxes&, NodeEnds*, const NodeEnds*);
  friend void sweptBoxes(const LssTable&, const ChainMotion&, const ChainNodes&,
                         const std::vector<double>&, SweptBoxes&, NodeEnds*);
  /// As resize(), but leaves the lanes as they are.
  void makeRoom(std::int32_t newCount);
  /// Lanes from `first` on.
  void emptyFrom(std::int32_t first);

  std::vector<Block> storage_;
  std::vector<double> growths_;  // one per LSS
};

/// The longest time between neighbouring nodes.
[[nodiscard]] double widestGap(const ChainNodes& nodes);

/// The float box of every LSS over the whole span of `nodes`, grown by `margin` (m), relative to
/// the origin of the nodes, rounded outward. `ends`, if not null, gets the ends that the boxes are
/// made of; they then share the origin of `beside`, if that is not null. O(LSS).
void sweptBoxes(const LssTable& table, const ChainMotion& motion, const ChainNodes& nodes,
                double margin, SweptBoxes& boxes, NodeEnds* ends = nullptr,
                const NodeEnds* beside = nullptr);
/// The same with a margin per link: `margins[link]` (m). As many as links (asserted).
void sweptBoxes(const LssTable& table, const ChainMotion& motion, const ChainNodes& nodes,
                const std::vector<double>& margins, SweptBoxes& boxes, NodeEnds* ends = nullptr);

}  // namespace foretouch
