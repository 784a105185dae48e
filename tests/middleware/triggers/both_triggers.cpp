#include "tests/middleware/triggers/both_triggers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "middleware/world/world_parts.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

PlainVolume meshOf(const std::vector<Triangle>& triangles) {
  RawScene raw;
  raw.objectNames = {"volume"};
  raw.triangles = triangles;
  raw.objectOf.assign(triangles.size(), 0);
  PlainVolume plainOne{TriggerVolume::mesh(Scene::build(raw).value()).value(), {}, true};
  for (const Triangle& triangle : triangles) {
    plainOne.parts.push_back({0, 3, plain(triangle), 0.0});
  }
  return plainOne;
}

}  // namespace

PlainVolume plainBox(const Vector3d& half) {
  // Each side seen from outside, turned to the left.
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d n = side * Vector3d::Unit(axis);
      const Vector3d u = Vector3d::Unit((axis + 1) % 3), v = n.cross(u);
      const auto at = [&](double x, double y) {
        return Vector3d((n + x * u + y * v).cwiseProduct(half));
      };
      triangles.push_back({{at(-1, -1), at(1, -1), at(1, 1)}});
      triangles.push_back({{at(-1, -1), at(1, 1), at(-1, 1)}});
    }
  }
  PlainVolume box = meshOf(triangles);
  box.volume = TriggerVolume::box(half).value();
  return box;
}

PlainVolume plainSphere(double radius) {
  return plainLss({{Vector3d::Zero(), Vector3d::Zero(), radius}});
}

PlainVolume plainLss(const std::vector<Lss>& lss) {
  PlainVolume volume{TriggerVolume::lss(lss).value(), {}, false};
  for (const Lss& one : lss) {
    volume.parts.push_back({0, 2, {plain(one.a), plain(one.b), plain(one.b)}, one.radius});
  }
  return volume;
}

PlainVolume plainGlobe(double radius, int rings, int segments) {
  const auto corner = [&](int ring, int k) -> Vector3d {
    const double polar = 3.141592653589793 * ring / rings;
    const double angle = 6.283185307179586 * (k % segments) / segments;
    if (ring == 0 || ring == rings) return {0, 0, ring == 0 ? radius : -radius};
    return radius * Vector3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                             std::cos(polar));
  };
  std::vector<Triangle> triangles;
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < segments; ++k) {
      const Vector3d a = corner(ring, k), b = corner(ring, k + 1);
      const Vector3d c = corner(ring + 1, k), d = corner(ring + 1, k + 1);
      if (ring > 0) triangles.push_back({{a, c, b}});
      if (ring + 1 < rings) triangles.push_back({{b, c, d}});
    }
  }
  return meshOf(triangles);
}

BothTriggers::BothTriggers(double tolerance, std::int64_t fromUs)
    : both(tolerance),
      fromUs_(fromUs),
      untilUs_(fromUs),
      tolerance_(tolerance),
      follower_(WorldFollower::start(fromUs).value()) {}

TriggerId BothTriggers::add(const PlainVolume& volume, const TriggerOptions& options) {
  const TriggerId trigger = triggers.add(both.world, volume.volume, options).value();
  OracleBody body;
  body.parents = {-1};
  body.parts = volume.parts;
  both.oracle.bodies.push_back(body);
  areMeshes_.push_back(volume.isMesh);
  options_.push_back(options);
  return trigger;
}

void BothTriggers::stand(TriggerId trigger, const RigidPose& pose) {
  EXPECT_TRUE(triggers.stand(both.world, trigger, fromUs_, pose).ok());
  both.oracle.bodies[slotOf(body(trigger))].episodes.push_back(
      {fromUs_, -1, 0, {fromUs_}, {{{plain(pose.rotation), plain(pose.translation)}}}});
}

