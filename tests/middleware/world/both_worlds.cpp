#include "tests/middleware/world/both_worlds.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "middleware/world/world_parts.h"
#include "tests/support/own_surface.h"

namespace foretouch::test {
namespace {

/// The judge's places and the product's, in doubles.
constexpr Real kPlaces = 1e-9L;

std::vector<OraclePlace> placesOf(const Pose& pose) {
  std::vector<OraclePlace> places;
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    places.push_back({plain(pose.rotations[j]), plain(pose.translations[j])});
  }
  return places;
}

Pose poseOf(const RigidPose& rigid) {
  return {{rigid.rotation}, {rigid.translation}};
}

OracleBody rigidBody(const Scene& mesh) {
  OracleBody body;
  body.parents = {-1};
  for (std::size_t i = 0; i < mesh.numTriangles(); ++i) {
    body.parts.push_back({0, 3, plain(mesh.triangle(static_cast<TriangleId>(i))), 0.0});
  }
  return body;
}

template <typename T>
T valueOf(Result<T> result) {
  EXPECT_TRUE(result.ok()) << describe(result.error());
  return std::move(result).value();
}

}  // namespace

BothWorlds::BothWorlds(double tolerance) : BothWorlds(std::nullopt, WorldOptions{tolerance}) {}

BothWorlds::BothWorlds(const std::optional<Scene>& still, const WorldOptions& options)
    : world(valueOf(World::build(still, options))), tolerance_(options.tolerance) {
  if (still) still_ = rigidBody(*still);
}

BodyId BothWorlds::add(const Avatar& avatar, const BodyOptions& options) {
  OracleBody body;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    body.parents.push_back(avatar.skeleton().parent(link));
    for (const Lss& lss : avatar.lss(link)) {
      if (options.surface && !standsForItself(lss, options.surface->triangles(link))) continue;
      body.parts.push_back({link, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius});
    }
    if (!options.surface) continue;
    for (const Triangle& triangle : options.surface->triangles(link)) {
      body.parts.push_back({link, 3, plain(triangle), 0.0});
    }
  }
  oracle.bodies.push_back(body);
  return valueOf(world.add(avatar, options));
}

BodyId BothWorlds::add(const Scene& mesh, const BodyOptions& options) {
  oracle.bodies.push_back(rigidBody(mesh));
  return valueOf(world.add(mesh, options));
}

OracleEpisode& BothWorlds::episode(BodyId body, std::int64_t utimeUs) {
  std::vector<OracleEpisode>& episodes = oracle.bodies[slotOf(body)].episodes;
  if (episodes.empty()) episodes.push_back({utimeUs, -1, 0, {}, {}});
  return episodes.back();
}

void BothWorlds::push(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  valueOf(world.push(body, utimeUs, pose));
  OracleEpisode& last = episode(body, utimeUs);
  last.times.push_back(utimeUs);
  last.poses.push_back(placesOf(pose));
}

void BothWorlds::push(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  push(body, utimeUs, poseOf(pose));
}

void BothWorlds::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                        const Pose& pose) {
  valueOf(world.attach(body, carrier, utimeUs, pose));
  if (!carrier.movesInFrame) heldFast_.insert({body, carrier.body, carrier.link});
  oracle.bodies[slotOf(body)].episodes.push_back(
      {utimeUs, carrier.body, carrier.link, {utimeUs}, {placesOf(pose)}});
}

void BothWorlds::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                        const RigidPose& pose) {
  attach(body, carrier, utimeUs, poseOf(pose));
}

void BothWorlds::detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  valueOf(world.detach(body, utimeUs, pose));
  oracle.bodies[slotOf(body)].episodes.push_back(
      {utimeUs, -1, 0, {utimeUs}, {placesOf(poseOf(pose))}});
}

void BothWorlds::ask(std::int64_t fromUs, std::int64_t toUs) {
  const auto asked = world.contacts(fromUs, toUs, scratch, answer);
  ASSERT_TRUE(asked.ok()) << describe(asked.error());
  if (tamper) tamper(answer);
}

bool BothWorlds::hasParts(BodyId body, LinkId link) const {
  const std::vector<OraclePart>& parts = oracle.bodies[slotOf(body)].parts;
  return std::any_of(parts.begin(), parts.end(),
                     [link](const OraclePart& part) { return part.link == link; });
}

bool BothWorlds::areJoined(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB) const {
  const auto hangsOn = [this](BodyId carried, LinkId link, BodyId carrier, LinkId holding) {
    const OracleBody& body = oracle.bodies[slotOf(carried)];
    const bool isHeld = heldFast_.count({carried, carrier, holding}) != 0;
    return (body.parents[slotOf(link)] < 0 || isHeld) &&
           std::any_of(body.episodes.begin(), body.episodes.end(), [&](const OracleEpisode& e) {
             return e.carrier == carrier && e.link == holding;
           });
  };
  return hangsOn(a, linkOfA, b, linkOfB) || hangsOn(b, linkOfB, a, linkOfA);
}

void BothWorlds::judge(BodyId a, BodyId b, std::int64_t fromUs, std::int64_t toUs) {
  ask(fromUs, toUs);
  judgePair(a, b, fromUs, toUs);
}

