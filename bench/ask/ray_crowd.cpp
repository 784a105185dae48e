#include "bench/ask/ray_crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bench/ask/asked_times.h"
#include "bench/solid/cells.h"
#include "bench/surface.h"
#include "bench/timing.h"
#include "lss/index.h"
#include "middleware/ask/ask.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kCrowdPoseHz = 60.0, kApartM = 5.0, kNearestRayM = 5.0, kFarthestRayM = 60.0;
constexpr std::int64_t kRememberedUs = 1'000'000;
constexpr std::size_t kSurfaceTriangles = 20'000;
/// Corners nearer to the joint follow the link above it, too.
constexpr double kBlendedM = 0.15;

enum class CrowdBy { Lss, Triangles, Skin };

std::string nameOf(CrowdBy by) {
  if (by == CrowdBy::Lss) return "LSS";
  return std::to_string(kSurfaceTriangles) +
         (by == CrowdBy::Skin ? " skinned triangles" : " triangles");
}

/// The triangles around the LSS, whose corners follow two links near the joint between them.
SkinnedSurface blendedSkin(const Avatar& avatar) {
  const auto triangles = lssSkins(avatar, kSurfaceTriangles);
  Skin skin;
  std::vector<std::size_t> counts;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const Skeleton& skeleton = avatar.skeleton();
    const JointId parent = skeleton.parent(link);
    counts.push_back(triangles[slotOf(link)].size());
    for (const Triangle& triangle : triangles[slotOf(link)]) {
      std::array<std::int32_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d& p = triangle.vertices[i];
        const double share = parent == kNoParent ? 0.0 : 0.5 * (1.0 - p.norm() / kBlendedM);
        std::vector<SkinInfluence> shares{{link, 1.0 - std::max(0.0, share), p}};
        if (share > 0.0) {
          shares.push_back(
              {parent, share, skeleton.restOffset(link) + skeleton.restRotation(link) * p});
        }
        corners[i] = static_cast<std::int32_t>(skin.vertices.size());
        skin.vertices.push_back(std::move(shares));
      }
      skin.triangles.push_back(corners);
    }
  }
  return SkinnedSurface::build(avatar, std::move(skin), counts).value();
}

/// A crowd with a second of poses.
struct RememberedCrowd {
  World world = World::build(std::nullopt).value();
  std::vector<Vector3d> places;  ///< About where their roots are.

  std::string by;  ///< What questions meet.

  RememberedCrowd(const std::vector<Person>& people, CrowdBy made) : by(nameOf(made)) {
    for (const Person& person : people) {
      const Avatar& avatar = person.clip->actor->avatar;
      BodyOptions options;
      if (made == CrowdBy::Triangles) {
        options.surface = AvatarSurface::build(avatar, lssSkins(avatar, kSurfaceTriangles)).value();
        options.surface->prepare();
      }
      if (made == CrowdBy::Skin) options.skin = blendedSkin(avatar);
      const BodyId body = world.add(avatar, options).value();
      for (std::int64_t k = 0; person.instant(k) <= kRememberedUs + person.clip->periodUs; ++k) {
        static_cast<void>(world.push(body, person.instant(k), person.pose(k)));
      }
      places.push_back(person.pose(0).translations[0]);
    }
  }
};

/// When questions are asked.
enum class AskedWhen { OneInstant, OwnInstants, OwnOfBodies };
constexpr std::pair<AskedWhen, const char*> kAskedWhens[] = {
    {AskedWhen::OneInstant, "one instant"},
    {AskedWhen::OwnInstants, "own instants"},
    {AskedWhen::OwnOfBodies, "own instants of bodies"}};

struct AskedKind {
  const char* name;
  double radius;
  AskWhat what;
  AskWhich which;
};
constexpr AskedKind kAskedKinds[] = {
    {"ray", 0.0, AskWhat::Cast, AskWhich::Closest},
    {"ray, all in order", 0.0, AskWhat::Cast, AskWhich::All},
    {"sphere of 10 cm, cast", 0.1, AskWhat::Cast, AskWhich::Closest},
    {"sphere of 10 cm, overlap", 0.1, AskWhat::Overlap, AskWhich::All},
    {"nearest within 1 m", 0.0, AskWhat::Nearest, AskWhich::Closest}};

