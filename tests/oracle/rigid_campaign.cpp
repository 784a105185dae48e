// tests/oracle/rigid_campaign.cpp: pairs are built around a near meeting, then answered and judged.
#include "tests/oracle/rigid_campaign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <Eigen/Dense>

#include "tests/reference/rigid_query.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using oracle::RigidPair;
using oracle::RigidProver;
using oracle::RigidSpan;

struct Draft {
  NlerpMotion motion;
  Triangle moving, fixed;
  double band = 0.0;
};

Vector3d placed(const NlerpMotion& m, double t, const Vector3d& p) {
  Quaternion q;
  q.coeffs() = m.q0.coeffs() + t * (m.q1.coeffs() - m.q0.coeffs());
  return m.x0 + t * (m.x1 - m.x0) + q.normalized() * p;
}

/// A random body and triangle; `turn` is the largest angle, radians below pi.
Draft drawPair(Random& random, double travel, double turn) {
  Draft d;
  const Vector3d center = random.inBox(1.0);
  for (Vector3d& v : d.moving.vertices) v = center + random.inBox(0.5);
  for (Vector3d& v : d.fixed.vertices) v = random.inBox(0.5);
  d.motion.q0 = random.rotation();
  d.motion.q1 = d.motion.q0 * random.turn(random.uniform(0.0, turn));
  if (d.motion.q0.dot(d.motion.q1) < 0) d.motion.q1.coeffs() *= -1;
  d.motion.q0.coeffs() *= random.uniform(0.6, 1.8);
  d.motion.q1.coeffs() *= random.uniform(0.6, 1.8);
  d.motion.x0 = random.inBox(1.0);
  d.motion.x1 = d.motion.x0 + random.inBox(travel);
  d.band = random.chance(0.5) ? 0.0 : random.magnitude(1e-9, 1e-2);
  return d;
}

Vector3d onTriangle(const Triangle& t, Random& random) {
  const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
  return t.vertices[0] + u * (t.vertices[1] - t.vertices[0]) + v * (t.vertices[2] - t.vertices[0]);
}

Vector3d onBorder(const Triangle& t, Random& random) {
  const auto i = static_cast<std::size_t>(random.below(3));
  const double u = random.chance(0.3) ? 0.0 : random.uniform(0, 1);
  return t.vertices[i] + u * (t.vertices[(i + 1) % 3] - t.vertices[i]);
}

/// A point of one border meets a point of the other triangle at t, but for `gap`.
void bringTogether(Draft& d, Random& random, double t, double gap) {
  const Vector3d inBody = onBorder(d.moving, random);
  const Vector3d target =
      random.chance(0.5) ? onTriangle(d.fixed, random) : onBorder(d.fixed, random);
  const Vector3d by = target + gap * random.direction() - placed(d.motion, t, inBody);
  d.motion.x0 += by;
  d.motion.x1 += by;
}

double gapOf(Random& random) {
  return random.magnitude(1e-15, 0.1);
}

Draft uniform(Random& random) {
  Draft d = drawPair(random, 1.0, 1.5);
  if (random.chance(0.5)) bringTogether(d, random, random.uniform(0, 1), 0.0);
  return d;
}

Draft gaps(Random& random) {
  Draft d = drawPair(random, random.magnitude(1e-3, 1.0), random.magnitude(1e-3, 1.5));
  // Mostly at an end of the motion, where the pair has been nearing or is about to part.
  const double t = random.chance(0.7) ? std::round(random.uniform(0, 1)) : random.uniform(0, 1);
  bringTogether(d, random, t, gapOf(random));
  return d;
}

Draft turning(Random& random) {
  Draft d = drawPair(random, random.chance(0.5) ? 0.0 : 0.2, 3.0);
  bringTogether(d, random, random.uniform(0, 1), gapOf(random));
  return d;
}

Draft slivers(Random& random) {
  Draft d = drawPair(random, 0.5, 1.5);
  for (Triangle* t : {&d.moving, &d.fixed}) {
    if (random.chance(0.3)) continue;
    t->vertices[2] = t->vertices[0] +
                     random.uniform(-0.2, 1.2) * (t->vertices[1] - t->vertices[0]) +
                     random.magnitude(1e-12, 1e-2) * random.direction();
  }
  bringTogether(d, random, random.uniform(0, 1), gapOf(random));
  return d;
}

/// Hardly any motion, or none.
Draft still(Random& random) {
  const double motion = random.chance(0.3) ? 0.0 : random.magnitude(1e-12, 1e-3);
  Draft d = drawPair(random, motion, motion);
  if (motion == 0.0) d.motion.q1 = d.motion.q0;
  bringTogether(d, random, random.uniform(0, 1), gapOf(random));
  return d;
}

