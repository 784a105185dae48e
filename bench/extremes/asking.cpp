#include "bench/extremes/asking.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/extremes/float_mode.h"
#include "bench/judged.h"
#include "lss/simd.h"
#include "lss/vertex_order.h"
#include "tests/reference/reference_query.h"

namespace foretouch::tools::extremes {
namespace {

using Eigen::Vector3d;

/// In the order w, x, y, z, as the motion's definition has it, and in the thread's own mode:
/// volatile prevents the compiler from evaluating it itself.
bool isBelowZero(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  volatile double sum = a[0] * b[0];
  for (std::size_t i = 1; i < 4; ++i) {
    const volatile double product = a[i] * b[i];
    sum = sum + product;
  }
  return sum < 0.0;
}

/// The product's objects made from a case.
struct Prepared {
  Avatar avatar;
  Pose from, to;
  Scene scene;
  std::optional<AvatarSurface> surface;
};

Result<Prepared> prepare(const ExtremeCase& extreme) {
  FORETOUCH_TRY(auto skeleton, Skeleton::build(extreme.skeleton));
  FORETOUCH_TRY(auto avatar, Avatar::build(skeleton, extreme.lss));
  FORETOUCH_TRY(auto from, validatedPose(skeleton, extreme.from));
  FORETOUCH_TRY(auto to, validatedPose(skeleton, extreme.to));
  FORETOUCH_TRY(auto scene, Scene::build(extreme.scene));
  Prepared prepared{std::move(avatar), std::move(from), std::move(to), std::move(scene),
                    std::nullopt};
  if (extreme.surface.empty()) return prepared;
  FORETOUCH_TRY(prepared.surface, AvatarSurface::build(prepared.avatar, extreme.surface));
  return prepared;
}

/// Each triangle once, whatever the order of its corners.
std::vector<oracle::Triangle> distinctOf(const std::vector<Triangle>& triangles) {
  std::vector<oracle::Triangle> distinct;
  std::set<std::array<double, 9>> seen;
  for (const Triangle& triangle : triangles) {
    if (!isFinite(triangle)) continue;
    Triangle sorted = triangle;
    std::sort(sorted.vertices.begin(), sorted.vertices.end(), isBeforeByCoordinates<Vector3d>);
    std::array<double, 9> numbers;
    for (std::size_t i = 0; i < 9; ++i) {
      numbers[i] = sorted.vertices[i / 3][static_cast<Eigen::Index>(i % 3)];
    }
    if (seen.insert(numbers).second) distinct.push_back(plain(sorted));
  }
  return distinct;
}

oracle::HullWorld worldOf(const ExtremeCase& extreme, const Prepared& prepared) {
  oracle::HullWorld world;
  world.joints = plainJoints(prepared.avatar.skeleton(), prepared.from, prepared.to);
  for (oracle::Joint& joint : world.joints) {
    joint.isFlipped = isBelowZero(joint.fromRotation, joint.toRotation);
  }
  world.hulls = hullsOf(extreme, Fidelity::Link);
  world.triangles = distinctOf(extreme.scene.triangles);
  return world;
}

class Asker {
 public:
  Asker(const ExtremeCase& extreme, const Prepared& prepared, bool isFlushed, Asked& asked)
      : prepared_(prepared),
        motion_(prepared.avatar.skeleton(), prepared.from, prepared.to),
        isFlushed_(isFlushed),
        asked_(asked) {
    options_.tolerance = extreme.tolerance;
  }

  void run() {
    for (const Simd simd : supportedSimd()) {
      useSimd(simd);
      reference_.backtracking = Backtracking::Lanes;
      everyFidelity(fmt::format("lanes {}", toString(simd)));
    }
    useSimd(std::nullopt);
    options_.scope = Scope::FirstOfAvatar;
    one("lanes, first of avatar", Fidelity::Link);
    options_.scope = Scope::EveryLink;
    cubics("lanes, cubics");
    reference_.backtracking = Backtracking::Scalar;
    everyFidelity("scalar");
    cubics("scalar, cubics");
  }

 private:
  void everyFidelity(const std::string& way) {
    for (const Culler culler : {Culler::FlatBvh, Culler::PointQuery}) {
      reference_.culler = culler;
      const std::string both = way + (culler == Culler::FlatBvh ? ", flat" : ", point-query");
      one(both, Fidelity::Link);
      if (prepared_.surface) one(both, Fidelity::Exact);
    }
    reference_.culler = Culler::FlatBvh;
  }

  void cubics(const std::string& way) {
    if (!prepared_.surface) return;
    reference_.leafMethod = LeafMethod::Cubics;
    one(way, Fidelity::Exact);
    reference_.leafMethod = LeafMethod::Advancement;
  }

  void one(const std::string& way, Fidelity fidelity) {
    if (asked_.refusal) return;
    options_.fidelity = fidelity;
    if (fidelity == Fidelity::Exact) options_.surface = prepared_.surface;
    Answer answer;
    answer.way = fmt::format("{}, {}{}", way, toString(fidelity), isFlushed_ ? ", flushed" : "");
    answer.fidelity = fidelity;
    answer.isFlushed = isFlushed_;
    answer.scope = options_.scope;
    const auto query = buildReference(prepared_.avatar, prepared_.scene, options_, reference_);
    if (!query.ok()) {
      asked_.refusal = query.error();
      return;
    }
    query.value().answer(motion_, scratch_, answer.step);
    asked_.answers.push_back(std::move(answer));
  }

  const Prepared& prepared_;
  ChainMotion motion_;
  bool isFlushed_;
  Asked& asked_;
  QueryOptions options_;
  ReferenceOptions reference_;
  Scratch scratch_;
};

}  // namespace

std::vector<oracle::Hull> hullsOf(const ExtremeCase& extreme, Fidelity fidelity) {
  std::vector<oracle::Hull> hulls;
  for (std::size_t link = 0; link < extreme.lss.size(); ++link) {
    if (fidelity == Fidelity::Exact && link < extreme.surface.size() &&
        !extreme.surface[link].empty()) {
      for (const Triangle& t : extreme.surface[link]) {
        hulls.push_back({static_cast<int>(link), 3, plain(t), 0.0});
      }
      continue;
    }
    for (const Lss& lss : extreme.lss[link]) {
      hulls.push_back({static_cast<int>(link), 2, {plain(lss.a), plain(lss.b), {}}, lss.radius});
    }
  }
  return hulls;
}

Asked ask(const ExtremeCase& extreme) {
  Asked asked;
  std::vector<bool> refused;
  for (const bool isFlushed : {false, true}) {
    if (isFlushed && !canFlushDenormals()) continue;
    const FloatMode mode(isFlushed);
    auto prepared = prepare(extreme);
    refused.push_back(!prepared.ok());
    if (!prepared.ok()) {
      asked.refusal = prepared.error();
      continue;
    }
    asked.world[isFlushed ? 1 : 0] = worldOf(extreme, prepared.value());
    asked.refusal.reset();
    Asker(extreme, prepared.value(), isFlushed, asked).run();
    refused.back() = asked.refusal.has_value();
  }
  for (const bool isRefused : refused) asked.isRefusedAlike &= isRefused == refused.front();
  if (refused.front() && asked.isRefusedAlike) asked.answers.clear();
  return asked;
}

std::uint64_t workOf(const QueryCounters& c) {
  return c.nodes + c.leaves + c.candidates + c.clusterSteps + c.laneSteps + c.partSteps +
         c.advancements + c.planeTests + c.cubicTests + c.states;
}

}  // namespace foretouch::tools::extremes
