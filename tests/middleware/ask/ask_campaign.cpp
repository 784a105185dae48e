#include "tests/middleware/ask/ask_campaign.h"

#include <algorithm>
#include <sstream>

#include "tests/middleware/ask/ask_judge.h"
#include "tests/middleware/ask/asked_world.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr const char* kKinds[] = {"ray",          "sphere cast", "capsule cast", "overlap",
                                  "nearest",      "hull cast",   "hull overlap", "hull nearest",
                                  "point inside", "hull inside"};
constexpr int kFirstHull = 5, kPointInside = 8, kHullInside = 9;

AskWhat whatOf(int kind) {
  constexpr AskWhat kWhat[] = {
      AskWhat::Cast, AskWhat::Cast,    AskWhat::Cast,    AskWhat::Overlap, AskWhat::Nearest,
      AskWhat::Cast, AskWhat::Overlap, AskWhat::Nearest, AskWhat::Overlap, AskWhat::Overlap};
  return kWhat[kind];
}

WorldTime randomTime(Random& random) {
  const std::int64_t us = -5'000 + random.below(180'000);
  return {us, random.chance(0.4) ? 0.0 : random.uniform(0.0, 1.0)};
}

Vector3d randomDirection(Random& random) {
  Vector3d direction = random.direction();
  if (random.chance(0.2)) {
    direction = Vector3d::Zero();
    direction[random.below(3)] = random.chance(0.5) ? 1.0 : -1.0;
  }
  return random.magnitude(1e-3, 1e3) * direction;
}

/// A box, a wedge or loose corners; flat ones and single ones too.
std::vector<Vector3d> randomHull(Random& random) {
  if (random.chance(0.4)) return boxCorners(random.inBox(0.3).cwiseAbs(), random.rotation());
  const int flat = random.below(5);
  std::vector<Vector3d> corners;
  for (int i = random.below(8); i >= 0; --i) {
    corners.push_back(random.inBox(0.3));
    if (flat < 2) corners.back()[flat] = 0.0;
    if (!corners.empty() && random.chance(0.1)) corners.push_back(corners.front());
  }
  return corners;
}

void choosePlace(const std::vector<JudgedPart>& parts, int kind, Random& random,
                 WorldQuestion& question) {
  const bool hasRadius = kind != 0 && !random.chance(0.1);
  const Vector3d axis =
      kind == 1 || random.chance(0.2) ? Vector3d(Vector3d::Zero()) : random.arrow(0.0, 0.5);
  const Vector3d at = aimed(parts, random);
  question.shape.radius = hasRadius ? random.magnitude(1e-3, 0.3) : 0.0;
  question.direction = randomDirection(random);
  question.reach = random.chance(0.1) ? random.magnitude(1e-3, 1e6) : random.uniform(0.1, 6.0);
  const double back = question.what == AskWhat::Cast ? random.uniform(0.0, 3.0) : 0.0;
  question.shape.a = at - back * question.direction.normalized();
  const bool hasAxis = kind != 0 && kind < kFirstHull;
  question.shape.b = hasAxis ? Vector3d(question.shape.a + axis) : question.shape.a;
  if (kind == kPointInside) question.shape.radius = 0.0;
  if (kind >= kFirstHull && kind != kPointInside) {
    question.hull = randomHull(random);
    if (random.chance(0.7)) question.shape.radius = 0.0;
  }
  question.solids = kind == kPointInside || kind == kHullInside || random.chance(0.2);
  if (question.what == AskWhat::Overlap) question.reach = 0.0;
  if (question.what == AskWhat::Nearest && random.chance(0.3)) {
    question.shape.a += random.inBox(0.5);
    if (!hasAxis) question.shape.b = question.shape.a;
  }
}

void chooseFilter(const AskedWorld& world, Random& random, WorldQuestion& question) {
  const auto somePart = [&] {
    AskPart part;
    part.body = random.below(world.numBodies() + 1) - 1;
    if (part.body >= 0 && random.chance(0.4)) part.link = random.below(world.linksOf(part.body));
    if (random.chance(0.2)) part.object = random.below(3);
    return part;
  };
  if (random.chance(0.25)) question.groups = static_cast<std::uint32_t>(random.below(16));
  if (random.chance(0.15)) question.asksStill = false;
  for (int i = random.below(3); i > 0 && random.chance(0.5); --i) {
    question.without.push_back(somePart());
  }
  for (int i = random.below(4); i > 0 && random.chance(0.3); --i) {
    question.only.push_back(somePart());
  }
  for (BodyId body = 0; body < world.numBodies(); ++body) {
    if (random.chance(0.15)) question.instants.push_back({body, randomTime(random)});
  }
}

/// Every so many questions are asked again by a new memory.
constexpr int kAnewEvery = 8;

