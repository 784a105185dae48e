#include "tools/repair/demands.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "articulated/link_places.h"
#include "lss/index.h"
#include "middleware/depth/depth.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Steps before a fault and after it that keep to its side, too.
constexpr std::int32_t kAround = 1;
/// A later fault within so many steps is the same one.
constexpr std::int32_t kSame = 3;

}  // namespace

/// The side on which the link was before it touched; if it begins inside, up if it is in ground to
/// stand on, else the way out.
Side Demands::begun(const StepFault& fault) const {
  Side side;
  side.link = fault.link;
  side.other = fault.other;
  side.object = fault.object;
  side.first = std::max(0, fault.step - kAround);
  side.last = std::min(fault.step + kAround, stage_.numPoses() - 2);
  side.normal_W = fault.normal_W;
  side.p_W = fault.p_W;
  if (fault.kind == FaultKind::Own || fault.triangle < 0) return side;
  const Vector3d front = stage_.feet().level.normal(fault.triangle);
  // Nothing belongs below a plain floor, and no foot below what it stands on.
  const bool isGround = std::abs(front.y()) >= kWalkableUp;
  if (isGround && (stage_.feet().isPlain || isUnder(fault))) {
    side.normal_W = front.y() < 0.0 ? Vector3d(-front) : front;
    return side;
  }
  if (!fault.isStart) {
    if (side.normal_W.isZero(0.0)) side.normal_W = front;
    return side;
  }
  std::vector<LinkState> states;
  placesAt(stage_.body().skeleton(), stage_.poses()[slotOf(fault.step)], states);
  std::vector<Lss> placed;
  for (const Lss& lss : stage_.body().lss(fault.link)) {
    const LinkState& state = states[slotOf(fault.link)];
    placed.push_back({state.pointAt(lss.a), state.pointAt(lss.b), lss.radius});
  }
  Scratch scratch;
  const Depth depth = depthIn(placed, stage_.feet().level.scene(), scratch);
  if (depth.isCertified && depth.wayOut.norm() > 0.0) side.normal_W = depth.wayOut.normalized();
  return side;
}

/// True for a foot of which a part is below its ground, about then.
bool Demands::isUnder(const StepFault& fault) const {
  const auto& parts = stage_.feet().body.parts;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (stage_.linkOf(parts[part].links.front()) != fault.link) continue;
    const auto next = lifts_.lower_bound({part, fault.step - kSame});
    if (next != lifts_.end() && next->first == part && next->second <= fault.step + kSame)
      return true;
  }
  return false;
}

bool Demands::takeContact(const StepFault& fault) {
  if (fault.at > 0.0 && fault.at < 1.0) instants_[fault.step].insert(fault.at);
  for (Side& side : sides_) {
    if (side.link != fault.link || side.other != fault.other || side.object != fault.object)
      continue;
    if (fault.step + kSame < side.first || fault.step > side.last + kSame) continue;
    const std::int32_t first = std::min(side.first, std::max(0, fault.step - kAround));
    const std::int32_t last =
        std::max(side.last, std::min(fault.step + kAround, stage_.numPoses() - 2));
    const bool isNew = first < side.first || last > side.last;
    side.first = first;
    side.last = last;
    return isNew;
  }
  sides_.push_back(begun(fault));
  return true;
}

/// True if the link is behind the surface after its last step.
bool Demands::endsBehind(const Side& side) const {
  if (side.normal_W.isZero(0.0)) return false;
  std::vector<LinkState> states;
  placesAt(stage_.body().skeleton(), stage_.poses()[slotOf(side.last + 1)], states);
  const LinkState& state = states[slotOf(side.link)];
  double nearest = 0.0;
  for (const Lss& lss : stage_.body().lss(side.link)) {
    for (const Vector3d& end : {lss.a, lss.b}) {
      const double height = side.normal_W.dot(state.pointAt(end) - side.p_W);
      if (nearest == 0.0 || std::abs(height) < std::abs(nearest)) nearest = height;
    }
  }
  return nearest < 0.0;
}

/// What came through a surface and comes back through it was behind it in between; what does not
/// come back went through.
void Demands::joinThroughs() {
  std::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
    return std::make_tuple(x.link, x.other, x.object, x.first) <
           std::make_tuple(y.link, y.other, y.object, y.first);
  });
  std::vector<Side> joined;
  for (const Side& side : sides_) {
    Side* const last = joined.empty() ? nullptr : &joined.back();
    const bool isSame = last != nullptr && last->link == side.link && last->other == side.other &&
                        last->object == side.object;
    if (isSame && side.other < 0 && endsBehind(*last) && last->normal_W.dot(side.normal_W) < -0.3) {
      last->last = side.last;
    } else {
      joined.push_back(side);
    }
  }
  for (Side& side : joined) side.isLost = side.other < 0 && endsBehind(side);
  sides_ = std::move(joined);
}

