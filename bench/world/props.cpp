#include "bench/world/props.h"

#include <cmath>
#include <functional>
#include <string>

#include "bench/world/timed_world.h"
#include "lss/index.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kFullTurn = 6.283185307179586;
constexpr int kAround = 100, kAcross = 50;  // 10,000 triangles
constexpr int kThrows = 40;
constexpr double kThrowSeconds = 0.6, kThrowSpeed = 3.0, kSpin = 6.0;  // m/s, rad/s

/// A torus about z.
Scene torus(double radius, double thickness) {
  const auto at = [&](int i, int j) {
    const double u = kFullTurn * i / kAround, v = kFullTurn * j / kAcross;
    const double out = radius + thickness * std::cos(v);
    return Vector3d(out * std::cos(u), out * std::sin(u), thickness * std::sin(v));
  };
  RawScene raw;
  raw.objectNames = {"ring"};
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      raw.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      raw.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

/// Where the prop is.
using PropAt = std::function<foretouch::RigidPose(double s)>;

/// One stretch of a person and the prop; windows count from the second one on.
struct Stretch {
  Person person;
  double rateHz = 30.0, seconds = kThrowSeconds;
  PropAt at;            ///< Not for one that is held.
  bool isHeld = false;  ///< In the right hand, or in the last link.
  bool hasProp = true;
};

void run(const Stretch& stretch, const Scene& prop, WindowFigures& figures) {
  TimedWorld world;
  const BodyId body = world.add(stretch.person, false);
  const auto periodUs = static_cast<std::int64_t>(std::llround(1e6 / stretch.rateHz));
  const int windows = static_cast<int>(std::lround(stretch.seconds * stretch.rateHz));
  world.figures = std::move(figures);
  const BodyId thing = stretch.hasProp ? world.world().add(prop).value() : -1;
  for (int k = 0; k <= windows; ++k) {
    const std::int64_t us = periodUs * k;
    world.push(body, us, stretch.person.pose(k));
    if (stretch.hasProp && !stretch.isHeld) {
      const foretouch::RigidPose pose = stretch.at(1e-6 * static_cast<double>(us));
      world.push(thing, us, Pose{{pose.rotation}, {pose.translation}});
    } else if (stretch.hasProp && k == 0) {
      const Skeleton& skeleton = stretch.person.clip->actor->avatar.skeleton();
      const auto hand = skeleton.find("RightHand");
      const Carrier holding{body, hand ? *hand : skeleton.numJoints() - 1, false};
      const foretouch::RigidPose grip{Quaternion::Identity(), Vector3d(0.0, 0.15, 0.0)};
      static_cast<void>(world.world().attach(thing, holding, 0, grip).value());
    }
    if (k > 0) world.ask(us - periodUs, us, k > 1);
  }
  figures = std::move(world.figures);
}

struct PropFigures {
  WindowFigures with, without;
};

PropFigures figuresOf(const std::vector<ClipPoses>& clips, double rateHz, const Scene& prop,
                      const std::function<void(int, Stretch&)>& prepare) {
  PropFigures figures;
  for (int i = 0; i < kThrows; ++i) {
    Stretch stretch;
    stretch.person.clip = &clips[static_cast<std::size_t>(i) % clips.size()];
    stretch.person.phase =
        static_cast<std::size_t>(7 * i) % (2 * stretch.person.clip->poses.size() - 2);
    stretch.rateHz = rateHz;
    prepare(i, stretch);
    run(stretch, prop, figures.with);
    stretch.hasProp = false;
    run(stretch, prop, figures.without);
  }
  return figures;
}

/// From one side through the chest to the other, turning.
void throwIt(int number, Stretch& stretch) {
  PortableRandom random(static_cast<std::uint64_t>(number));
  const double turn = random.uniform(0.0, 6.28), high = random.uniform(0.8, 1.4);
  const Vector3d along(std::cos(turn), 0.0, std::sin(turn));
  const Vector3d axis = random.inBox(1.0).normalized();
  stretch.at = [=](double s) -> foretouch::RigidPose {
    return {Quaternion(Eigen::AngleAxisd(kSpin * s, axis)),
            Vector3d(0.0, high, 0.0) + (kThrowSpeed * (s - 0.5 * kThrowSeconds)) * along};
  };
}

void putFarOff(int, Stretch& stretch) {
  stretch.at = [](double) -> foretouch::RigidPose {
    return {Quaternion::Identity(), Vector3d(3.0, 1.0, 0.0)};
  };
}

void hold(int, Stretch& stretch) {
  stretch.isHeld = true;
}

}  // namespace

BenchTable propTable(const WorldCast& cast) {
  BenchTable table{"prop",
                   "A person and a ring of 10,000 triangles; per window, beside the person alone",
                   {{"prop", "prop"},
                    {"rate_hz", "Hz", 0},
                    {"windows", "windows", 0},
                    {"with_us", "with us", 2},
                    {"alone_us", "alone us", 2},
                    {"prop_us", "prop us", 2},
                    {"with_p99_us", "with p99", 1},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2},
                    {"leaves", "leaves", 0},
                    {"advancements", "advancements", 0}},
                   {}};
  const Scene wide = torus(0.25, 0.02), small = torus(0.1, 0.015);
  struct Case {
    const char* name;
    double rateHz;
    const Scene& prop;
    void (*prepare)(int, Stretch&);
  };
  for (const Case& one :
       {Case{"far", 30.0, wide, putFarOff}, Case{"thrown, spinning", 30.0, wide, throwIt},
        Case{"thrown, spinning", 5.0, wide, throwIt}, Case{"held", 30.0, small, hold}}) {
    const auto clips = clipPosesOf(cast, one.rateHz);
    const PropFigures figures = figuresOf(clips, one.rateHz, one.prop, one.prepare);
    const Percentiles with = percentilesOf(figures.with.answerUs),
                      alone = percentilesOf(figures.without.answerUs);
    const WindowFigures& own = figures.with;
    table.rows.push_back({std::string(one.name), one.rateHz,
                          static_cast<std::int64_t>(own.windows()), with.mean, alone.mean,
                          with.mean - alone.mean, with.p99, own.perWindow(own.contacts),
                          own.perWindow(own.starts), own.perWindow(own.sum.queries.leaves),
                          own.perWindow(own.sum.queries.advancements)});
  }
  return table;
}

}  // namespace foretouch::tools