Draft any(Random& random) {
  switch (random.below(4)) {
    case 0: return gaps(random);
    case 1: return turning(random);
    case 2: return slivers(random);
    default: return uniform(random);
  }
}

Draft far(Random& random) {
  Draft d = any(random);
  const Vector3d offset = random.magnitude(1.0, 1e6) * random.direction();
  for (Vector3d& v : d.fixed.vertices) v += offset;
  d.motion.x0 += offset;
  d.motion.x1 += offset;
  return d;
}

Draft scaled(Random& random) {
  Draft d = any(random);
  const double factor = random.magnitude(1e-4, 1e3);
  for (Triangle* t : {&d.moving, &d.fixed}) {
    for (Vector3d& v : t->vertices) v *= factor;
  }
  d.motion.x0 *= factor;
  d.motion.x1 *= factor;
  d.band *= factor;
  return d;
}

Vector3d rich(const oracle::Vec3d& v) {
  return {v.x, v.y, v.z};
}

RigidQuery finished(const Draft& d) {
  RigidQuery query;
  RigidPair& p = query.pair;
  p.x0 = plain(d.motion.x0);
  p.x1 = plain(d.motion.x1);
  p.q0 = {d.motion.q0.w(), d.motion.q0.x(), d.motion.q0.y(), d.motion.q0.z()};
  p.q1 = {d.motion.q1.w(), d.motion.q1.x(), d.motion.q1.y(), d.motion.q1.z()};
  for (std::size_t i = 0; i < 3; ++i) {
    p.moving[i] = plain(d.moving.vertices[i]);
    p.fixed[i] = plain(d.fixed.vertices[i]);
  }
  query.band = d.band;
  return query;
}

template <Draft (*draw)(Random&)>
RigidQuery query(Random& random) {
  return finished(draw(random));
}

RigidAnswer answerOf(const RigidQuery& query) {
  const RigidPair& p = query.pair;
  NlerpMotion motion;
  motion.x0 = rich(p.x0);
  motion.x1 = rich(p.x1);
  motion.q0 = {p.q0[0], p.q0[1], p.q0[2], p.q0[3]};
  motion.q1 = {p.q1[0], p.q1[1], p.q1[2], p.q1[3]};
  Triangle moving, fixed;
  for (std::size_t i = 0; i < 3; ++i) {
    moving.vertices[i] = rich(p.moving[i]);
    fixed.vertices[i] = rich(p.fixed[i]);
  }
  return rigidTrianglePair(motion, moving, fixed, query.band);
}

/// The largest |coordinate| of what is handed over, relative to the fixed triangle's first vertex;
/// the body's own points as they are.
double extentOf(const RigidPair& p) {
  double extent = 0.0;
  for (const auto& v : p.moving) extent = std::max(extent, oracle::extent(v));
  for (const auto& v : p.fixed) extent = std::max(extent, oracle::extent(v - p.fixed[0]));
  return std::max({extent, oracle::extent(p.x0 - p.fixed[0]), oracle::extent(p.x1 - p.fixed[0])});
}

std::string described(const RigidQuery& query, const std::string& name, const RigidAnswer& answer,
                      const char* finding, const RigidSpan& span) {
  std::array<char, 320> line{};
  std::snprintf(line.data(), line.size(),
                "%s: %s: answered %s [%a, %a] by stage %d; separation %g at %a\n", name.c_str(),
                finding, answer.leaf.hits ? "hit" : "miss", answer.leaf.toiLow, answer.leaf.toiHigh,
                static_cast<int>(answer.leaf.stage), static_cast<double>(span.separation),
                span.touching.value_or(-1.0));
  return line.data() + inHex(query);
}

/// Which promise is broken, if any.
enum class Broken { Nothing, Missed, Late, Early, Interval, Unproved };

Broken judgeMiss(RigidProver& prover, double band, RigidSpan& span) {
  span = prover.prove(0.0, 1.0, band);
  if (span.free) return Broken::Nothing;
  return span.touching ? Broken::Missed : Broken::Unproved;
}