bool Demands::take(const Faults& faults) {
  bool isNew = false;
  if (isFirst_) before_ = stage_.poses();
  for (const StepFault& fault : faults.all) {
    if (fault.kind == FaultKind::Limit) {
      isNew = limits_.insert({fault.link, fault.step}).second || isNew;
    } else if (fault.kind == FaultKind::Under) {
      isNew = lifts_.insert({fault.part, fault.step}).second || isNew;
      lifts_.insert({fault.part, fault.step + 1});
    }
  }
  for (const StepFault& fault : faults.all) {
    const bool isContact = fault.kind == FaultKind::Scene || fault.kind == FaultKind::Own;
    if (isContact && !fault.isUndecided) isNew = takeContact(fault) || isNew;
  }
  for (const BearingStance& stance : faults.bearing) {
    if (stance.isFault(stage_.request().mostSlide)) isNew = takeSlide(stance) || isNew;
  }
  if (isFirst_) {
    joinThroughs();
    findRests(faults.feet);
  }
  isFirst_ = false;
  return isNew;
}

Vector3d Demands::wayBefore(const RestLook& look) const {
  const LinkId link = stage_.linkOf(look.link);
  std::vector<LinkState> from, to;
  placesAt(stage_.body().skeleton(), before_[slotOf(look.step)], from);
  placesAt(stage_.body().skeleton(), before_[slotOf(look.step + 1)], to);
  const Vector3d way = to[slotOf(link)].pointAt(look.p_L) - from[slotOf(link)].pointAt(look.p_L);
  return way - look.normal_W.dot(way) * look.normal_W;
}

bool Demands::swings(const RestLook& look) const {
  return wayBefore(look).norm() > kSwingSpeed * stage_.feet().stepS();
}

/// One look of each step: the one that slid farthest. What counts may be another corner than in
/// the round before.
bool Demands::takeSlide(const BearingStance& stance) {
  bool isNew = false;
  for (std::size_t i = 0, looks = 1; i < stance.looks.size(); i += looks, looks = 1) {
    while (i + looks < stance.looks.size() && stance.looks[i + looks].step == stance.looks[i].step)
      ++looks;
    const auto first = stance.looks.begin() + static_cast<std::ptrdiff_t>(i);
    const RestLook& look = *std::max_element(
        first, first + static_cast<std::ptrdiff_t>(looks),
        [](const RestLook& x, const RestLook& y) { return x.way_W.norm() < y.way_W.norm(); });
    const auto pose = static_cast<std::int32_t>(look.step);
    if (swings(look)) {
      isNew = clears_.insert({stance.part, pose}).second || isNew;
      isNew = clears_.insert({stance.part, pose + 1}).second || isNew;
    } else {
      isNew = holds_.insert_or_assign({stance.part, look.step}, look).second || isNew;
    }
  }
  return isNew;
}

/// Where each foot rests before anything is changed: its lowest part.
void Demands::findRests(const FeetAnswer& feet) {
  const auto& parts = stage_.feet().body.parts;
  const auto heightOf = [&](std::int64_t pose, std::size_t part) {
    return feet.sample(pose, part, parts.size()).height;
  };
  for (const FootStance& stance : feet.stances) {
    if (stance.kind == StanceKind::Hovers || parts[stance.part].isHand()) continue;
    for (const RestLook& look : stance.looks) {
      const float height = heightOf(look.step, stance.part);
      bool isLowest = !std::isnan(height);
      for (std::size_t other = 0; other < parts.size(); ++other) {
        isLowest = isLowest && !(parts[other].limb == parts[stance.part].limb &&
                                 heightOf(look.step, other) < height);
      }
      if (!isLowest) continue;
      keeps_[{stance.part, static_cast<std::int32_t>(look.step)}] =
          std::max(static_cast<double>(height), stage_.request().gap) + kRestBand;
    }
  }
}

void Demands::giveUp(const Faults& faults) {
  for (Side& side : sides_) {
    for (const StepFault& fault : faults.all) {
      const bool isIts = fault.link == side.link && fault.other == side.other &&
                         fault.object == side.object && fault.step >= side.first &&
                         fault.step <= side.last;
      const bool isContact = fault.kind == FaultKind::Scene || fault.kind == FaultKind::Own;
      if (isIts && isContact) side.isGivenUp = true;
    }
  }
}

}  // namespace foretouch::tools
