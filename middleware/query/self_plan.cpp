#include "middleware/query/self_plan.h"

#include <algorithm>
#include <tuple>

namespace foretouch::internal {
namespace {

bool isAboveOrSame(const Skeleton& skeleton, LinkId above, LinkId link) {
  while (link != kNoParent && link != above) link = skeleton.parent(link);
  return link == above;
}

/// The nearest branching above both, or either itself; kNoParent if there is none. A pair on one
/// branch is bounded by the next branching above it.
LinkId commonFrame(const Skeleton& skeleton, const std::vector<int>& children, LinkId a, LinkId b) {
  LinkId frame = a;
  while (frame != kNoParent &&
         (children[slotOf(frame)] < 2 || !isAboveOrSame(skeleton, frame, b))) {
    frame = skeleton.parent(frame);
  }
  return frame;
}

}  // namespace

std::vector<int> childrenThatCount(const Avatar& avatar) {
  std::vector<int> children(countOf(avatar.numLinks()), 0);
  for (LinkId link = avatar.numLinks() - 1; link >= 0; --link) {
    const JointId parent = avatar.skeleton().parent(link);
    const bool counts = !avatar.lss(link).empty() || children[slotOf(link)] > 0;
    if (counts && parent != kNoParent) ++children[slotOf(parent)];
  }
  return children;
}

SelfPlan::SelfPlan(const Avatar& avatar, const LssTable& table, const PairRules& rules)
    : numLinks_(countOf(avatar.numLinks())) {
  constexpr std::int32_t kWidth = SweptBoxes::kPadding;
  asked_.blocks = (table.size() + kWidth - 1) / kWidth;
  asked_.bits.assign(countOf(table.size()) * countOf(asked_.blocks), 0);
  frameOf_.assign(numLinks_ * numLinks_, 0);
  const std::vector<int> children = childrenThatCount(avatar);
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(a).empty() || avatar.lss(b).empty() ||
          rules.reasonOf(a, b) != PairReason::Asked) {
        continue;
      }
      ask(table, a, b);
      frameOf_[slotOf(a) * numLinks_ + slotOf(b)] =
          placeOfFrame(commonFrame(avatar.skeleton(), children, a, b));
    }
  }
  addRadii(table, rules);
}

void SelfPlan::ask(const LssTable& table, LinkId a, LinkId b) {
  constexpr std::int32_t kWidth = SweptBoxes::kPadding;
  for (std::int32_t i = table.first(a); i < table.first(a + 1); ++i) {
    std::uint16_t* const row = asked_.bits.data() + slotOf(i) * countOf(asked_.blocks);
    for (std::int32_t j = table.first(b); j < table.first(b + 1); ++j) {
      row[j / kWidth] = static_cast<std::uint16_t>(row[j / kWidth] | 1U << (j % kWidth));
      ++asked_.numPairs;
    }
  }
}

std::int32_t SelfPlan::placeOfFrame(LinkId frame) {
  const auto known = std::find(frames_.begin(), frames_.end(), frame);
  const auto place = static_cast<std::int32_t>(known - frames_.begin());
  if (known == frames_.end()) frames_.push_back(frame);
  return place;
}

void SelfPlan::addRadii(const LssTable& table, const PairRules& rules) {
  for (const PairRadius& own : rules.radii()) {
    const std::int32_t i = table.first(own.a) + own.lssA, j = table.first(own.b) + own.lssB;
    shares_.push_back({i, j, own.radius / (table[i].radius + table[j].radius)});
  }
  std::sort(shares_.begin(), shares_.end(), [](const OwnShare& x, const OwnShare& y) {
    return std::tie(x.i, x.j) < std::tie(y.i, y.j);
  });
}

double SelfPlan::radiusShare(std::int32_t i, std::int32_t j) const {
  if (shares_.empty()) return 1.0;
  const auto own = std::lower_bound(
      shares_.begin(), shares_.end(), OwnShare{i, j, 0.0},
      [](const OwnShare& x, const OwnShare& y) { return std::tie(x.i, x.j) < std::tie(y.i, y.j); });
  return own != shares_.end() && own->i == i && own->j == j ? own->share : 1.0;
}

}  // namespace foretouch::internal
