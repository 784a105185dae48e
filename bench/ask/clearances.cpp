#include "bench/ask/clearances.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/try.h"
#include "assets/import/model_import.h"
#include "bench/inputs.h"
#include "bench/judged.h"
#include "bench/machine.h"
#include "bench/scene.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "judge/first_touch.h"
#include "judge/scene.h"
#include "middleware/edges/edge_query.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kHalfTurn = 3.14159265358979323846;
/// Instants per judged edge.
constexpr int kInstants = 64;
constexpr std::size_t kMostJudged = 2000;
/// Rounding of the judge's distances in double (m).
constexpr double kJudgeRounding = 1e-9;

/// The room turned to +Z up, the robot's base at the origin.
RawScene aroundRobot(RawScene raw, std::size_t triangles) {
  const Eigen::AlignedBox3d box = boundsOf(raw);
  const Vector3d base(box.center().x(), box.min().y() + 0.75, box.center().z());
  for (Triangle& triangle : raw.triangles) {
    for (Vector3d& v : triangle.vertices) {
      const Vector3d p = v - base;
      v = Vector3d(p.x(), -p.z(), p.y());
    }
  }
  return subdivided(std::move(raw), triangles);
}

std::vector<double> drawn(const Robot& robot, PortableRandom& random) {
  std::vector<double> q;
  for (const RobotCoordinate& c : robot.coordinates()) {
    q.push_back(random.uniform(std::max(c.lower, -kHalfTurn), std::min(c.upper, kHalfTurn)));
  }
  return q;
}

/// Pairs of free configurations, one after the other; the second at most `step` from the first in
/// each coordinate.
struct Edges {
  std::vector<double> q0, q1;
};
Edges edgesOf(const EdgeQuery& query, int count, double step, std::uint64_t seed) {
  PortableRandom random(seed);
  Scratch scratch;
  const auto isFree = [&](const std::vector<double>& q) {
    return query.answer(q, q, scratch).value().isUsable();
  };
  Edges edges;
  const std::size_t n = query.robot().numCoordinates();
  while (edges.q0.size() < static_cast<std::size_t>(count) * n) {
    const std::vector<double> from = drawn(query.robot(), random);
    std::vector<double> to = drawn(query.robot(), random);
    for (std::size_t i = 0; i < n; ++i) {
      to[i] = from[i] + std::clamp(to[i] - from[i], -step, step);
    }
    if (!isFree(from) || !isFree(to)) continue;
    edges.q0.insert(edges.q0.end(), from.begin(), from.end());
    edges.q1.insert(edges.q1.end(), to.begin(), to.end());
  }
  return edges;
}

/// The robot by kinematics of its own: a frame per joint, from the roots down.
class PlainRobot {
 public:
  PlainRobot(const Robot& robot, const Scene& scene, std::vector<LinkId> left)
      : robot_(robot), scene_(plain(finiteTriangles(scene))), left_(std::move(left)) {}

  [[nodiscard]] double separationAt(const std::vector<double>& q) const {
    const Skeleton& skeleton = robot_.avatar().skeleton();
    std::vector<Eigen::Isometry3d> frames;
    double least = 1e3;
    for (JointId j = 0; j < skeleton.numJoints(); ++j) {
      const RobotJoint& joint = robot_.joints()[slotOf(j)];
      const auto& rest = skeleton.restRotation(j);
      Eigen::Isometry3d frame = Eigen::Translation3d(skeleton.restOffset(j)) *
                                Eigen::Quaterniond(rest.w(), rest.x(), rest.y(), rest.z());
      if (joint.kind == RobotJointKind::Prismatic) {
        frame = frame * Eigen::Translation3d(robot_.valueOf(j, q.data()) * joint.axis);
      } else if (joint.kind != RobotJointKind::Fixed) {
        frame = frame * Eigen::AngleAxisd(robot_.valueOf(j, q.data()), joint.axis);
      }
      const JointId parent = skeleton.parent(j);
      frames.push_back(parent == kNoParent ? frame : frames[slotOf(parent)] * frame);
      if (std::find(left_.begin(), left_.end(), j) != left_.end()) continue;
      for (const Lss& lss : robot_.avatar().lss(j)) {
        least = std::min(least, oracle::distanceTo(scene_, plain(frames.back() * lss.a),
                                                   plain(frames.back() * lss.b), least + 1.0) -
                                    lss.radius);
      }
    }
    return least;
  }