/// To the bit; but for any hit, which may be another one.
bool isSameAnew(const World& world, const WorldQuestion& question, const WorldAnswer& answer) {
  if (question.which == AskWhich::Any) return true;
  Scratch scratch;
  WorldAnswer anew;
  if (!askWorld(world, question, scratch, anew).ok()) return false;
  return std::equal(answer.hits.begin(), answer.hits.end(), anew.hits.begin(), anew.hits.end(),
                    [](const WorldHit& x, const WorldHit& y) {
                      return x.what.body == y.what.body && x.what.link == y.what.link &&
                             x.what.lss == y.what.lss && x.what.triangle == y.what.triangle &&
                             x.distance == y.distance && x.what.p_W == y.what.p_W &&
                             x.nhat_W == y.nhat_W && x.weights == y.weights;
                    });
}

void count(const AskedWorld& world, const WorldQuestion& question, const WorldAnswer& answer,
           const char* kind, AskTally& tally) {
  ++tally.questions[kind];
  if (!answer.hits.empty()) ++tally.hits[kind];
  if (answer.verdict() == AskVerdict::Unknown) ++tally.unknown;
  if (!question.only.empty() || !question.without.empty()) ++tally.filtered;
  for (const WorldHit& hit : answer.hits) {
    if (hit.what.triangle >= 0) ++tally.ofTriangles;
    if (hit.what.triangle >= 0 && world.hasSkin(hit.what.body)) ++tally.ofSkins;
    if (hit.what.lss >= 0 && hit.what.triangle < 0) ++tally.ofLss;
    if (hit.distance == 0.0) ++tally.starts;
    if (hit.what.lss < 0 && hit.what.triangle < 0) ++tally.inside;
    if (hit.what.body >= 0 && world.isCarried(hit.what.body)) ++tally.ofCarried;
  }
}

}  // namespace

AskTally judgeQuestions(std::uint64_t seed, int numQuestions, const AskTamper& tamper,
                        int firstKind) {
  Random random(seed);
  AskTally tally;
  AskedWorld world(random, true);
  Scratch scratch;
  WorldAnswer answer;
  WorldTime time;
  for (int i = 0; i < numQuestions; ++i) {
    const int kind = firstKind + random.below(kAskedKinds - firstKind);
    WorldQuestion question;
    question.what = whatOf(kind);
    question.which = static_cast<AskWhich>(random.below(3));
    if (random.chance(0.7)) time = randomTime(random);
    question.time = time;
    if (random.chance(0.5)) chooseFilter(world, random, question);
    const std::vector<JudgedPart> parts = world.partsAt(question);
    choosePlace(parts, kind, random, question);
    WorldQuestion asked = question;
    if (tamper.question) tamper.question(asked);
    const std::string whose = "seed " + std::to_string(seed) + ", question " + std::to_string(i) +
                              " (" + kKinds[kind] + ")";
    const std::size_t before = tally.problems.size();
    const auto done = askWorld(world.both().world, asked, scratch, answer);
    if (!done.ok()) {
      tally.problems.push_back(whose + ": " + describe(done.error()));
      continue;
    }
    if (i % kAnewEvery == 0 && !isSameAnew(world.both().world, asked, answer)) {
      tally.problems.emplace_back("another answer by a memory that has asked nothing yet");
    }
    if (tamper.answer) tamper.answer(answer);
    const AskJudge judge(question, parts);
    judge.judge(answer, tally);
    judge.judgeUnknown(answer, world.unknownAt(question), tally);
    tally.name(before, whose);
    count(world, question, answer, kKinds[kind], tally);
  }
  return tally;
}

void AskTally::add(const AskTally& more) {
  for (const auto& [kind, count] : more.questions) questions[kind] += count;
  for (const auto& [kind, count] : more.hits) hits[kind] += count;
  unknown += more.unknown;
  ofTriangles += more.ofTriangles;
  ofLss += more.ofLss;
  ofSkins += more.ofSkins;
  starts += more.starts;
  inside += more.inside;
  open += more.open;
  ofCarried += more.ofCarried;
  filtered += more.filtered;
  parts += more.parts;
  widest = std::max(widest, more.widest);
  problems.insert(problems.end(), more.problems.begin(), more.problems.end());
}

void AskTally::name(std::size_t from, const std::string& whose) {
  for (; from < problems.size(); ++from) problems[from] = whose + ": " + problems[from];
}

std::string summaryOf(const AskTally& tally) {
  std::ostringstream out;
  for (const auto& [kind, count] : tally.questions) {
    const auto hits = tally.hits.find(kind);
    out << kind << ": " << count << " questions, " << (hits == tally.hits.end() ? 0 : hits->second)
        << " with a hit\n";
  }
  out << "hits: " << tally.ofLss << " of LSS, " << tally.ofTriangles << " of triangles, "
      << tally.ofSkins << " of them of skins, " << tally.ofCarried << " of what is carried, "
      << tally.starts << " where they begin, " << tally.inside << " inside of objects; "
      << tally.open << " objects that are open\n"
      << tally.unknown << " unknown, " << tally.filtered << " filtered, " << tally.parts
      << " parts judged, largest gap at a hit " << static_cast<double>(tally.widest) << " m\n"
      << tally.problems.size() << " problems\n";
  return out.str();
}

}  // namespace foretouch::test
