#include "tools/repair/demands.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "middleware/depth/depth.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Steps before a fault and after it that keep to its side as well.
constexpr std::int32_t kAround = 1;
/// A later fault within so many steps is the same one.
constexpr std::int32_t kSame = 3;

}  // namespace

/// The side on which the link was before it touched; where it begins inside, up if it is in what one
/// stands on, else the way out.
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
  const bool isGround = std::abs(front.y()) >= kWalkableUp;
  if (!fault.isStart) {
    if (side.normal_W.isZero(0.0)) side.normal_W = front;
    return side;
  }
  if (isGround && stage_.feet().isPlain) {
    side.normal_W = front.y() < 0.0 ? Vector3d(-front) : front;
    return side;
  }
  std::vector<LinkState> states;
  placeLinks(stage_.body().skeleton(), stage_.poses()[slotOf(fault.step)], states);
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

/// Behind the surface after its last step.
bool Demands::endsBehind(const Side& side) const {
  if (side.normal_W.isZero(0.0)) return false;
  std::vector<LinkState> states;
  placeLinks(stage_.body().skeleton(), stage_.poses()[slotOf(side.last + 1)], states);
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
  for (const StepFault& fault : faults.all) {
    switch (fault.kind) {
      case FaultKind::Scene:
      case FaultKind::Own:
        if (!fault.isUndecided) isNew = takeContact(fault) || isNew;
        break;
      case FaultKind::Under:
        isNew = lifts_.insert({fault.part, fault.step}).second || isNew;
        lifts_.insert({fault.part, fault.step + 1});
        break;
      case FaultKind::Limit: isNew = limits_.insert({fault.link, fault.step}).second || isNew; break;
      case FaultKind::Slide: break;
    }
  }
  for (const FootStance& stance : faults.feet.stances) {
    if (stance.looks.empty() || !isSlide(stance, stage_)) continue;
    if (stage_.feet().body.parts[stance.part].isHand()) continue;
    const Hold hold{stance.part, static_cast<std::int32_t>(stance.looks.front().step),
                    static_cast<std::int32_t>(stance.looks.back().step)};
    const bool isKnown = std::any_of(holds_.begin(), holds_.end(), [&](const Hold& known) {
      return known.part == hold.part && known.first <= hold.first && hold.last <= known.last;
    });
    if (isKnown) continue;
    holds_.push_back(hold);
    isNew = true;
  }
  if (isFirst_) joinThroughs();
  isFirst_ = false;
  return isNew;
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
