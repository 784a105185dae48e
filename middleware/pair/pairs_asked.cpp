#include "middleware/pair/pairs_asked.h"

#include <algorithm>
#include <tuple>

#include "lss/assert.h"

namespace foretouch::internal {
namespace {

bool isAboveOrSame(const Skeleton& skeleton, LinkId above, LinkId link) {
  while (link != kNoParent && link != above) link = skeleton.parent(link);
  return link == above;
}

/// Per link: has it LSS?
std::vector<std::uint8_t> linksWithLss(const Avatar& avatar) {
  std::vector<std::uint8_t> have;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    have.push_back(avatar.lss(link).empty() ? 0 : 1);
  }
  return have;
}

std::vector<int> childrenThatCount(const Skeleton& skeleton,
                                   const std::vector<std::uint8_t>& haveLss) {
  std::vector<int> children(haveLss.size(), 0);
  for (LinkId link = skeleton.numJoints() - 1; link >= 0; --link) {
    const JointId parent = skeleton.parent(link);
    const bool counts = haveLss[slotOf(link)] != 0 || children[slotOf(link)] > 0;
    if (counts && parent != kNoParent) ++children[slotOf(parent)];
  }
  return children;
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
  return childrenThatCount(avatar.skeleton(), linksWithLss(avatar));
}

std::vector<foretouch::LinkPair> askedLinks(const Avatar& avatar, const PairRules& rules) {
  std::vector<foretouch::LinkPair> asked;
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      const bool haveLss = !avatar.lss(a).empty() && !avatar.lss(b).empty();
      if (haveLss && rules.reasonOf(a, b) == PairReason::Asked) asked.push_back({a, b});
    }
  }
  return asked;
}

PairsAsked::PairsAsked(const Avatar& avatar, const LssTable& table, const PairRules& rules) {
  makeRoom(table, table);
  const std::vector<int> children = childrenThatCount(avatar);
  for (const auto& [a, b] : askedLinks(avatar, rules)) {
    ask(table, table, a, b);
    placeInFrame(commonFrame(avatar.skeleton(), children, a, b), a, b);
  }
  addRadii(table, rules);
}

PairsAsked::PairsAsked(const LssTable& one, const LssTable& other) {
  makeRoom(one, other);
  frameOf_.clear();
  frames_ = {kNoParent};
  for (LinkId a = 0; a < one.numLinks(); ++a) {
    for (LinkId b = 0; b < other.numLinks(); ++b) ask(one, other, a, b);
  }
}

PairsAsked::PairsAsked(const Avatar& one, const LssTable& tableOfOne, const Avatar& other,
                       const LssTable& tableOfOther, const std::vector<LinksOfSides>& leftOut) {
  FORETOUCH_ASSERT(one.numLinks() == other.numLinks());
  makeRoom(tableOfOne, tableOfOther);
  std::vector<std::uint8_t> have = linksWithLss(one);
  const std::vector<std::uint8_t> more = linksWithLss(other);
  for (std::size_t i = 0; i < have.size(); ++i) have[i] |= more[i];
  const std::vector<int> children = childrenThatCount(one.skeleton(), have);
  for (LinkId a = 0; a < one.numLinks(); ++a) {
    for (LinkId b = 0; b < other.numLinks(); ++b) {
      const bool isLeftOut = std::any_of(
          leftOut.begin(), leftOut.end(),
          [a, b](const LinksOfSides& links) { return links.one == a && links.other == b; });
      if (isLeftOut || one.lss(a).empty() || other.lss(b).empty()) continue;
      ask(tableOfOne, tableOfOther, a, b);
      placeInFrame(commonFrame(one.skeleton(), children, a, b), a, b);
    }
  }
}

void PairsAsked::makeRoom(const LssTable& one, const LssTable& other) {
  constexpr std::int32_t kWidth = SweptBoxes::kPadding;
  asked_.blocks = (other.size() + kWidth - 1) / kWidth;
  asked_.bits.assign(countOf(one.size()) * countOf(asked_.blocks), 0);
  numLinks_ = countOf(other.numLinks());
  frameOf_.assign(countOf(one.numLinks()) * numLinks_, 0);
}

void PairsAsked::ask(const LssTable& one, const LssTable& other, LinkId a, LinkId b) {
  constexpr std::int32_t kWidth = SweptBoxes::kPadding;
  for (std::int32_t i = one.first(a); i < one.first(a + 1); ++i) {
    std::uint16_t* const row = asked_.bits.data() + slotOf(i) * countOf(asked_.blocks);
    for (std::int32_t j = other.first(b); j < other.first(b + 1); ++j) {
      row[j / kWidth] = static_cast<std::uint16_t>(row[j / kWidth] | 1U << (j % kWidth));
      ++asked_.numPairs;
    }
  }
}

void PairsAsked::placeInFrame(LinkId frame, LinkId a, LinkId b) {
  const auto known = std::find(frames_.begin(), frames_.end(), frame);
  frameOf_[slotOf(a) * numLinks_ + slotOf(b)] = static_cast<std::int32_t>(known - frames_.begin());
  if (known == frames_.end()) frames_.push_back(frame);
}

void PairsAsked::addRadii(const LssTable& table, const PairRules& rules) {
  for (const PairRadius& own : rules.radii()) {
    const std::int32_t i = table.first(own.a) + own.lssA, j = table.first(own.b) + own.lssB;
    shares_.push_back({i, j, own.radius / (table[i].radius + table[j].radius)});
  }
  std::sort(shares_.begin(), shares_.end(), [](const OwnShare& x, const OwnShare& y) {
    return std::tie(x.i, x.j) < std::tie(y.i, y.j);
  });
}

double PairsAsked::radiusShare(std::int32_t i, std::int32_t j) const {
  if (shares_.empty()) return 1.0;
  const auto own = std::lower_bound(
      shares_.begin(), shares_.end(), OwnShare{i, j, 0.0},
      [](const OwnShare& x, const OwnShare& y) { return std::tie(x.i, x.j) < std::tie(y.i, y.j); });
  return own != shares_.end() && own->i == i && own->j == j ? own->share : 1.0;
}

}  // namespace foretouch::internal
