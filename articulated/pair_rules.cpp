#include "articulated/pair_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "articulated/robot.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "lss/separation.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

bool comesBefore(const LeftOutPair& x, const LeftOutPair& y) {
  return std::tie(x.a, x.b, x.reason) < std::tie(y.a, y.b, y.reason);
}

/// The nearest link above that has LSS; kNoParent if there is none.
LinkId boundedAbove(const Avatar& avatar, LinkId link) {
  const Skeleton& skeleton = avatar.skeleton();
  LinkId above = skeleton.parent(link);
  while (above != kNoParent && avatar.lss(above).empty()) above = skeleton.parent(above);
  return above;
}

bool isAdjacent(const Avatar& avatar, LinkId a, LinkId b) {
  return boundedAbove(avatar, b) == a || boundedAbove(avatar, a) == b;
}

std::vector<LinkState> statesIn(const Avatar& avatar, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(avatar.skeleton(), pose, pose).statesAt(0.0, states);
  return states;
}

/// All LSS of an avatar in one pose.
class PosedAvatar {
 public:
  /// Keeps references to both.
  PosedAvatar(const Avatar& avatar, const std::vector<LinkState>& states)
      : avatar_(avatar), states_(states) {}
  /// The distance of the axes (m).
  [[nodiscard]] double distance(LinkId a, std::size_t lssA, LinkId b, std::size_t lssB) const {
    return separation(axisOf(a, lssA), axisOf(b, lssB)).distance;
  }
  [[nodiscard]] bool touch(LinkId a, LinkId b) const {
    const auto &ofA = avatar_.lss(a), &ofB = avatar_.lss(b);
    for (std::size_t i = 0; i < ofA.size(); ++i) {
      for (std::size_t j = 0; j < ofB.size(); ++j) {
        if (distance(a, i, b, j) <= ofA[i].radius + ofB[j].radius) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] Hull axisOf(LinkId link, std::size_t i) const {
    const Lss& lss = avatar_.lss(link)[i];
    const LinkState& state = states_[slotOf(link)];
    return Hull::segment(state.pointAt(lss.a), state.pointAt(lss.b));
  }

  const Avatar& avatar_;
  const std::vector<LinkState>& states_;
};

/// Calls `visit` with every two different links that both have LSS, the lower one first.
template <typename Visit>
void forPairs(const Avatar& avatar, const Visit& visit) {
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    if (avatar.lss(a).empty()) continue;
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (!avatar.lss(b).empty()) visit(a, b);
    }
  }
}

/// The smaller radii that keep two links apart at rest; false if some axes are too near for that.
bool addRadii(const Avatar& avatar, const PosedAvatar& rest, LinkPair pair, double skin,
              std::vector<PairRadius>& radii) {
  const auto &ofA = avatar.lss(pair.a), &ofB = avatar.lss(pair.b);
  const std::size_t before = radii.size();
  for (std::size_t i = 0; i < ofA.size(); ++i) {
    for (std::size_t j = 0; j < ofB.size(); ++j) {
      const double radius = rest.distance(pair.a, i, pair.b, j) - skin;
      if (radius >= ofA[i].radius + ofB[j].radius) continue;
      if (!(radius > 0.0)) {
        radii.resize(before);
        return false;
      }
      radii.push_back(
          {pair.a, static_cast<std::int32_t>(i), pair.b, static_cast<std::int32_t>(j), radius});
    }
  }
  return true;
}

/// In how many of the poses two links touch.
std::vector<PairTouches> countTouches(const Avatar& avatar, const std::vector<Pose>& poses) {
  std::vector<PairTouches> touches;
  if (poses.empty()) return touches;
  forPairs(avatar, [&](LinkId a, LinkId b) { touches.push_back({a, b, 0}); });
  for (const Pose& pose : poses) {
    const std::vector<LinkState> states = statesIn(avatar, pose);
    const PosedAvatar posed(avatar, states);
    for (PairTouches& pair : touches) pair.touches += posed.touch(pair.a, pair.b) ? 1 : 0;
  }
  return touches;
}

std::tuple<LinkId, LinkId, std::int32_t, std::int32_t> placeOf(const PairRadius& own) {
  return {own.a, own.b, own.lssA, own.lssB};
}

/// What is wrong with a radius; nullptr: nothing.
const char* wrongOf(const Avatar& avatar, const PairRadius& own) {
  if (own.a < 0 || own.b >= avatar.numLinks()) return "expected links of the avatar";
  if (own.a == own.b) return "expected two different links";
  const auto &ofA = avatar.lss(own.a), &ofB = avatar.lss(own.b);
  if (own.lssA < 0 || slotOf(own.lssA) >= ofA.size() || own.lssB < 0 ||
      slotOf(own.lssB) >= ofB.size()) {
    return "expected LSS that the two links have";
  }
  const double sum = ofA[slotOf(own.lssA)].radius + ofB[slotOf(own.lssB)].radius;
  return own.radius > 0.0 && own.radius < sum
             ? nullptr
             : "expected metres, above 0 and below the sum of the two radii";
}