/// A question aimed at a person, from afar.
WorldQuestion questionOf(const RememberedCrowd& crowd, const AskedKind& kind,
                         PortableRandom& random) {
  const auto n = static_cast<std::size_t>(random.next() % crowd.places.size());
  const Vector3d aim =
      crowd.places[n] + random.inBox(Vector3d(-0.3, -0.5, -0.3), Vector3d(0.3, 0.6, 0.3));
  const double turn = random.uniform(0.0, 6.28), away = random.uniform(kNearestRayM, kFarthestRayM);
  const Vector3d from = aim + away * Vector3d(std::cos(turn), 0.02, std::sin(turn));
  WorldQuestion question;
  question.what = kind.what;
  question.which = kind.which;
  const Vector3d begin = kind.what == AskWhat::Cast ? from : aim;
  question.shape = {begin, begin, kind.radius};
  question.direction = aim - from;
  question.reach = kind.what == AskWhat::Nearest ? 1.0 : 100.0;
  return question;
}

WorldTime anyInstant(PortableRandom& random) {
  return {static_cast<std::int64_t>(random.uniform(0.0, 1e6)), random.uniform(0.0, 1.0)};
}

std::vector<BenchCell> crowdRow(const RememberedCrowd& crowd, const AskedKind& kind, AskedWhen when,
                                const char* whenSaid, int questions, std::uint64_t seed) {
  PortableRandom random(seed);
  Scratch scratch;
  WorldAnswer answer;
  AskedTimes times;
  std::vector<double> ofHits;
  constexpr int kWarm = 200;
  const WorldTime one = anyInstant(random);
  for (int i = 0; i < kWarm + questions; ++i) {
    WorldQuestion question = questionOf(crowd, kind, random);
    question.time = when == AskedWhen::OneInstant ? one : anyInstant(random);
    if (when == AskedWhen::OwnOfBodies) {
      for (std::size_t body = 0; body < crowd.places.size(); ++body) {
        question.instants.push_back({static_cast<BodyId>(body), anyInstant(random)});
      }
    }
    if (i == kWarm) times.us.clear();
    times.time([&] { static_cast<void>(askWorld(crowd.world, question, scratch, answer)); });
    if (i >= kWarm && !answer.hits.empty()) ofHits.push_back(times.us.back());
  }
  const Percentiles us = percentilesOf(times.us);
  const auto hits = static_cast<std::uint64_t>(ofHits.size());
  return {static_cast<std::int64_t>(crowd.places.size()),
          crowd.by,
          std::string(kind.name),
          std::string(whenSaid),
          us.p50,
          us.p90,
          us.p99,
          us.mean,
          percentilesOf(ofHits).p50,
          percent(hits, static_cast<std::uint64_t>(questions))};
}

}  // namespace

BenchTable rayCrowdTable(const Cast& cast, const std::vector<int>& avatars, int questions,
                         std::uint64_t seed) {
  BenchTable table{"crowd",
                   "Questions to a crowd with a second of memory",
                   {{"avatars", "avatars", 0},
                    {"by", "that touch by"},
                    {"kind", "question"},
                    {"when", "asked at"},
                    {"p50_us", "us p50", 2},
                    {"p90_us", "p90", 2},
                    {"p99_us", "p99", 2},
                    {"mean_us", "mean", 2},
                    {"hit_us", "p50 of those that hit", 2},
                    {"hit_percent", "with a hit %", 1}},
                   {}};
  const auto clips = clipPosesOf(cast, kCrowdPoseHz);
  const auto addRows = [&](const RememberedCrowd& crowd) {
    for (const AskedKind& kind : kAskedKinds) {
      for (const auto& [when, said] : kAskedWhens) {
        table.rows.push_back(crowdRow(crowd, kind, when, said, questions, seed));
      }
    }
  };
  addRows(RememberedCrowd(crowdOf(clips, 1, kApartM), CrowdBy::Triangles));
  addRows(RememberedCrowd(crowdOf(clips, 1, kApartM), CrowdBy::Skin));
  for (const int count : avatars) {
    addRows(RememberedCrowd(crowdOf(clips, count, kApartM), CrowdBy::Lss));
  }
  return table;
}

}  // namespace foretouch::tools
