#include "tests/middleware/solid_world/together_runner.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "bench/solid/plain_body.h"
#include "middleware/solid/tree_pose.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

constexpr double kRounding = 1e-10;
constexpr std::size_t kMostFindings = 20;

Pose poseOf(const RigidPose& rigid) {
  return {{rigid.rotation}, {rigid.translation}};
}

Avatar ofOneJoint(const std::vector<Lss>& lss) {
  RawSkeleton raw;
  raw.joints = {{"body", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(), {lss}).value();
}

/// FNV-1a.
void addTo(std::uint64_t& digest, const Pose& pose) {
  const auto addBytes = [&digest](const void* data, std::size_t count) {
    const auto* const bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < count; ++i) digest = (digest ^ bytes[i]) * 1099511628211u;
  };
  for (const Quaternion& q : pose.rotations) addBytes(q.coeffs().data(), 4 * sizeof(double));
  for (const Eigen::Vector3d& p : pose.translations) addBytes(p.data(), 3 * sizeof(double));
}

bool isIn(const std::vector<BodyId>& bodies, int body) {
  return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
}

}  // namespace

void TogetherTally::add(const TogetherTally& other) {
  ticks += other.ticks;
  moved += other.moved;
  crushed += other.crushed;
  placing += other.placing;
  equal += other.equal;
  pushed += other.pushed;
  instants += other.instants;
  inside += other.inside;
  broken += other.broken;
  overclaimed += other.overclaimed;
  uncertified += other.uncertified;
  betweenSolids += other.betweenSolids;
  least = std::min(least, other.least);
  for (const std::string& finding : other.findings) {
    if (findings.size() < kMostFindings) findings.push_back(finding);
  }
}

TogetherRunner::TogetherRunner(const RawScene& still, int instants)
    : world(SolidWorld::build(Scene::build(still).value(), 0).value()),
      instants_(instants),
      judge_(tools::plain(still.triangles)) {}

void TogetherRunner::add(const Avatar& avatar, bool isSolid) {
  TogetherBody body;
  body.isSolid = isSolid;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    body.parents.push_back(avatar.skeleton().parent(link));
    for (const Lss& lss : avatar.lss(link)) {
      body.parts.push_back({link, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius});
    }
  }
  judge_.bodies.push_back(body);
  avatars_.push_back(avatar);
  Mover mover;
  mover.isSolid = isSolid;
  mover.at = mover.next = restPose(avatar.skeleton());
  movers_.push_back(mover);
}

BodyId TogetherRunner::addSolid(const Avatar& avatar, const SolidOptions& options) {
  add(avatar, true);
  return world.add(avatar, options).value();
}

BodyId TogetherRunner::addMover(const Avatar& avatar) {
  add(avatar, false);
  return world.world().add(avatar).value();
}

BodyId TogetherRunner::addMover(const Scene& mesh) {
  add(ofOneJoint({{}}), false);
  std::vector<TogetherPart>& parts = judge_.bodies.back().parts;
  parts.clear();
  for (std::size_t i = 0; i < mesh.numTriangles(); ++i) {
    parts.push_back({0, 3, plain(mesh.triangle(static_cast<TriangleId>(i))), 0.0});
  }
  return world.world().add(mesh).value();
}

void TogetherRunner::moveTo(BodyId body, const Pose& pose) {
  movers_[slotOf(body)].next = pose;
}

void TogetherRunner::moveTo(BodyId body, const RigidPose& pose) {
  moveTo(body, poseOf(pose));
}

void TogetherRunner::goVia(BodyId body, std::int64_t afterUs, const Pose& pose) {
  movers_[slotOf(body)].via.emplace_back(afterUs, pose);
}

void TogetherRunner::follow(BodyId body, const Pose& target,
                            const std::vector<std::uint8_t>& isTracked) {
  targets_[body] = {target, isTracked};
}

void TogetherRunner::take(BodyId tool, BodyId holder, LinkId hand, const RigidPose& inHand) {
  Mover& mover = movers_[slotOf(tool)];
  const auto attached = world.world().attach(tool, {holder, hand}, atUs(), inHand);
  ASSERT_TRUE(attached.ok()) << describe(attached.error());
  mover.isHeld = true;
  mover.holder = holder;
  mover.hand = hand;
  mover.at = mover.next = poseOf(inHand);
}

void TogetherRunner::letGo(BodyId tool) {
  Mover& mover = movers_[slotOf(tool)];
  std::vector<LinkState> states;
  internal::placeLinks(avatars_[slotOf(mover.holder)].skeleton(), shown_[mover.holder], states);
  const LinkState& hand = states[slotOf(mover.hand)];
  const RigidPose at{(Quaternion(hand.R_WL) * mover.at.rotations[0]).normalized(),
                     hand.pointAt(mover.at.translations[0])};
  const auto detached = world.world().detach(tool, atUs(), at);
  ASSERT_TRUE(detached.ok()) << describe(detached.error());
  mover.isHeld = false;
  mover.at = mover.next = poseOf(at);
}

void TogetherRunner::tick(std::int64_t durationUs) {
  const std::int64_t fromUs = atUs(), toUs = fromUs + durationUs;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    Mover& mover = movers_[i];
    if (mover.isSolid || mover.isHeld) continue;
    const auto id = static_cast<BodyId>(i);
    if (mover.isNew) {
      mover.at = mover.next;
      ASSERT_TRUE(world.world().push(id, fromUs, mover.at).ok());
    }
    mover.isNew = false;
    for (const auto& [afterUs, pose] : mover.via) {
      ASSERT_TRUE(world.world().push(id, fromUs + afterUs, pose).ok());
    }
    const auto pushed = world.world().push(id, toUs, mover.next);
    ASSERT_TRUE(pushed.ok()) << describe(pushed.error());
  }
  std::vector<SolidBodyTarget> targets;
  for (const auto& [body, target] : targets_) {
    targets.push_back({body, &target.pose, target.isTracked.empty() ? nullptr : &target.isTracked});
  }
  const auto done = world.tick(toUs, targets, ticks);
  ASSERT_TRUE(done.ok()) << describe(done.error());
  if (tamper) tamper(ticks);
  judgeTick(fromUs, toUs);
  for (Mover& mover : movers_) {
    mover.at = mover.next;
    mover.via.clear();
  }
  world.world().forgetBefore(fromUs);
}

