#include "bench/world/exact.h"

#include <string>
#include <utility>

#include "bench/body.h"
#include "bench/solid/feel.h"
#include "bench/surface.h"
#include "bench/world/timed_world.h"

namespace foretouch::tools {
namespace {

constexpr int kMannequinLinks = 15;
constexpr std::size_t kMannequinTriangles = 20'000;
constexpr int kWindows = 150;

struct Mannequin {
  SolidActor actor;
  AvatarSurface surface;
};

/// One per actor: his body with fewer links, and skins of its LSS.
std::vector<Mannequin> mannequinsOf(const Cast& cast) {
  std::vector<Mannequin> mannequins;
  for (const SolidActor& actor : cast.actors) {
    SolidActor own = actor;
    own.avatar = bodyWithLinks(actor.avatar, kMannequinLinks).value().avatar;
    auto surface =
        AvatarSurface::build(own.avatar, lssSkins(own.avatar, kMannequinTriangles)).value();
    surface.prepare();
    mannequins.push_back({std::move(own), std::move(surface)});
  }
  return mannequins;
}

/// The poses of the actors that the mannequins are made of.
std::vector<ClipPoses> posesOf(const Cast& cast, const std::vector<Mannequin>& mannequins,
                               double rateHz) {
  std::vector<ClipPoses> all = clipPosesOf(cast, rateHz);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BenchBody body = bodyWithLinks(cast.actors[i].avatar, kMannequinLinks).value();
    for (Pose& pose : all[i].poses) pose = poseOfBody(body, pose, 0.0);
    all[i].actor = &mannequins[i].actor;
  }
  return all;
}

enum class ExactCase { Alone, Own, Together, ByLss };

WindowFigures figuresOf(const std::vector<Mannequin>& mannequins,
                        const std::vector<ClipPoses>& clips, double spacing, ExactCase which) {
  WindowFigures figures;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const std::size_t j = (i + 1) % clips.size();
    auto people = crowdOf({clips[i], clips[j]}, 2, spacing);
    people[0].clip = &clips[i];
    people[1].clip = &clips[j];
    TimedWorld world;
    world.figures = std::move(figures);
    for (const Person& person : people) {
      const auto own = static_cast<std::size_t>(person.clip - clips.data());
      BodyOptions options;
      if (which != ExactCase::ByLss) options.surface = mannequins[own].surface;
      if (which == ExactCase::Own)
        options.self = PairRules::derive(person.clip->actor->avatar).value();
      static_cast<void>(world.add(person, options));
    }
    if (which == ExactCase::Alone || which == ExactCase::Own) {
      static_cast<void>(world.world().ask(0, 0, false));
    }
    CrowdWindows windows;
    windows.windowUs = clips[i].periodUs;
    windows.counted = kWindows;
    runCrowd(people, windows, world);
    figures = std::move(world.figures);
  }
  return figures;
}

}  // namespace

BenchTable exactTable(const Cast& cast) {
  BenchTable table{"exact",
                   "Two mannequins of 15 links and 20,000 triangles each, triangles against "
                   "triangles; per window, beside both alone",
                   {{"distance_m", "m apart", 1},
                    {"rate_hz", "Hz", 0},
                    {"windows", "windows", 0},
                    {"with_us", "both us", 2},
                    {"alone_us", "alone us", 2},
                    {"pair_us", "each other us", 2},
                    {"with_p99_us", "both p99", 1},
                    {"lss_us", "each other by LSS us", 2},
                    {"own_us", "own links us per body", 2},
                    {"own_starts", "that go on", 2},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2},
                    {"part_steps", "pairs in lanes", 0},
                    {"advancements", "in doubles", 0}},
                   {}};
  const std::vector<Mannequin> mannequins = mannequinsOf(cast);
  for (const double rateHz : {30.0, 5.0}) {
    const auto clips = posesOf(cast, mannequins, rateHz);
    for (const double spacing : {0.5, 0.9, 5.0}) {
      const auto at = [&](ExactCase which) { return figuresOf(mannequins, clips, spacing, which); };
      const WindowFigures both = at(ExactCase::Together);
      const WindowFigures own = at(ExactCase::Own);
      const double alone = percentilesOf(at(ExactCase::Alone).answerUs).mean,
                   byLss = percentilesOf(at(ExactCase::ByLss).answerUs).mean;
      const Percentiles us = percentilesOf(both.answerUs);
      table.rows.push_back({spacing, rateHz, static_cast<std::int64_t>(both.windows()), us.mean,
                            alone, us.mean - alone, us.p99, byLss - alone,
                            0.5 * (percentilesOf(own.answerUs).mean - alone),
                            0.5 * own.perWindow(own.starts), both.perWindow(both.contacts),
                            both.perWindow(both.starts), both.perWindow(both.sum.queries.partSteps),
                            both.perWindow(both.sum.queries.advancements)});
    }
  }
  return table;
}

}  // namespace foretouch::tools