void BothTriggers::follow(std::int64_t untilUs) {
  const auto followed = follower_.follow(both.world, untilUs, answer_);
  ASSERT_TRUE(followed.ok()) << describe(followed.error());
  const auto updated = triggers.update(both.world, answer_, told_);
  ASSERT_TRUE(updated.ok()) << describe(updated.error());
  for (const TriggerEvent& event : told_.events) {
    events.push_back(event);
    ++tally.kinds[slotOf(event.kind)];
  }
  tally.decided += told_.counters.decided;
  noteGuesses(untilUs);
  untilUs_ = untilUs;
}

void BothTriggers::noteGuesses(std::int64_t untilUs) {
  const internal::WorldParts& parts = both.world.parts();
  for (BodyId id = 0; id < both.world.numBodies(); ++id) {
    const internal::WorldBody& body = parts.body(id);
    if (body.episodes.empty()) {
      guesses_.emplace_back(id, untilUs_, untilUs);
    } else if (body.options.whenSilent == WhenSilent::HoldStill &&
               !body.episodes.back().isHeldFast()) {
      const std::int64_t knownUs = body.episodes.back().track.knownUntilUs();
      guesses_.emplace_back(id, std::max(untilUs_, knownUs), untilUs);
    }
  }
}

bool BothTriggers::isGuessed(BodyId body, Real us) const {
  for (const auto& [id, fromUs, toUs] : guesses_) {
    if (id == body && us >= static_cast<Real>(fromUs - fromUs_) &&
        us <= static_cast<Real>(toUs - fromUs_)) {
      return true;
    }
  }
  const auto& episodes = both.oracle.bodies[slotOf(body)].episodes;
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const bool isNow =
        us >= static_cast<Real>(episodes[i].beginUs - fromUs_) &&
        (i + 1 == episodes.size() || us < static_cast<Real>(episodes[i + 1].beginUs - fromUs_));
    if (isNow && episodes[i].carrier >= 0) return isGuessed(episodes[i].carrier, us);
  }
  return false;
}

BothTriggers::Truth BothTriggers::truthOf(TriggerId trigger, BodyId body, LinkId link,
                                          Real us) const {
  Truth truth;
  const auto volume = both.oracle.partsAt(this->body(trigger), 0, fromUs_, us);
  std::vector<oracle::Corners<Real>> surface;
  for (const OraclePart& part : volume) {
    surface.push_back(oracle::cornersOf<Real>(part.corners));
  }
  int judged = -1;  // the last link that has triangles
  for (const OraclePart& part : both.oracle.partsAt(body, link, fromUs_, us)) {
    const auto axis = oracle::cornersOf<Real>(part.corners);
    if (part.count == 3 && std::exchange(judged, part.link) != part.link) {
      truth.separation =
          std::min(truth.separation,
                   both.oracle.separationAt(body, part.link, this->body(trigger), 0, fromUs_, us));
    }
    for (std::size_t i = 0; part.count == 2 && i < volume.size(); ++i) {
      const Real distance = oracle::closestPoints<Real>(axis[0], axis[1], surface[i]).distance;
      truth.separation = std::min(truth.separation, distance - static_cast<Real>(part.radius) -
                                                        static_cast<Real>(volume[i].radius));
    }
    if (areMeshes_[slotOf(trigger)] && std::abs(oracle::windingOf(axis[0], surface)) > 0.5L) {
      truth.isInside = true;
    }
  }
  return truth;
}

/// From the events alone.
std::vector<BothTriggers::Told> BothTriggers::toldOf(TriggerId trigger, BodyId body, LinkId link) {
  std::vector<Told> told;
  const auto after = [this](const WorldTime& time) { return microsecondsAfter(fromUs_, time); };
  bool isOpen = false;
  const auto close = [&](const TriggerEvent& event) {
    if (!isOpen) return say("something ends that had not begun");
    told.back().toUs = after(event.time);
    if (after(event.since) != told.back().fromUs) say("since is another instant");
    isOpen = false;
  };
  for (const TriggerEvent& event : events) {
    const bool isOne = event.trigger == trigger && event.body == body &&
                       (link == kEveryLink || event.link == link);
    if (!isOne) continue;
    const bool isEnd = event.kind == EventKind::Leave || event.kind == EventKind::UnresolvedTo;
    if (isEnd) {
      if (isOpen && told.back().isUnresolved != (event.kind == EventKind::UnresolvedTo)) {
        say("what ends is not what had begun");
      }
      close(event);
      continue;
    }
    const bool isUnresolved = event.kind == EventKind::UnresolvedFrom;
    if (isOpen && !(isUnresolved && !told.back().isUnresolved)) say("something begins twice");
    if (isOpen) told.back().toUs = after(event.time);
    told.push_back({after(event.time), static_cast<double>(untilUs_ - fromUs_), isUnresolved});
    isOpen = true;
  }
  return told;
}

