#include "tests/middleware/ask/ask_campaign.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "tests/middleware/ask/ask_judge.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/world/random_worlds.h"
#include "tests/support/judged.h"
#include "tests/support/own_surface.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr const char* kKinds[] = {"ray", "sphere cast", "capsule cast", "overlap", "nearest"};

/// A world of both kinds, and what its bodies are.
class AskedWorld {
 public:
  explicit AskedWorld(Random& random)
      : still_(stillScene(random)), both_(still_, WorldOptions{1e-3}) {
    const int walkers = 1 + random.below(3);
    for (int i = 0; i < walkers; ++i) addWalker(random, i == 0 || random.chance(0.3));
    const int meshes = 1 + random.below(2);
    for (int i = 0; i < meshes; ++i) {
      const Scene mesh = clutterOf(random, 1 + random.below(12), 1 + random.below(3));
      const BodyId body = add(mesh, random);
      fly(both_, body, random.inBox(0.8), randomPeriod(random), kWindowUs, random);
    }
    if (random.chance(0.6)) addTool(random);
  }

  BothWorlds& both() { return both_; }
  [[nodiscard]] int numBodies() const { return both_.world.numBodies(); }
  [[nodiscard]] int linksOf(BodyId body) const {
    return static_cast<int>(both_.oracle.bodies[slotOf(body)].parents.size());
  }
  [[nodiscard]] bool isCarried(BodyId body) const { return body == tool_; }

  /// All parts that are known then, in W.
  [[nodiscard]] std::vector<JudgedPart> partsAt(const WorldQuestion& question) const;
  [[nodiscard]] std::vector<UnknownBody> unknownAt(const WorldQuestion& question) const;

 private:
  static Scene clutterOf(Random& random, int triangles, int objects) {
    RawScene raw = clutter(random, triangles, objects, Vector3d::Zero());
    for (Triangle& triangle : raw.triangles) {
      for (Vector3d& v : triangle.vertices) v *= 0.15;
    }
    return Scene::build(std::move(raw)).value();
  }
  static std::optional<Scene> stillScene(Random& random) {
    if (random.chance(0.2)) return std::nullopt;
    return Scene::build(clutter(random, 5 + random.below(60), 3, Vector3d::Zero())).value();
  }

  BodyOptions optionsOf(Random& random) {
    const WhenSilent silent[] = {WhenSilent::Wait, WhenSilent::HoldStill, WhenSilent::Undecided};
    BodyOptions options;
    options.group = random.below(4);
    options.whenSilent = silent[random.below(3)];
    options_.push_back(options);
    return options;
  }

  BodyId add(const Scene& mesh, Random& random) {
    meshes_.emplace_back(mesh);
    surfaces_.emplace_back();
    avatars_.emplace_back();
    return both_.add(mesh, optionsOf(random));
  }

  void addWalker(Random& random, bool hasSurface) {
    Walker walker = randomWalker(random, random.inBox(0.8), random.uniform(0.0, 0.1));
    BodyOptions options = optionsOf(random);
    if (hasSurface) options.surface = randomSurface(walker.avatar, random);
    meshes_.emplace_back();
    surfaces_.push_back(options.surface);
    avatars_.emplace_back(walker.avatar);
    const BodyId body = both_.add(walker.avatar, options);
    walk(both_, body, walker, randomPeriod(random), kWindowUs, random);
  }

