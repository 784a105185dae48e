#include "middleware/world/box_sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/world/box_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Boxes abreast.
constexpr std::size_t kAbreast = 16;

/// Appends every pair of places in the order whose boxes meet. `rows`: lower x, lower y, upper y,
/// lower z, upper z; `boxes` in that order, too.
void sweepRows(const float* const* rows, const BodyBox* boxes, const std::int32_t* order,
               std::size_t count, std::vector<MeetingBodies>& meeting) {
  const hn::CappedTag<float, kAbreast> d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; ++i) {
    const BodyBox& box = boxes[order[i]];
    const auto end = hn::Set(d, box.upper[0]);
    for (std::size_t j = i + 1; j < count; j += lanes) {
      // Those beyond the last have no box: their x begins past every end.
      auto meets = hn::Le(hn::LoadU(d, rows[0] + j), end);
      if (hn::AllFalse(d, meets)) break;
      for (int axis = 1; axis < 3; ++axis) {
        meets = hn::And(meets,
                        hn::Le(hn::LoadU(d, rows[2 * axis - 1] + j), hn::Set(d, box.upper[axis])));
        meets =
            hn::And(meets, hn::Ge(hn::LoadU(d, rows[2 * axis] + j), hn::Set(d, box.lower[axis])));
      }
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, meets, bytes);
      unsigned bits = bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
      for (; bits != 0; bits &= bits - 1) {
        const std::int32_t one = order[i];
        const std::int32_t other = order[j + static_cast<std::size_t>(__builtin_ctz(bits))];
        meeting.push_back({std::min(one, other), std::max(one, other)});
      }
    }
  }
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {

HWY_EXPORT(sweepRows);

namespace {

/// Read by the last vector of a sweep.
constexpr std::size_t kRoomBeyond = 16;

}  // namespace

void BodyBox::add(const BodyBox& other) {
  for (int k = 0; k < 3; ++k) {
    lower[k] = std::min(lower[k], other.lower[k]);
    upper[k] = std::max(upper[k], other.upper[k]);
  }
}

BodyBox BodyBox::movedBy(const Eigen::Vector3d& shift) const {
  BodyBox moved;
  for (int k = 0; k < 3; ++k) {
    const MovedBounds bounds = movedBounds(lower[k], upper[k], shift[k]);
    moved.lower[k] = bounds.lower;
    moved.upper[k] = bounds.upper;
  }
  return moved;
}

/// Sorts by the begin along x, then by number; empty boxes come last.
void BoxSweep::sort(const std::vector<BodyBox>& boxes) {
  if (order_.size() != boxes.size()) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](std::int32_t x, std::int32_t y) {
      return std::make_tuple(boxes[slotOf(x)].lower[0], x) <
             std::make_tuple(boxes[slotOf(y)].lower[0], y);
    });
  }
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const std::int32_t moved = order_[i];
    const float begin = boxes[slotOf(moved)].lower[0];
    std::size_t k = i;
    for (; k > 0; --k) {
      const std::int32_t before = order_[k - 1];
      const float beginBefore = boxes[slotOf(before)].lower[0];
      if (beginBefore < begin || (beginBefore == begin && before < moved)) break;
      order_[k] = before;
    }
    order_[k] = moved;
  }
}

void BoxSweep::arrange(const std::vector<BodyBox>& boxes) {
  count_ = boxes.size();
  while (count_ > 0 && boxes[slotOf(order_[count_ - 1])].isEmpty()) --count_;
  for (std::vector<float>& row : rows_) row.resize(boxes.size() + kRoomBeyond);
  for (std::size_t i = 0; i < count_ + kRoomBeyond; ++i) {
    const BodyBox box = i < count_ ? boxes[slotOf(order_[i])] : BodyBox();
    rows_[0][i] = box.lower[0];
    for (std::size_t axis = 1; axis < 3; ++axis) {
      rows_[2 * axis - 1][i] = box.lower[axis];
      rows_[2 * axis][i] = box.upper[axis];
    }
  }
}

/// Sorts by a, then by b: in one pass, as the pairs are spread over all bodies.
void BoxSweep::sortMeeting(std::size_t numBodies, std::vector<MeetingBodies>& meeting) {
  ends_.assign(numBodies, 0);
  for (const MeetingBodies& pair : meeting) ++ends_[slotOf(pair.a)];
  std::int32_t sum = 0;
  for (std::int32_t& end : ends_) sum += std::exchange(end, sum);  // where each begins
  sorted_.resize(meeting.size());
  for (const MeetingBodies& pair : meeting) sorted_[slotOf(ends_[slotOf(pair.a)]++)] = pair;
  auto first = sorted_.begin();
  for (const std::int32_t end : ends_) {
    const auto last = sorted_.begin() + end;
    std::sort(first, last,
              [](const MeetingBodies& x, const MeetingBodies& y) { return x.b < y.b; });
    first = last;
  }
  meeting.swap(sorted_);
}

void BoxSweep::collect(const std::vector<BodyBox>& boxes, std::vector<MeetingBodies>& meeting) {
  meeting.clear();
  sort(boxes);
  arrange(boxes);
  const float* rows[5];
  for (std::size_t k = 0; k < 5; ++k) rows[k] = rows_[k].data();
  HWY_DYNAMIC_DISPATCH(sweepRows)(rows, boxes.data(), order_.data(), count_, meeting);
  sortMeeting(boxes.size(), meeting);
}

}  // namespace foretouch::internal
#endif
