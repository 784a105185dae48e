// middleware/lanes/pair_boxes.h: which pairs of LSS have swept boxes that meet. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// Which pairs are asked: for LSS i and block k of LSS, bit j says that i and 16 k + j are.
struct AskedPairs {
  std::int32_t blocks = 0;          ///< Blocks of SweptBoxes::kPadding LSS each.
  std::vector<std::uint16_t> bits;  ///< Row after row, `blocks` per LSS; only j > i.
  std::size_t numPairs = 0;         ///< Bits that are set.

  [[nodiscard]] bool has(std::int32_t i, std::int32_t j) const {
    constexpr std::int32_t kBlock = SweptBoxes::kPadding;
    return (bits[countOf(i * blocks + j / kBlock)] >> (j % kBlock) & 1U) != 0;
  }
};

struct LssIndexPair {
  std::int32_t i, j;
};

struct MeetingPairs {
  std::vector<LssIndexPair> pairs;  ///< Longer than `count`.
  std::size_t count = 0;
};

/// The box of one LSS.
struct LssBox {
  std::int32_t lss;
  float lower[3], upper[3];
};
/// Boxes of LSS as rows: per axis, with empty boxes up to a multiple of SweptBoxes::kPadding.
struct BoxRows {
  const float* lower[3];
  const float* upper[3];
  std::int32_t count;
};

/// Those of the asked pairs whose boxes meet, by i, then by j. O(LSS^2) divided by 16.
void collectMeeting(const SweptBoxes& boxes, const AskedPairs& asked, MeetingPairs& meeting);
/// All pairs of one of the boxes and one of the others that meet, in that order. O(boxes others)
/// divided by 16.
void collectMeeting(const std::vector<LssBox>& boxes, const BoxRows& others, MeetingPairs& meeting);

}  // namespace foretouch::internal