  /// Held fast by a link of the first walker from an instant on; before, in a hand of nobody.
  void addTool(Random& random) {
    const Scene mesh = clutterOf(random, 1 + random.below(6), 1);
    tool_ = add(mesh, random);
    both_.push(tool_, 0, RigidPose{random.rotation(), random.inBox(0.5)});
    both_.push(tool_, 40'000, RigidPose{random.rotation(), random.inBox(0.5)});
    both_.attach(tool_, {0, random.below(linksOf(0)), false}, 40'000,
                 RigidPose{random.rotation(), random.inBox(0.1)});
  }

  void appendParts(BodyId body, const std::vector<oracle::OraclePart>& parts,
                   std::vector<JudgedPart>& all) const;
  [[nodiscard]] const OracleBody& bodyOf(BodyId body) const {
    return both_.oracle.bodies[slotOf(body)];
  }
  [[nodiscard]] std::optional<AskUnknown> whyUnknown(BodyId body, const WorldTime& time) const;

  std::optional<Scene> still_;
  BothWorlds both_;
  std::vector<BodyOptions> options_;
  std::vector<std::optional<Scene>> meshes_;
  std::vector<std::optional<AvatarSurface>> surfaces_;
  std::vector<std::optional<Avatar>> avatars_;
  BodyId tool_ = -1;
};

/// Of the body itself, and of who carries it; nothing if all is known.
std::optional<AskUnknown> AskedWorld::whyUnknown(BodyId body, const WorldTime& time) const {
  const std::vector<OracleEpisode>& episodes = bodyOf(body).episodes;
  if (time.us < episodes.front().beginUs) return AskUnknown::NotThere;
  std::size_t e = 0;
  while (e + 1 < episodes.size() && episodes[e + 1].beginUs <= time.us) ++e;
  const OracleEpisode& episode = episodes[e];
  if (episode.carrier >= 0) return whyUnknown(episode.carrier, time);  // held fast
  const WorldTime last{episode.times.back(), 0.0};
  if (!(last < time)) return std::nullopt;
  return options_[slotOf(body)].whenSilent == WhenSilent::HoldStill ? AskUnknown::Assumed
                                                                    : AskUnknown::Silent;
}

WorldTime timeOf(const WorldQuestion& question, BodyId body) {
  for (const AskInstant& instant : question.instants) {
    if (instant.body == body) return instant.time;
  }
  return question.time;
}

bool isInGroups(const WorldQuestion& question, BodyGroup group) {
  return (question.groups >> static_cast<unsigned>(group) & 1U) != 0;
}

std::vector<UnknownBody> AskedWorld::unknownAt(const WorldQuestion& question) const {
  std::vector<UnknownBody> unknown;
  for (BodyId body = 0; body < numBodies(); ++body) {
    if (!isInGroups(question, options_[slotOf(body)].group)) continue;
    const bool isOut =
        std::any_of(question.without.begin(), question.without.end(), [&](const AskPart& part) {
          return part.body == body && part.link == kEveryLink && part.object == kEveryObject;
        });
    const bool isIn = question.only.empty() ||
                      std::any_of(question.only.begin(), question.only.end(),
                                  [&](const AskPart& part) { return part.body == body; });
    if (isOut || !isIn) continue;
    const auto why = whyUnknown(body, timeOf(question, body));
    if (why) unknown.push_back({body, *why});
  }
  return unknown;
}

std::vector<JudgedPart> AskedWorld::partsAt(const WorldQuestion& question) const {
  std::vector<JudgedPart> all;
  for (std::size_t i = 0; still_ && i < still_->numTriangles(); ++i) {
    const auto id = static_cast<TriangleId>(i);
    JudgedPart part;
    part.side.triangle = id;
    part.object = still_->object(id);
    part.part = {0, 3, plain(still_->triangle(id)), 0.0};
    all.push_back(part);
  }
  for (BodyId body = 0; body < numBodies(); ++body) {
    if (!isInGroups(question, options_[slotOf(body)].group)) continue;
    const WorldTime time = timeOf(question, body);
    const auto why = whyUnknown(body, time);
    if (why && why != AskUnknown::Assumed) continue;
    const Real us = static_cast<Real>(time.us) + static_cast<Real>(time.fraction);
    appendParts(body, both_.oracle.partsAt(body, -1, 0, us), all);
  }
  return all;
}

/// In the order in which the judge was told of them: of each link LSS, then triangles.
void AskedWorld::appendParts(BodyId body, const std::vector<oracle::OraclePart>& parts,
                             std::vector<JudgedPart>& all) const {
  int link = -1;
  std::vector<std::int32_t> standing;  // LSS of the link that are their own surface
  std::size_t lss = 0;
  TriangleId triangle = 0;
  for (const oracle::OraclePart& part : parts) {
    if (part.link != link) {
      link = part.link;
      lss = 0;
      triangle = 0;
      standing.clear();
      if (!meshes_[slotOf(body)]) {
        const Avatar& avatar = *avatars_[slotOf(body)];
        for (std::size_t i = 0; i < avatar.lss(link).size(); ++i) {
          const auto& surface = surfaces_[slotOf(body)];
          const bool stands =
              !surface || standsForItself(avatar.lss(link)[i], surface->triangles(link));
          if (stands) standing.push_back(static_cast<std::int32_t>(i));
        }
      }
    }
    JudgedPart judged;
    judged.side.body = body;
    judged.side.link = link;
    judged.part = part;
    if (part.count == 3) {
      judged.side.triangle = triangle++;
      const auto& mesh = meshes_[slotOf(body)];
      if (mesh) judged.object = mesh->object(judged.side.triangle);
    } else {
      judged.side.lss = standing[lss++];
    }
    all.push_back(judged);
  }
}

WorldTime randomTime(Random& random) {
  const std::int64_t us = -5'000 + random.below(180'000);
  return {us, random.chance(0.4) ? 0.0 : random.uniform(0.0, 1.0)};
}

