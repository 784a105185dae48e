#include "middleware/lanes/pair_boxes.h"

#include "lss/index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/pair_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bit j: the box of LSS i meets that of LSS first + j.
unsigned meetingInBlock(const float* const* lower, const float* const* upper, int i, int first) {
  const hn::CappedTag<float, SweptBoxes::kPadding> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  unsigned bits = 0;
  for (int lane = 0; lane < SweptBoxes::kPadding; lane += lanes) {
    const int at = first + lane;
    auto meets = hn::FirstN(d, static_cast<std::size_t>(lanes));
    for (int axis = 0; axis < 3; ++axis) {
      meets = hn::And(meets, hn::Le(hn::Set(d, lower[axis][i]), hn::LoadU(d, upper[axis] + at)));
      meets = hn::And(meets, hn::Ge(hn::Set(d, upper[axis][i]), hn::LoadU(d, lower[axis] + at)));
    }
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, meets, some);
    bits |= (some[0] | static_cast<unsigned>(some[1]) << 8U) << static_cast<unsigned>(lane);
  }
  return bits;
}

/// Room for every pair of `pairs`. Returns how many it wrote.
std::size_t meetingPairs(const float* const* lower, const float* const* upper, int count,
                         const std::uint16_t* asked, int blocks, LssIndexPair* pairs) {
  std::size_t found = 0;
  for (int i = 0; i < count; ++i) {
    for (int block = i / SweptBoxes::kPadding; block < blocks; ++block) {
      unsigned bits = asked[i * blocks + block];
      if (bits == 0) continue;
      bits &= meetingInBlock(lower, upper, i, block * SweptBoxes::kPadding);
      for (; bits != 0; bits &= bits - 1) {
        pairs[found++] = {i, block * SweptBoxes::kPadding + __builtin_ctz(bits)};
      }
    }
  }
  return found;
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {

HWY_EXPORT(meetingPairs);

void collectMeeting(const SweptBoxes& boxes, const AskedPairs& asked, MeetingPairs& meeting) {
  if (meeting.pairs.size() < asked.numPairs) meeting.pairs.resize(asked.numPairs);
  meeting.count = HWY_DYNAMIC_DISPATCH(meetingPairs)(
      boxes.lower, boxes.upper, boxes.count, asked.bits.data(), asked.blocks, meeting.pairs.data());
}

}  // namespace foretouch::internal
#endif
