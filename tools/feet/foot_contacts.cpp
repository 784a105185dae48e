#include "tools/feet/foot_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "articulated/link_places.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/events/world_follower.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Poses that are followed in one go: enough to spread what a call costs.
constexpr std::int64_t kPosesPerStretch = 32;

/// Collects the events of one body.
class Collector {
 public:
  explicit Collector(const FeetInputs& inputs) : inputs_(inputs), beginS_(inputs.timeOf(0)) {
    partOfLink_.assign(countOf(inputs.body.avatar.numLinks()), 0);
    for (std::size_t part = 0; part < inputs.body.parts.size(); ++part) {
      for (const LinkId link : inputs.body.parts[part].links) partOfLink_[slotOf(link)] = part;
    }
  }

  Result<Done> take(const WorldEvents& answer) {
    for (const WorldEvent& event : answer.events) FORETOUCH_CHECK(take(event));
    return Done{};
  }
  PartContacts finish(double endS);

 private:
  Result<Done> take(const WorldEvent& event);
  [[nodiscard]] Result<bool> isOverhead(const WorldEvent& event) const;
  [[nodiscard]] PartContact begun(const WorldEvent& event) const;
  [[nodiscard]] double secondsOf(const WorldTime& time) const {
    return beginS_ + microsecondsAfter(0, time) / kUsPerS;
  }
  [[nodiscard]] GroundSurface surfaceOf(const WorldEvent& event) const;
  void keep(PartContact contact);

  const FeetInputs& inputs_;
  double beginS_;
  std::vector<std::size_t> partOfLink_;
  std::map<std::pair<LinkId, ObjectId>, PartContact> open_;
  PartContacts found_;
};

/// The plane of the triangle that is met, turned towards the part; up, for what stands.
GroundSurface Collector::surfaceOf(const WorldEvent& event) const {
  const Vector3d front = inputs_.level.normal(event.b.triangle);
  const Vector3d normal = front.isZero(0.0) ? event.nhat_BA_W : front;
  const bool isLevel = std::abs(normal.y()) >= kWalkableUp;
  const double side = isLevel ? normal.y() : normal.dot(event.nhat_BA_W);
  return {event.b.p_W, side < 0.0 ? Vector3d(-normal) : normal};
}

PartContact Collector::begun(const WorldEvent& event) const {
  PartContact contact;
  contact.part = partOfLink_[slotOf(event.a.link)];
  contact.object = event.object;
  contact.fromS = secondsOf(event.time);
  contact.beganBefore = event.kind == EventKind::StartsInside;
  contact.surface = surfaceOf(event);
  return contact;
}

/// A foot that is below a board and touches it from there does not stand on it.
Result<bool> Collector::isOverhead(const WorldEvent& event) const {
  const RestingPart& part = inputs_.body.parts[partOfLink_[slotOf(event.a.link)]];
  if (part.isHand() || event.nhat_BA_W.y() > -kWalkableUp) return false;
  const double steps = (secondsOf(event.time) - beginS_) / inputs_.stepS();
  FORETOUCH_TRY(const auto pose,
                inputs_.poseAt(std::min(inputs_.steps(), static_cast<std::int64_t>(steps))));
  std::vector<LinkState> states;
  placesAt(inputs_.body.avatar.skeleton(), pose, states);
  const PartCorner& lowest = part.corners[lowestOf(part, states, Vector3d::UnitY()).corner];
  const Vector3d p_W =
      states[slotOf(lowest.link)].pointAt(lowest.center_L) - Vector3d(0, lowest.radius, 0);
  const auto ground = inputs_.groundOf(inputs_.body.limbs[part.limb], states, p_W);
  return ground && ground->heightOf(event.b.p_W) > kSameSurface;
}

Result<Done> Collector::take(const WorldEvent& event) {
  const auto key = std::make_pair(event.a.link, event.object);
  switch (event.kind) {
    case EventKind::Enter:
    case EventKind::StartsInside: {
      FORETOUCH_TRY(const bool isAbove, isOverhead(event));
      if (!isAbove) open_[key] = begun(event);
      break;
    }
    case EventKind::Leave:
      if (const auto known = open_.find(key); known != open_.end()) {
        known->second.toS = secondsOf(event.time);
        keep(known->second);
        open_.erase(known);
      }
      break;
    case EventKind::UnresolvedTo:
      found_.unresolvedS += secondsOf(event.time) - secondsOf(event.since);
      break;
    case EventKind::UnresolvedFrom: break;
  }
  return Done{};
}

/// A foot that meets a wall does not stand on it.
void Collector::keep(PartContact contact) {
  const bool isHand = inputs_.body.parts[contact.part].isHand();
  if (isHand || contact.surface.normal_W.y() >= kWalkableUp) found_.contacts.push_back(contact);
}

PartContacts Collector::finish(double endS) {
  for (auto& [key, contact] : open_) {
    contact.toS = endS;
    contact.goesOn = true;
    keep(contact);
  }
  auto& all = found_.contacts;
  std::sort(all.begin(), all.end(), [](const PartContact& x, const PartContact& y) {
    return std::tie(x.part, x.fromS, x.toS, x.object) < std::tie(y.part, y.fromS, y.toS, y.object);
  });
  // Several links of a part, or objects below it, touch at once: together they are one contact.
  std::vector<PartContact> merged;
  for (const PartContact& contact : all) {
    if (merged.empty() || merged.back().part != contact.part || contact.fromS > merged.back().toS) {
      merged.push_back(contact);
      continue;
    }
    PartContact& last = merged.back();
    if (contact.toS > last.toS) last.toS = contact.toS, last.goesOn = contact.goesOn;
  }
  all = std::move(merged);
  return std::move(found_);
}