/// A point on or near some part; anywhere without parts.
Vector3d aimed(const std::vector<JudgedPart>& parts, Random& random) {
  if (parts.empty() || random.chance(0.15)) return random.inBox(1.5);
  const auto& part = parts[slotOf(random.below(static_cast<int>(parts.size())))].part;
  double weights[3] = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
  if (random.chance(0.2)) weights[0] = 0.0;  // an edge
  if (random.chance(0.1)) weights[1] = 0.0;  // and a corner
  const double sum = weights[0] + weights[1] + weights[2];
  Vector3d p = Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) p += weights[i] / sum * tools::rich(part.corners[i]);
  if (random.chance(0.3)) p += random.magnitude(1e-12, 0.2) * random.direction();
  // So that it grazes.
  if (random.chance(0.2)) p += part.radius * random.direction();
  return p;
}

Vector3d randomDirection(Random& random) {
  Vector3d direction = random.direction();
  if (random.chance(0.2)) {
    direction = Vector3d::Zero();
    direction[random.below(3)] = random.chance(0.5) ? 1.0 : -1.0;
  }
  return random.magnitude(1e-3, 1e3) * direction;
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
  question.shape.b = kind == 0 ? question.shape.a : Vector3d(question.shape.a + axis);
  if (question.what == AskWhat::Overlap) question.reach = 0.0;
  if (question.what == AskWhat::Nearest && random.chance(0.3)) {
    question.shape.a += random.inBox(0.5);
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

bool areAlike(const std::vector<UnknownBody>& x, const std::vector<UnknownBody>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [](const UnknownBody& one, const UnknownBody& other) {
                      return one.body == other.body && one.why == other.why;
                    });
}

void count(const AskedWorld& world, const WorldQuestion& question, const WorldAnswer& answer,
           const char* kind, AskTally& tally) {
  ++tally.questions[kind];
  if (!answer.hits.empty()) ++tally.hits[kind];
  if (answer.verdict() == AskVerdict::Unknown) ++tally.unknown;
  if (!question.only.empty() || !question.without.empty()) ++tally.filtered;
  for (const WorldHit& hit : answer.hits) {
    ++(hit.what.triangle >= 0 ? tally.ofTriangles : tally.ofLss);
    if (hit.distance == 0.0) ++tally.starts;
    if (hit.what.body >= 0 && world.isCarried(hit.what.body)) ++tally.ofCarried;
  }
}

}  // namespace

AskTally judgeQuestions(std::uint64_t seed, int numQuestions, const AskTamper& tamper) {
  Random random(seed);
  AskTally tally;
  AskedWorld world(random);
  Scratch scratch;
  WorldAnswer answer;
  WorldTime time;
  for (int i = 0; i < numQuestions; ++i) {
    const int kind = random.below(5);
    WorldQuestion question;
    question.what = kind == 3 ? AskWhat::Overlap : kind == 4 ? AskWhat::Nearest : AskWhat::Cast;
    question.which = static_cast<AskWhich>(random.below(3));
    if (random.chance(0.7)) time = randomTime(random);
    question.time = time;
    if (random.chance(0.5)) chooseFilter(world, random, question);
    const std::vector<JudgedPart> parts = world.partsAt(question);
    choosePlace(parts, kind, random, question);
    WorldQuestion asked = question;
    if (tamper.question) tamper.question(asked);
    const auto done = askWorld(world.both().world, asked, scratch, answer);
    if (!done.ok()) {
      tally.problems.push_back(describe(done.error()));
      continue;
    }
    if (tamper.answer) tamper.answer(answer);
    const std::size_t before = tally.problems.size();
    AskJudge(question, parts).judge(answer, tally);
    if (!areAlike(answer.unknown, world.unknownAt(question))) {
      tally.problems.emplace_back("unknown bodies differ");
    }
    for (std::size_t p = before; p < tally.problems.size(); ++p) {
      tally.problems[p] = "seed " + std::to_string(seed) + ", question " + std::to_string(i) +
                          " (" + kKinds[kind] + "): " + tally.problems[p];
    }
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
  starts += more.starts;
  ofCarried += more.ofCarried;
  filtered += more.filtered;
  parts += more.parts;
  widest = std::max(widest, more.widest);
  problems.insert(problems.end(), more.problems.begin(), more.problems.end());
}

std::string summaryOf(const AskTally& tally) {
  std::ostringstream out;
  for (const auto& [kind, count] : tally.questions) {
    const auto hits = tally.hits.find(kind);
    out << kind << ": " << count << " questions, " << (hits == tally.hits.end() ? 0 : hits->second)
        << " with a hit\n";
  }
  out << "hits: " << tally.ofLss << " of LSS, " << tally.ofTriangles << " of triangles, "
      << tally.ofCarried << " of what is carried, " << tally.starts << " where they begin\n"
      << tally.unknown << " unknown, " << tally.filtered << " filtered, " << tally.parts
      << " parts judged, largest gap at a hit " << static_cast<double>(tally.widest) << " m\n"
      << tally.problems.size() << " problems\n";
  return out.str();
}

}  // namespace foretouch::test