const SolidBodyTick& TogetherRunner::of(BodyId body) const {
  return *std::find_if(ticks.begin(), ticks.end(),
                       [body](const SolidBodyTick& tick) { return tick.body == body; });
}

void TogetherRunner::find(const std::string& what) {
  if (tally.findings.size() < kMostFindings) tally.findings.push_back(what);
}

void TogetherRunner::judgeTick(std::int64_t fromUs, std::int64_t toUs) {
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const Mover& mover = movers_[i];
    TogetherBody& body = judge_.bodies[i];
    body.legs.clear();
    body.holder = mover.isHeld ? mover.holder : -1;
    body.holdingLink = mover.hand;
    if (mover.isSolid || mover.isNew) continue;
    std::int64_t beginUs = fromUs;
    oracle::PlainPose from = tools::plainPose(mover.at);
    for (const auto& [afterUs, pose] : mover.via) {
      body.legs.push_back({beginUs, fromUs + afterUs, from, tools::plainPose(pose)});
      beginUs = fromUs + afterUs;
      from = tools::plainPose(pose);
    }
    body.legs.push_back({beginUs, toUs, from, tools::plainPose(mover.next)});
  }
  const auto length = static_cast<double>(toUs - fromUs);
  for (const SolidBodyTick& tick : ticks) {
    const SolidTick& own = tick.tick;
    ++tally.ticks;
    tally.moved += own.numWay > 0 ? 1 : 0;
    tally.crushed += tick.crushes.empty() ? 0 : 1;
    tally.equal += own.state == SolidState::Equal ? 1 : 0;
    tally.pushed += tick.contacts.empty() ? 0 : 1;
    if (own.state == SolidState::Placing) {
      ++tally.placing;
      continue;
    }
    const bool isCrushed = std::any_of(tick.crushes.begin(), tick.crushes.end(),
                                       [](const SolidCrush& crush) { return !crush.isOver; });
    if (own.isCertified == isCrushed) ++tally.uncertified;
    for (const SolidCrush& crush : tick.crushes) {
      if (!movers_[slotOf(crush.body)].isSolid) continue;
      ++tally.betweenSolids;
      find("body " + std::to_string(tick.body) + " is crushed by the solid avatar " +
           std::to_string(crush.body));
    }
    const auto before = shown_.find(tick.body);
    std::size_t first = 0;
    Pose from = before != shown_.end() ? before->second : own.shown;
    if (own.hasAppeared) {
      from = own.way[0];
      first = 1;
    } else if (before == shown_.end()) {
      ++tally.broken;
    }
    if (own.hasAppeared && before != shown_.end()) ++tally.broken;
    std::int64_t beginUs = fromUs;
    std::vector<TogetherLeg>& legs = judge_.bodies[slotOf(tick.body)].legs;
    for (std::size_t k = first; k < own.numWay; ++k) {
      const auto endUs = fromUs + static_cast<std::int64_t>(std::llround(own.times[k] * length));
      if (endUs <= beginUs || endUs > toUs) ++tally.broken;
      legs.push_back({beginUs, endUs, tools::plainPose(from), tools::plainPose(own.way[k])});
      from = own.way[k];
      beginUs = endUs;
    }
    if (beginUs < toUs) {
      legs.push_back({beginUs, toUs, tools::plainPose(from), tools::plainPose(from)});
    }
    if (!internal::isSamePose(from, own.shown)) ++tally.broken;
    shown_[tick.body] = own.shown;
    addTo(tally.digest, own.shown);
  }
  const auto holderOf = [&](int body) {
    return body >= 0 && movers_[slotOf(body)].isHeld ? movers_[slotOf(body)].holder : body;
  };
  const auto isExcused = [&](int a, int b, std::int64_t us) {
    for (const SolidBodyTick& tick : ticks) {
      for (const auto& [x, y] : {std::pair(a, b), std::pair(b, a)}) {
        if (isIn(tick.looseTools, x)) return true;
        if (holderOf(x) != tick.body) continue;
        if (isIn(tick.letGo, y)) return true;
        for (const SolidCrush& crush : tick.crushes) {
          if (!crush.isOver && crush.body == y && us >= crush.sinceUs) return true;
        }
      }
    }
    return false;
  };
  const TogetherReading reading = judge_.look(fromUs, toUs, instants_, isExcused);
  tally.instants += reading.instants;
  tally.least = std::min(tally.least, reading.least);
  tally.inside += reading.inside.size();
  for (const std::string& what : reading.inside) find(what);
  for (const SolidBodyTick& tick : ticks) {
    const double least = reading.leastOf[slotOf(tick.body)];
    if (tick.tick.numWay == 0 || tick.tick.clearance <= least + kRounding) continue;
    ++tally.overclaimed;
    std::ostringstream what;
    what << "body " << tick.body << " at " << toUs << " us: clearance " << tick.tick.clearance
         << " above " << least;
    find(what.str());
  }
}

std::uint64_t TogetherRunner::violations() const {
  for (const std::string& finding : tally.findings) ADD_FAILURE() << finding;
  return tally.violations();
}

}  // namespace foretouch::test