 private:
  const Robot& robot_;
  oracle::Scene scene_;
  std::vector<LinkId> left_;
};

std::uint64_t violationsOf(const PlainRobot& judge, const Edges& edges, std::size_t n,
                           const std::vector<EdgeClearance>& answers) {
  std::uint64_t violations = 0;
  for (std::size_t i = 0; i < std::min(answers.size(), kMostJudged); ++i) {
    const auto at = [&](double t) {
      std::vector<double> q;
      for (std::size_t k = i * n; k < (i + 1) * n; ++k) {
        q.push_back(edges.q0[k] + t * (edges.q1[k] - edges.q0[k]));
      }
      return std::max(0.0, judge.separationAt(q));
    };
    double least = at(answers[i].t);
    bool holds = least <= answers[i].upper + kJudgeRounding;
    for (int k = 0; k <= kInstants; ++k) least = std::min(least, at(1.0 * k / kInstants));
    holds = holds && answers[i].lower <= least + kJudgeRounding;
    violations += holds ? 0 : 1;
  }
  return violations;
}

}  // namespace

Result<JudgedTable> clearancesTable(const std::string& dataFolder, int triangles, int edges,
                                    std::uint64_t seed) {
  JudgedTable judged{
      {"clearances",
       "How near edges of a Panda come to a room of " + std::to_string(triangles) + " triangles",
       {{"edges", "edges"},
        {"count", "clearances", 0},
        {"tolerance_mm", "known to mm", 1},
        {"us", "us per clearance", 2},
        {"touching_percent", "touch %", 1},
        {"mean_cm", "else mean, cm", 1},
        {"judged", "judged", 0},
        {"wrong", "wrong bounds", 0}},
       {}},
      0};
  const std::filesystem::path file =
      std::filesystem::path(dataFolder) / "robots/franka_panda/panda.urdf";
  if (dataFolder.empty() || !std::filesystem::exists(file)) return judged;
  FORETOUCH_TRY(const auto imported, importRobot(file.string()));
  const Robot& robot = imported.made.robot;
  FORETOUCH_TRY(const auto inputs, loadBenchInputs({}));
  FORETOUCH_TRY(const auto scene,
                Scene::build(aroundRobot(inputs.raw, static_cast<std::size_t>(triangles))));
  const PlainRobot judge(robot, scene, {0});
  FORETOUCH_TRY(auto pool, WorkerPool::start(1));
  const auto count = static_cast<std::size_t>(edges);
  const std::size_t n = robot.numCoordinates();
  for (const bool isShort : {true, false}) {
    for (const double tolerance : {1e-2, 1e-3}) {
      EdgeOptions options;
      options.ignored = {{0}};
      options.clearanceTolerance = tolerance;
      FORETOUCH_TRY(const auto query, EdgeQuery::build(robot, scene, options));
      const Edges drawnEdges = edgesOf(query, edges, isShort ? 0.3 : 2.0 * kHalfTurn, seed);
      std::vector<EdgeClearance> answers;
      const auto ask = [&] {
        return query.clearanceAll(drawnEdges.q0.data(), drawnEdges.q1.data(), count, pool, answers);
      };
      FORETOUCH_CHECK(ask());
      const ThreadStopwatch watch;
      FORETOUCH_CHECK(ask());
      const double tookUs = watch.us();
      const std::uint64_t wrong = violationsOf(judge, drawnEdges, n, answers);
      judged.violations += wrong;
      std::uint64_t touching = 0;
      double sum = 0.0;
      for (const EdgeClearance& answer : answers) {
        touching += answer.upper == 0.0 ? 1 : 0;
        sum += answer.upper;
      }
      judged.table.rows.push_back(
          {std::string(isShort ? "steps of up to 0.3 rad per joint" : "any two configurations"),
           static_cast<std::int64_t>(count), 1e3 * tolerance, tookUs / static_cast<double>(count),
           percent(touching, count),
           1e2 * sum / static_cast<double>(std::max<std::size_t>(1, count - touching)),
           static_cast<std::int64_t>(std::min(count, kMostJudged)),
           static_cast<std::int64_t>(wrong)});
    }
  }
  return judged;
}

}  // namespace foretouch::tools
