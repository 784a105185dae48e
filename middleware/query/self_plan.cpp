#include "middleware/query/self_plan.h"

#include <algorithm>
#include <tuple>

namespace foretouch::internal {
namespace {

/// Links that are above two or more links with LSS by different children: nearest common ancestors
/// of pairs on different branches. A pair on one branch is bounded by the next of them above it.
std::vector<std::uint8_t> branchings(const Avatar& avatar) {
  const Skeleton& skeleton = avatar.skeleton();
  std::vector<std::uint8_t> counts(countOf(avatar.numLinks()), 0);
  std::vector<int> branches(countOf(avatar.numLinks()), 0);
  for (LinkId link = avatar.numLinks() - 1; link >= 0; --link) {
    counts[slotOf(link)] = counts[slotOf(link)] != 0 || !avatar.lss(link).empty() ? 1 : 0;
    const LinkId parent = skeleton.parent(link);
    if (counts[slotOf(link)] == 0 || parent == kNoParent) continue;
    counts[slotOf(parent)] = 1;
    ++branches[slotOf(parent)];
  }
  std::vector<std::uint8_t> isBranching(countOf(avatar.numLinks()), 0);
  for (std::size_t i = 0; i < isBranching.size(); ++i) isBranching[i] = branches[i] >= 2 ? 1 : 0;
  return isBranching;
}

bool isAboveOrSame(const Skeleton& skeleton, LinkId above, LinkId link) {
  while (link != kNoParent && link != above) link = skeleton.parent(link);
  return link == above;
}

/// The nearest branching above both, or either itself; kNoParent if there is none.
LinkId commonFrame(const Skeleton& skeleton, const std::vector<std::uint8_t>& isBranching, LinkId a,
                   LinkId b) {
  LinkId frame = a;
  while (frame != kNoParent &&
         (isBranching[slotOf(frame)] == 0 || !isAboveOrSame(skeleton, frame, b))) {
    frame = skeleton.parent(frame);
  }
  return frame;
}

}  // namespace

SelfPlan::SelfPlan(const Avatar& avatar, const LssTable& table, const PairRules& rules)
    : table_(table), numLinks_(countOf(avatar.numLinks())) {
  askPairs(avatar, rules);
  findFrames(avatar);
  addRadii(rules);
}

void SelfPlan::askPairs(const Avatar& avatar, const PairRules& rules) {
  constexpr std::int32_t kWidth = SweptBoxes::kPadding;
  asked_.blocks = (table_.size() + kWidth - 1) / kWidth;
  asked_.bits.assign(countOf(table_.size()) * countOf(asked_.blocks), 0);
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(a).empty() || avatar.lss(b).empty() ||
          rules.reasonOf(a, b) != PairReason::Asked) {
        continue;
      }
      for (std::int32_t i = table_.first(a); i < table_.first(a + 1); ++i) {
        std::uint16_t* const row = asked_.bits.data() + slotOf(i) * countOf(asked_.blocks);
        for (std::int32_t j = table_.first(b); j < table_.first(b + 1); ++j) {
          row[j / kWidth] = static_cast<std::uint16_t>(row[j / kWidth] | 1U << (j % kWidth));
          ++asked_.numPairs;
        }
      }
    }
  }
}

void SelfPlan::findFrames(const Avatar& avatar) {
  const Skeleton& skeleton = avatar.skeleton();
  const std::vector<std::uint8_t> isBranching = branchings(avatar);
  frameOf_.assign(numLinks_ * numLinks_, 0);
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(a).empty() || avatar.lss(b).empty()) continue;
      const LinkId link = commonFrame(skeleton, isBranching, a, b);
      auto frame = std::find_if(frames_.begin(), frames_.end(),
                                [link](const SelfFrame& f) { return f.link == link; });
      if (frame == frames_.end()) frame = frames_.insert(frame, {link, {}, {}});
      const auto place = static_cast<std::int32_t>(frame - frames_.begin());
      frameOf_[slotOf(a) * numLinks_ + slotOf(b)] = place;
      frameOf_[slotOf(b) * numLinks_ + slotOf(a)] = place;
    }
  }
  std::int32_t places = 0;
  for (SelfFrame& frame : frames_) {
    frame.placeOf.assign(numLinks_, -1);
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      if (avatar.lss(link).empty()) continue;
      if (frame.link != kNoParent && !isAboveOrSame(skeleton, frame.link, link)) continue;
      frame.placeOf[slotOf(link)] = places++;
      frame.below.push_back(link);
    }
  }
}

void SelfPlan::addRadii(const PairRules& rules) {
  for (const PairRadius& own : rules.radii()) {
    radii_.push_back({table_.first(own.a) + own.lssA, table_.first(own.b) + own.lssB, own.radius});
  }
  std::sort(radii_.begin(), radii_.end(), [](const OwnRadius& x, const OwnRadius& y) {
    return std::tie(x.i, x.j) < std::tie(y.i, y.j);
  });
}

double SelfPlan::radiusOf(std::int32_t i, std::int32_t j) const {
  const double sum = table_[i].radius + table_[j].radius;
  if (radii_.empty()) return sum;
  const auto own = std::lower_bound(radii_.begin(), radii_.end(), OwnRadius{i, j, 0.0},
                                    [](const OwnRadius& x, const OwnRadius& y) {
                                      return std::tie(x.i, x.j) < std::tie(y.i, y.j);
                                    });
  return own != radii_.end() && own->i == i && own->j == j ? own->radius : sum;
}

}  // namespace foretouch::internal