Error radiusRefused(std::size_t place, const char* why) {
  Error error = Error::in("radii", ErrorCode::OutOfRange, why);
  error.index = static_cast<std::int64_t>(place);
  return error;
}

Result<Done> checkedOptions(const Avatar& avatar, const PairRuleOptions& options) {
  if (!(options.restSkin > 0.0 && std::isfinite(options.restSkin))) {
    return Error::in("restSkin", ErrorCode::OutOfRange, "expected metres, above 0");
  }
  if (!(options.alwaysShare > 0.0 && options.alwaysShare <= 1.0)) {
    return Error::in("alwaysShare", ErrorCode::OutOfRange, "expected a share, above 0, at most 1");
  }
  if (options.usualPoses == nullptr) return Done{};
  for (const Pose& pose : *options.usualPoses) {
    if (pose.rotations.size() != countOf(avatar.numLinks()) ||
        pose.translations.size() != countOf(avatar.numLinks())) {
      return Error::in("usualPoses", ErrorCode::Mismatch, "expected poses of this avatar");
    }
  }
  return Done{};
}

}  // namespace

const char* toString(PairReason reason) {
  switch (reason) {
    case PairReason::Asked: return "asked";
    case PairReason::Adjacent: return "adjacent";
    case PairReason::RestOverlap: return "rest-overlap";
    case PairReason::Always: return "always";
    case PairReason::User: return "user";
  }
  return "asked";
}

Result<PairRules> PairRules::derive(const Avatar& avatar, const PairRuleOptions& options) {
  FORETOUCH_CHECK(checkedOptions(avatar, options));
  PairRules rules;
  for (const LinkPair& pair : options.leftOut) {
    rules.leftOut_.push_back({pair.a, pair.b, PairReason::User});
  }
  if (options.usualPoses != nullptr) {
    rules.touches_ = countTouches(avatar, *options.usualPoses);
    rules.numUsualPoses_ = static_cast<std::int64_t>(options.usualPoses->size());
  }
  const auto numPoses = static_cast<double>(rules.numUsualPoses_);
  const std::vector<LinkState> atRest = statesIn(avatar, restPose(avatar.skeleton()));
  const PosedAvatar rest(avatar, atRest);
  std::size_t place = 0;
  forPairs(avatar, [&](LinkId a, LinkId b) {
    const std::int64_t touched = numPoses > 0.0 ? rules.touches_[place++].touches : 0;
    const auto leaveOut = [&](PairReason reason) { rules.leftOut_.push_back({a, b, reason}); };
    if (isAdjacent(avatar, a, b)) return leaveOut(PairReason::Adjacent);
    const bool isRestTaken = options.isRestTaken && (numPoses == 0.0 || touched > 0);
    if (isRestTaken && rest.touch(a, b) &&
        !(options.usePairRadii && addRadii(avatar, rest, {a, b}, options.restSkin, rules.radii_))) {
      return leaveOut(PairReason::RestOverlap);
    }
    if (numPoses > 0.0 && static_cast<double>(touched) >= options.alwaysShare * numPoses) {
      leaveOut(PairReason::Always);
    }
  });
  FORETOUCH_CHECK(rules.settle(avatar));
  return rules;
}

Result<PairRules> PairRules::derive(const Robot& robot, const RobotPairOptions& options) {
  FORETOUCH_TRY(const auto poses, robot.sampledPoses(options.samples, options.seed));
  PairRuleOptions ofAvatar;
  ofAvatar.usualPoses = &poses;
  ofAvatar.isRestTaken = false;
  ofAvatar.alwaysShare = options.alwaysShare;
  ofAvatar.leftOut = options.leftOut;
  return derive(robot.avatar(), ofAvatar);
}

Result<PairRules> PairRules::asking(const Avatar& avatar, const std::vector<LinkPair>& asked) {
  if (asked.empty()) {
    return Error::in("pairs", ErrorCode::Empty, "expected at least one pair of links to ask");
  }
  std::set<std::pair<LinkId, LinkId>> wanted;
  for (const LinkPair& pair : asked) {
    for (const LinkId link : {pair.a, pair.b}) {
      const bool isKnown = link >= 0 && link < avatar.numLinks();
      if (isKnown && !avatar.lss(link).empty()) continue;
      return Error{ErrorCode::OutOfRange, "pairs", -1, link,
                   isKnown ? "expected a link with LSS: one without touches nothing"
                           : "expected a link of the avatar"};
    }
    if (pair.a == pair.b) {
      return Error{ErrorCode::OutOfRange, "pairs", -1, pair.a, "expected two different links"};
    }
    wanted.insert(std::minmax(pair.a, pair.b));
  }
  std::vector<LeftOutPair> others;
  forPairs(avatar, [&](LinkId a, LinkId b) {
    if (wanted.count({a, b}) == 0) others.push_back({a, b, PairReason::User});
  });
  return leavingOut(avatar, std::move(others));
}