/// Finds where feet are wholly below the ground: between two contacts, before the first one, or
/// after the last.
class UnderGround {
 public:
  UnderGround(const FeetInputs& inputs, std::vector<PartContact> contacts)
      : inputs_(inputs), contacts_(std::move(contacts)) {}

  Result<std::vector<PartContact>> joined() {
    std::size_t next = 0;
    for (std::size_t part = 0; part < inputs_.body.parts.size(); ++part) {
      const std::size_t first = next;
      while (next < contacts_.size() && contacts_[next].part == part) ++next;
      const bool isHand = inputs_.body.parts[part].isHand();
      if (!isHand) FORETOUCH_CHECK(addFoot(part, first, next));
      for (std::size_t i = first; isHand && i < next; ++i) joined_.push_back(contacts_[i]);
    }
    return std::move(joined_);
  }

 private:
  Result<Done> addFoot(std::size_t part, std::size_t first, std::size_t end);
  Result<bool> goOnUnder(PartContact& open, std::int64_t from, std::int64_t beyond);
  [[nodiscard]] Result<bool> isUnder(std::size_t part, std::int64_t step);
  [[nodiscard]] std::int64_t stepAfter(double timeS) const {
    return static_cast<std::int64_t>(std::floor((timeS - inputs_.timeOf(0)) / inputs_.stepS())) + 1;
  }

  const FeetInputs& inputs_;
  std::vector<PartContact> contacts_, joined_;
  std::vector<LinkState> states_;
};

Result<bool> UnderGround::isUnder(std::size_t part, std::int64_t step) {
  FORETOUCH_TRY(const auto pose, inputs_.poseAt(step));
  ChainMotion(inputs_.body.avatar.skeleton(), pose, pose).statesAt(0.0, states_);
  for (const PartCorner& corner : inputs_.body.parts[part].corners) {
    const Vector3d p_W = states_[slotOf(corner.link)].pointAt(corner.center_L);
    const auto ground =
        inputs_.groundOf(inputs_.body.limbs[inputs_.body.parts[part].limb], states_, p_W);
    if (!ground || ground->heightOf(p_W) + corner.radius >= 0.0) return false;
  }
  return true;
}

/// Adds the poses from `from` on that are below the ground. True if these are all before `beyond`,
/// and at least one.
Result<bool> UnderGround::goOnUnder(PartContact& open, std::int64_t from, std::int64_t beyond) {
  std::int64_t step = from;
  while (step < beyond) {
    FORETOUCH_TRY(const bool still, isUnder(open.part, step));
    if (!still) break;
    ++step;
  }
  if (step == from) return false;
  open.underS += static_cast<double>(step - from) * inputs_.stepS();
  open.toS = std::max(open.toS, inputs_.timeOf(step - 1));
  open.goesOn = step == inputs_.steps() + 1;
  return step == beyond;
}

Result<Done> UnderGround::addFoot(std::size_t part, std::size_t first, std::size_t end) {
  const std::int64_t poses = inputs_.steps() + 1;
  PartContact open;
  open.part = part;
  open.fromS = open.toS = inputs_.timeOf(0);
  open.beganBefore = true;
  std::int64_t from = 0;  // the first pose that the open contact does not hold
  for (std::size_t i = first; i <= end; ++i) {
    const std::int64_t beyond =
        i == end ? poses : std::min(poses, stepAfter(contacts_[i].fromS - 1e-6));
    FORETOUCH_TRY(const bool isJoined, goOnUnder(open, from, beyond));
    const bool isReal = open.toS > open.fromS || open.underS > 0.0;
    if (i == end || !isJoined) {
      if (isReal) joined_.push_back(open);
      if (i != end) open = contacts_[i];
    } else {
      open.toS = contacts_[i].toS;
      open.goesOn = contacts_[i].goesOn;
    }
    if (i != end) from = stepAfter(open.toS);
  }
  return Done{};
}

}  // namespace

Result<PartContacts> partContactsOf(const FeetInputs& inputs) {
  WorldOptions options;
  options.tolerance = inputs.request.tolerance;
  FORETOUCH_TRY(auto world, World::build(inputs.level.scene(), options));
  FORETOUCH_TRY(const BodyId body, world.add(inputs.body.avatar));
  FORETOUCH_TRY(auto follower, WorldFollower::start(0));
  Collector collector(inputs);
  WorldEvents answer;
  for (std::int64_t step = 0; step <= inputs.steps(); ++step) {
    FORETOUCH_TRY(const auto pose, inputs.poseAt(step));
    const std::int64_t us = inMicroseconds(inputs.timeOf(step) - inputs.timeOf(0));
    FORETOUCH_CHECK(world.push(body, us, pose));
    if (step % kPosesPerStretch != 0 && step != inputs.steps()) continue;
    FORETOUCH_CHECK(follower.follow(world, us, answer));
    FORETOUCH_CHECK(collector.take(answer));
    if (step > 0) world.forgetBefore(us);
  }
  PartContacts found = collector.finish(inputs.timeOf(inputs.steps()));
  FORETOUCH_TRY(found.contacts, UnderGround(inputs, std::move(found.contacts)).joined());
  return found;
}

}  // namespace foretouch::tools