void BothTriggers::judgeOne(TriggerId trigger, BodyId body, LinkId link,
                            const std::vector<Real>& instants) {
  const std::vector<Told> told = toldOf(trigger, body, link);
  const auto& episodes = both.oracle.bodies[slotOf(body)].episodes;
  const auto& ofTrigger = both.oracle.bodies[slotOf(this->body(trigger))].episodes;
  if (episodes.empty() || ofTrigger.empty()) return;
  const auto there =
      static_cast<Real>(std::max(episodes.front().beginUs, ofTrigger.front().beginUs) - fromUs_);
  for (const Real us : instants) {
    // Where somebody jumps, he is in two places.
    const auto isJump = [&](const OracleEpisode& episode) {
      return us != there && us == static_cast<Real>(episode.beginUs - fromUs_);
    };
    if (us < there || std::any_of(episodes.begin(), episodes.end(), isJump) ||
        std::any_of(ofTrigger.begin(), ofTrigger.end(), isJump) || isGuessed(body, us) ||
        isGuessed(this->body(trigger), us)) {
      continue;
    }
    const Truth truth = truthOf(trigger, body, link, us);
    bool isTold = false, isUnresolved = false;
    for (const Told& one : told) {
      if (us < one.fromUs || us > one.toUs) continue;
      (one.isUnresolved ? isUnresolved : isTold) = true;
    }
    ++tally.samples;
    tally.inside += isTold;
    tally.unresolved += isUnresolved;
    tally.whollyInside += truth.isInside && truth.separation > 2 * tolerance_;
    std::ostringstream at;
    at << "trigger " << trigger << ", body " << body << ", link " << link << " at " << us
       << " us: separation " << truth.separation << (truth.isInside ? ", inside" : "");
    // A millionth of a tolerance for the judge's own doubles.
    const bool isIn = truth.isInside || truth.separation < -1e-6L * tolerance_;
    if (isIn && !isTold && !isUnresolved) say(at.str() + ": not told");
    if (isTold && !truth.isInside && truth.separation > (2.0L + 1e-6L) * tolerance_) {
      say(at.str() + ": told, and is not");
    }
  }
}

void BothTriggers::judge(int instants) {
  std::vector<Real> at;
  const auto length = static_cast<Real>(untilUs_ - fromUs_);
  for (int i = 0; i <= instants; ++i) {
    at.push_back(length * static_cast<Real>(i) / static_cast<Real>(instants));
  }
  for (const TriggerEvent& event : events) {
    for (const double beside : {-1.0, -0.01, 0.0, 0.01, 1.0}) {
      const Real us = microsecondsAfter(fromUs_, event.time) + beside;
      if (us >= 0 && us <= length) at.push_back(us);
    }
  }
  for (TriggerId trigger = 0; trigger < triggers.numTriggers(); ++trigger) {
    for (BodyId one = 0; one < both.world.numBodies(); ++one) {
      if (triggers.triggerOf(one) >= 0) continue;
      const auto links = static_cast<LinkId>(both.oracle.bodies[slotOf(one)].parents.size());
      if (!options_[slotOf(trigger)].byLink) {
        judgeOne(trigger, one, kEveryLink, at);
        continue;
      }
      for (LinkId link = 0; link < links; ++link) judgeOne(trigger, one, link, at);
    }
  }
}

void BothTriggers::say(const std::string& what) {
  constexpr std::size_t kFew = 10;
  if (tally.problems.size() < kFew) tally.problems.push_back(what);
}

}  // namespace foretouch::test