Result<PairRules> PairRules::leavingOut(const Avatar& avatar, std::vector<LeftOutPair> leftOut,
                                        std::vector<PairRadius> radii) {
  PairRules rules;
  rules.leftOut_ = std::move(leftOut);
  FORETOUCH_CHECK(rules.settle(avatar));
  rules.radii_ = std::move(radii);
  FORETOUCH_CHECK(rules.settleRadii(avatar));
  return rules;
}

/// Sorts the pairs that are left out, drops repetitions (the lowest reason stays) and checks them.
Result<Done> PairRules::settle(const Avatar& avatar) {
  numLinks_ = avatar.numLinks();
  avatarIdentity_ = avatar.identity();
  for (LeftOutPair& pair : leftOut_) {
    for (const LinkId link : {pair.a, pair.b}) {
      if (link < 0 || link >= numLinks_) {
        return Error{ErrorCode::OutOfRange, "pairs", -1, link, "expected a link of the avatar"};
      }
    }
    if (pair.a == pair.b) {
      return Error{ErrorCode::OutOfRange, "pairs", -1, pair.a, "expected two different links"};
    }
    if (pair.a > pair.b) std::swap(pair.a, pair.b);
  }
  std::sort(leftOut_.begin(), leftOut_.end(), comesBefore);
  const auto same = [](const LeftOutPair& x, const LeftOutPair& y) {
    return x.a == y.a && x.b == y.b;
  };
  leftOut_.erase(std::unique(leftOut_.begin(), leftOut_.end(), same), leftOut_.end());
  forPairs(avatar, [&](LinkId a, LinkId b) {
    ++numPairs_;
    if (reasonOf(a, b) == PairReason::Asked) ++numAsked_;
  });
  if (numAsked_ == 0) {
    return Error::in("pairs", ErrorCode::Empty,
                     "expected at least one pair of links to ask, found all " +
                         std::to_string(numPairs_) + " left out");
  }
  return Done{};
}

Result<Done> PairRules::settleRadii(const Avatar& avatar) {
  std::vector<std::size_t> order(radii_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < radii_.size(); ++i) {
    PairRadius& own = radii_[i];
    if (own.a > own.b) {
      std::swap(own.a, own.b);
      std::swap(own.lssA, own.lssB);
    }
    if (const char* const wrong = wrongOf(avatar, own); wrong != nullptr) {
      return radiusRefused(i, wrong);
    }
    if (reasonOf(own.a, own.b) != PairReason::Asked) {
      return radiusRefused(i, "expected a pair of links that is asked");
    }
  }
  std::sort(order.begin(), order.end(), [this](std::size_t x, std::size_t y) {
    return std::make_tuple(placeOf(radii_[x]), x) < std::make_tuple(placeOf(radii_[y]), y);
  });
  std::vector<PairRadius> sorted;
  for (const std::size_t i : order) {
    if (!sorted.empty() && placeOf(sorted.back()) == placeOf(radii_[i])) {
      return radiusRefused(i, "expected each two LSS once");
    }
    sorted.push_back(radii_[i]);
  }
  radii_ = std::move(sorted);
  return Done{};
}

PairReason PairRules::reasonOf(LinkId a, LinkId b) const {
  if (a > b) std::swap(a, b);
  const auto found = std::lower_bound(leftOut_.begin(), leftOut_.end(), LeftOutPair{a, b, {}},
                                      [](const LeftOutPair& x, const LeftOutPair& y) {
                                        return std::tie(x.a, x.b) < std::tie(y.a, y.b);
                                      });
  const bool isLeftOut = found != leftOut_.end() && found->a == a && found->b == b;
  return isLeftOut ? found->reason : PairReason::Asked;
}

PairReasonCheck::PairReasonCheck(const Avatar& avatar)
    : avatar_(avatar), atRest_(statesIn(avatar, restPose(avatar.skeleton()))) {}

bool PairReasonCheck::isTrue(const LeftOutPair& pair) const {
  switch (pair.reason) {
    case PairReason::Adjacent: return isAdjacent(avatar_, pair.a, pair.b);
    case PairReason::RestOverlap: return PosedAvatar(avatar_, atRest_).touch(pair.a, pair.b);
    case PairReason::Asked:
    case PairReason::Always:
    case PairReason::User: break;
  }
  return true;
}

}  // namespace foretouch