void BothWorlds::judgePair(BodyId a, BodyId b, std::int64_t fromUs, std::int64_t toUs) {
  const std::size_t linksOfA = oracle.bodies[slotOf(a)].parents.size();
  const std::size_t linksOfB = oracle.bodies[slotOf(b)].parents.size();
  constexpr std::size_t kFewPairs = 100;  // faster one by one
  const std::vector<bool> may = linksOfA * linksOfB <= kFewPairs
                                    ? std::vector<bool>(linksOfA * linksOfB, true)
                                    : oracle.mayTouch(a, b, fromUs, toUs);
  for (std::size_t i = 0; i < linksOfA; ++i) {
    for (std::size_t j = 0; j < linksOfB; ++j) {
      const auto one = static_cast<LinkId>(i), other = static_cast<LinkId>(j);
      if (!hasParts(a, one) || !hasParts(b, other) || areJoined(a, one, b, other)) continue;
      // Proven apart: whatever is listed must be a graze within the tolerance.
      const OracleTouch apart{OracleOutcome::Free, static_cast<Real>(toUs - fromUs)};
      const OracleTouch truth =
          may[i * linksOfB + j] ? oracle.firstTouch(a, one, b, other, fromUs, toUs) : apart;
      judgeLinks(a, one, b, other, fromUs, truth);
    }
  }
}

void BothWorlds::judgeAll(std::int64_t fromUs, std::int64_t toUs) {
  ask(fromUs, toUs);
  for (BodyId a = 0; a < world.numBodies(); ++a) {
    for (BodyId b = a + 1; b < world.numBodies(); ++b) judgePair(a, b, fromUs, toUs);
    judgeStill(a, fromUs, toUs);
    const std::optional<PairRules>& own = world.parts().body(a).options.self;
    if (own) judgeOwn(a, *own, fromUs, toUs);
  }
}

void BothWorlds::judgeStill(BodyId body, std::int64_t fromUs, std::int64_t toUs) {
  if (!world.parts().isStillAsked(body)) return;
  oracle.bodies.push_back(still_);
  oracle.bodies.back().episodes = {{fromUs, -1, 0, {fromUs}, {{OraclePlace()}}}};
  const int still = placeInOracle(kStillScene);
  for (LinkId link = 0; link < world.parts().kindOf(body).skeleton.numJoints(); ++link) {
    if (!hasParts(body, link)) continue;
    judgeLinks(body, link, kStillScene, 0, fromUs,
               oracle.firstTouch(body, link, still, 0, fromUs, toUs));
  }
  oracle.bodies.pop_back();
}

int BothWorlds::placeInOracle(BodyId body) const {
  return body == kStillScene ? static_cast<int>(oracle.bodies.size()) - 1 : body;
}

void BothWorlds::judgeOwn(BodyId body, const PairRules& rules, std::int64_t fromUs,
                          std::int64_t toUs) {
  for (LinkId one = 0; one < rules.numLinks(); ++one) {
    for (LinkId other = one + 1; other < rules.numLinks(); ++other) {
      if (!hasParts(body, one) || !hasParts(body, other)) continue;
      if (rules.reasonOf(one, other) != PairReason::Asked) continue;
      judgeLinks(body, one, body, other, fromUs,
                 oracle.firstTouch(body, one, body, other, fromUs, toUs));
    }
  }
}

/// Empty: the answer keeps the promise.
std::string BothWorlds::problemOf(const WorldContact& contact, const OracleTouch& truth,
                                  std::int64_t fromUs) const {
  const Real at = static_cast<Real>(contact.time.us - fromUs) + contact.time.fraction;
  const ContactSide &a = contact.a, &b = contact.b;
  const int other = placeInOracle(b.body);
  const Real gap = oracle.separationAt(a.body, a.link, other, b.link, fromUs, at);
  // The first instant within a nanometre: what is free is at least an eighth of the tolerance
  // apart, unless the window begins there.
  if (at > truth.time + Real(1e-9L)) return "late";
  if (contact.verdict == Verdict::Undecided) return "undecided";
  if (contact.verdict == Verdict::StartsInContact) return gap > 1e-11L ? "wrong start" : "";
  if (gap > static_cast<Real>(tolerance_) * (1 + Real(1e-9L))) return "early";
  if (std::abs(gap - static_cast<Real>(contact.separation)) > kPlaces) return "separation";
  const Real off = std::max(oracle.distanceToSurface(a.body, a.link, plain(a.p_W), fromUs, at),
                            oracle.distanceToSurface(other, b.link, plain(b.p_W), fromUs, at));
  if (off > kPlaces) return "witness points";
  const Eigen::Vector3d between = a.p_W - b.p_W;
  if (std::abs(between.norm() - contact.separation) > 1e-9) return "points and separation";
  if (contact.separation > 1e-7 && between.normalized().dot(contact.nhat_BA_W) < 0.999) {
    return "normal";
  }
  return "";
}

void BothWorlds::judgeLinks(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB, std::int64_t fromUs,
                            const OracleTouch& truth) {
  if (truth.outcome == OracleOutcome::Uncertain) ++tally.grazing;
  const auto listed =
      std::find_if(answer.contacts.begin(), answer.contacts.end(), [&](const WorldContact& c) {
        return c.a.body == a && c.a.link == linkOfA && c.b.body == b && c.b.link == linkOfB;
      });
  std::ostringstream what;
  what << "bodies " << a << ", " << b << ", links " << linkOfA << ", " << linkOfB << ", truth "
       << static_cast<int>(truth.outcome) << " at " << static_cast<double>(truth.time) << ": ";
  if (listed == answer.contacts.end()) {
    ++tally.clear;
    if (truth.outcome == OracleOutcome::Touch) problems.push_back(what.str() + "missed");
    return;
  }
  switch (listed->verdict) {
    case Verdict::Contact: ++tally.contact; break;
    case Verdict::StartsInContact: ++tally.start; break;
    default: ++tally.undecided; break;
  }
  const std::string problem = problemOf(*listed, truth, fromUs);
  what << toString(listed->verdict) << " at " << microsecondsAfter(fromUs, listed->time) << ": ";
  if (!problem.empty()) problems.push_back(what.str() + problem);
}

}  // namespace foretouch::test