Broken judgeHit(RigidProver& prover, const RigidQuery& query, const RigidAnswer& answer,
                RigidSpan& span, bool& near) {
  const LeafAnswer& leaf = answer.leaf;
  const bool isInterval = leaf.toiLow >= 0 && leaf.toiLow <= leaf.toiHigh && leaf.toiHigh <= 1 &&
                          leaf.toiHigh - leaf.toiLow <= kLeafTimeAccuracy;
  if (!isInterval) return Broken::Interval;
  const double most = query.band + rigidBand(extentOf(query.pair));
  if (answer.startsInContact && !prover.prove(0.0, 0.0, most).touching) return Broken::Early;
  if (!answer.startsInContact && prover.prove(0.0, 0.0, query.band).touching) return Broken::Late;
  if (leaf.toiLow > 0) {
    // [0, toiLow) is open: at toiLow itself contact is no lie.
    span = prover.prove(0.0, std::nextafter(leaf.toiLow, 0.0), query.band);
    if (!span.free) return span.touching ? Broken::Late : Broken::Unproved;
  }
  span = prover.prove(leaf.toiLow, leaf.toiHigh, query.band);
  if (span.touching) return Broken::Nothing;
  near = true;
  span = prover.prove(leaf.toiLow, leaf.toiHigh, most);
  if (span.touching) return Broken::Nothing;
  return span.free ? Broken::Early : Broken::Unproved;
}

void judgeOne(std::size_t family, std::uint64_t seed, std::uint64_t index, LeafTally& tally) {
  const std::string name = rigidFamilies()[family].name + " seed " + std::to_string(seed) +
                           " index " + std::to_string(index);
  judgeRigid(drawRigid(family, seed, index), name, tally);
}

}  // namespace

const std::vector<RigidFamily>& rigidFamilies() {
  static const std::vector<RigidFamily> families = {
      {"uniform", query<uniform>, 0.2, 0.8},  {"gaps", query<gaps>, 0.2, 0.95},
      {"turning", query<turning>, 0.2, 0.98}, {"slivers", query<slivers>, 0.2, 0.98},
      {"still", query<still>, 0.1, 0.9},      {"far", query<far>, 0.2, 0.95},
      {"scaled", query<scaled>, 0.2, 0.95},
  };
  return families;
}

RigidQuery drawRigid(std::size_t family, std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kMix = 0xd1342543de82ef95u;  // spreads what is mixed; any odd number
  Random random((seed * kMix + family + 1000) * kMix + index);
  return rigidFamilies()[family].draw(random);
}

std::string inHex(const RigidQuery& query) {
  const RigidPair& p = query.pair;
  std::array<char, 256> row{};
  std::string text;
  const auto add = [&](const oracle::Vec3d& v) {
    std::snprintf(row.data(), row.size(), "%a %a %a\n", v.x, v.y, v.z);
    text += row.data();
  };
  add(p.x0);
  add(p.x1);
  for (const auto& q : {p.q0, p.q1}) {
    std::snprintf(row.data(), row.size(), "%a %a %a %a\n", q[0], q[1], q[2], q[3]);
    text += row.data();
  }
  for (const auto& v : p.moving) add(v);
  for (const auto& v : p.fixed) add(v);
  std::snprintf(row.data(), row.size(), "%a\n", query.band);
  return text + row.data();
}

void judgeRigid(const RigidQuery& query, const std::string& name, LeafTally& tally) {
  const RigidAnswer answer = answerOf(query);
  RigidProver prover(query.pair);
  RigidSpan span;
  bool near = false;
  const Broken broken = answer.leaf.hits ? judgeHit(prover, query, answer, span, near)
                                         : judgeMiss(prover, query.band, span);
  ++tally.queries;
  ++tally.stages[static_cast<std::size_t>(answer.leaf.stage)];
  tally.hardTruths += span.wideLooks > 0 ? 1 : 0;
  tally.nearHits += near && broken == Broken::Nothing ? 1 : 0;
  tally.trueHits += broken == Broken::Missed || broken == Broken::Late ||
                            (answer.leaf.hits && !near && broken == Broken::Nothing)
                        ? 1
                        : 0;
  switch (broken) {
    case Broken::Nothing: break;
    case Broken::Missed:
      tally.fail(tally.falseNegatives, described(query, name, answer, "missed", span));
      break;
    case Broken::Late:
      tally.fail(tally.wrongTimes, described(query, name, answer, "late", span));
      break;
    case Broken::Interval:
      tally.fail(tally.wrongTimes, described(query, name, answer, "no interval", span));
      break;
    case Broken::Early:
      tally.fail(tally.falsePositives, described(query, name, answer, "early", span));
      break;
    case Broken::Unproved:
      tally.fail(tally.unproved, described(query, name, answer, "unproved", span));
      break;
  }
}

std::vector<LeafTally> judgeRigid(const LeafJob& job) {
  return judgeFamilies(rigidFamilies().size(), job, judgeOne);
}

}  // namespace foretouch::test
