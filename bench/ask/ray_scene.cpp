#include "bench/ask/ray_scene.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "articulated/try.h"
#include "bench/ask/asked_times.h"
#include "bench/inputs.h"
#include "bench/peers/peer_solvers.h"
#include "bench/ray_set.h"
#include "bench/scene.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "middleware/ask/ask.h"
#include "tools/portable_random.h"
#if FORETOUCH_HAS_EMBREE
#include "tests/reference/embree_triangles.h"
#endif

namespace foretouch::tools {
namespace {

/// Each ray is cast so often by each; its least time counts.
constexpr int kRepeats = 5;
constexpr double kSphereM = 0.1;

struct RayTimes {
  std::vector<double> us;
  std::uint64_t hits = 0;
};

std::vector<RaySegment> raysIn(const Scene& scene, int count, std::uint64_t seed) {
  PortableRandom random(seed);
  std::vector<RaySegment> rays(static_cast<std::size_t>(count));
  for (RaySegment& ray : rays) {
    ray.from = random.inBox(scene.audit().boxMin, scene.audit().boxMax);
    ray.to = random.inBox(scene.audit().boxMin, scene.audit().boxMax);
  }
  return rays;
}

template <typename Cast>
RayTimes timed(const std::vector<RaySegment>& rays, const Cast& cast) {
  RayTimes times;
  for (const RaySegment& ray : rays) {
    AskedTimes one;
    bool isHit = false;
    for (int i = 0; i < kRepeats; ++i) one.time([&] { isHit = cast(ray); });
    times.us.push_back(*std::min_element(one.us.begin(), one.us.end()));
    times.hits += isHit;
  }
  return times;
}

/// `peer`: the times of the peer beside it.
std::vector<BenchCell> rayRow(const char* name, const RayTimes& times, const RayTimes& peer) {
  const Percentiles us = percentilesOf(times.us), theirs = percentilesOf(peer.us);
  return {std::string(name),
          us.p50,
          us.p90,
          us.p99,
          us.mean,
          us.mean / theirs.mean,
          percent(times.hits, times.us.size())};
}

BenchTable rayTable(const Scene& scene) {
  return {"scene",
          "Rays through a room of " + std::to_string(scene.numTriangles()) + " triangles",
          {{"by", "by"},
           {"p50_us", "us p50", 2},
           {"p90_us", "p90", 2},
           {"p99_us", "p99", 2},
           {"mean_us", "mean", 2},
           {"ratio", "beside Embree, or of casts Bullet", 2},
           {"hit_percent", "with a hit %", 2}},
          {}};
}

}  // namespace

#if FORETOUCH_HAS_EMBREE
namespace {

/// Adds rays beside Embree, and casts of a sphere. Without Bullet in this build, nothing.
void addBullet([[maybe_unused]] const Scene& scene,
               [[maybe_unused]] const std::vector<RaySegment>& rays,
               [[maybe_unused]] const RayTimes& embree, [[maybe_unused]] const RayTimes& ours,
               [[maybe_unused]] BenchTable& table) {
#if FORETOUCH_HAS_PEERS
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    triangles.push_back(scene.triangle(static_cast<TriangleId>(i)));
  }
  const BulletCasts bullet(triangles);
  const auto castBy = [&](double radius) {
    return timed(rays, [&](const RaySegment& ray) {
      return bullet.first(ray.from, ray.to, radius).has_value();
    });
  };
  const RayTimes theirs = castBy(kSphereM);
  table.rows.push_back(rayRow("Bullet, closest (double)", castBy(0.0), embree));
  table.rows.push_back(rayRow("Bullet, sphere of 10 cm, cast (double)", theirs, theirs));
  table.rows.push_back(rayRow("World, sphere of 10 cm, cast (double, proven)", ours, theirs));
#endif
}

}  // namespace

Result<BenchTable> raySceneTable(int triangles, int questions, std::uint64_t seed) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs({}));
  FORETOUCH_TRY(const auto scene,
                Scene::build(subdivided(inputs.raw, static_cast<std::size_t>(triangles))));
  FORETOUCH_TRY(const auto world, World::build(scene));
  FORETOUCH_TRY(const auto embree, internal::EmbreeTriangles::build(scene));
  const auto rays = raysIn(scene, questions, seed);
  Scratch scratch;
  WorldAnswer answer;
  const auto ask = [&](const RaySegment& ray, AskWhich which, double radius = 0.0) {
    const Eigen::Vector3d way = ray.to - ray.from;
    WorldQuestion question = WorldQuestion::ray(ray.from, way, way.norm(), {});
    question.shape.radius = radius;
    question.which = which;
    static_cast<void>(askWorld(world, question, scratch, answer));
    return !answer.hits.empty();
  };
  const RayTimes occluded =
      timed(rays, [&](const RaySegment& ray) { return embree->rayOccluded(ray.from, ray.to); });
  const RayTimes nearest =
      timed(rays, [&](const RaySegment& ray) { return embree->rayHits(ray.from, ray.to); });
  const RayTimes any = timed(rays, [&](const RaySegment& ray) { return ask(ray, AskWhich::Any); });
  const RayTimes closest =
      timed(rays, [&](const RaySegment& ray) { return ask(ray, AskWhich::Closest); });
  const RayTimes casts =
      timed(rays, [&](const RaySegment& ray) { return ask(ray, AskWhich::Closest, kSphereM); });
  BenchTable table = rayTable(scene);
  table.rows = {rayRow("Embree, closest (float)", nearest, nearest),
                rayRow("World, closest (double, proven)", closest, nearest),
                rayRow("Embree, any (float)", occluded, occluded),
                rayRow("World, any (double, proven)", any, occluded)};
  addBullet(scene, rays, nearest, casts, table);
  return table;
}
#else
Result<BenchTable> raySceneTable(int /*triangles*/, int /*questions*/, std::uint64_t /*seed*/) {
  return Error::of(ErrorCode::DeviceFailed, "expected a build with Embree, whose rays these are");
}
#endif

}  // namespace foretouch::tools
