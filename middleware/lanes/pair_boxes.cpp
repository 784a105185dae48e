#include "middleware/lanes/pair_boxes.h"

#include "lss/index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/pair_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bit j: the box meets that of LSS first + j.
HWY_INLINE unsigned meetingInBlock(const float* const* lower, const float* const* upper, const LssBox& box,
                        int first) {
  const hn::CappedTag<float, SweptBoxes::kPadding> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  unsigned bits = 0;
  for (int lane = 0; lane < SweptBoxes::kPadding; lane += lanes) {
    const int at = first + lane;
    auto meets = hn::FirstN(d, static_cast<std::size_t>(lanes));
    for (int axis = 0; axis < 3; ++axis) {
      meets = hn::And(meets, hn::Le(hn::Set(d, box.lower[axis]), hn::LoadU(d, upper[axis] + at)));
      meets = hn::And(meets, hn::Ge(hn::Set(d, box.upper[axis]), hn::LoadU(d, lower[axis] + at)));
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
    const LssBox box{
        i, {lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
    for (int block = i / SweptBoxes::kPadding; block < blocks; ++block) {
      unsigned bits = asked[i * blocks + block];
      if (bits == 0) continue;
      bits &= meetingInBlock(lower, upper, box, block * SweptBoxes::kPadding);
      for (; bits != 0; bits &= bits - 1) {
        pairs[found++] = {i, block * SweptBoxes::kPadding + __builtin_ctz(bits)};
      }
    }
  }
  return found;
}

/// Room for every pair. Returns how many it wrote.
std::size_t meetingBetween(const LssBox* boxes, std::size_t count, const BoxRows* others,
                           LssIndexPair* pairs) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (int first = 0; first < others->count; first += SweptBoxes::kPadding) {
      unsigned bits = meetingInBlock(others->lower, others->upper, boxes[k], first);
      for (; bits != 0; bits &= bits - 1) {
        pairs[found++] = {boxes[k].lss, first + __builtin_ctz(bits)};
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
HWY_EXPORT(meetingBetween);

void collectMeeting(const SweptBoxes& boxes, const AskedPairs& asked, MeetingPairs& meeting) {
  if (meeting.pairs.size() < asked.numPairs) meeting.pairs.resize(asked.numPairs);
  meeting.count = HWY_DYNAMIC_DISPATCH(meetingPairs)(
      boxes.lower, boxes.upper, boxes.count, asked.bits.data(), asked.blocks, meeting.pairs.data());
}

void collectMeeting(const std::vector<LssBox>& boxes, const BoxRows& others,
                    MeetingPairs& meeting) {
  const std::size_t most = boxes.size() * countOf(others.count);
  if (meeting.pairs.size() < most) meeting.pairs.resize(most);
  meeting.count = HWY_DYNAMIC_DISPATCH(meetingBetween)(boxes.data(), boxes.size(), &others,
                                                       meeting.pairs.data());
}

}  // namespace foretouch::internal
#endif
