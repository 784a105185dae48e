#include "tests/planning/plan_stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>

#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr int kTries = 200, kDraws = 200;

/// A prism of eight sides about the segment ab.
void addRod(const Vector3d& a, const Vector3d& b, double radius, std::vector<Triangle>& all) {
  const Vector3d along = (b - a).normalized();
  const Vector3d x = along.unitOrthogonal(), y = along.cross(x);
  const auto around = [&](const Vector3d& end, int i) {
    const double angle = 2 * kPi * i / 8;
    return Vector3d(end + radius * (std::cos(angle) * x + std::sin(angle) * y));
  };
  for (int i = 0; i < 8; ++i) {
    all.push_back({around(a, i), around(a, i + 1), around(b, i + 1)});
    all.push_back({around(a, i), around(b, i + 1), around(b, i)});
    all.push_back({a, around(a, i + 1), around(a, i)});
    all.push_back({b, around(b, i), around(b, i + 1)});
  }
}

void addBoard(const Vector3d& low, const Vector3d& high, std::vector<Triangle>& all) {
  const auto corner = [&](int i) {
    return Vector3d((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                    (i & 4) != 0 ? high.z() : low.z());
  };
  for (const auto& side :
       {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
    all.push_back({corner(side[0]), corner(side[1]), corner(side[2])});
    all.push_back({corner(side[0]), corner(side[2]), corner(side[3])});
  }
}

/// Fourteen poles on a ring, and six wires across at various heights.
std::vector<Triangle> wires(double thickness, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Triangle> all;
  const auto onRing = [&](double angle, double radius, double z) {
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < 14; ++i) {
    const double angle = 2 * kPi * (i + 0.6 * unit(random)) / 14,
                 radius = 0.4 + 0.35 * unit(random);
    addRod(onRing(angle, radius, -0.2), onRing(angle, radius, 1.4), thickness / 2, all);
  }
  for (int i = 0; i < 6; ++i) {
    const double angle = 2 * kPi * unit(random), z = 0.5 + 0.7 * unit(random);
    addRod(onRing(angle, 0.8, z), onRing(angle + 2.2 + unit(random), 0.8, z + 0.2 * unit(random)),
           thickness / 2, all);
  }
  return all;
}

/// Two shelves of four boards and three walls each, and a table top.
std::vector<Triangle> shelf() {
  std::vector<Triangle> all;
  for (const double side : {1.0, -1.0}) {
    const auto board = [&](double x0, double x1, double y0, double y1, double z0, double z1) {
      addBoard({x0, std::min(side * y0, side * y1), z0}, {x1, std::max(side * y0, side * y1), z1},
               all);
    };
    for (int i = 0; i < 4; ++i) board(-0.5, 0.5, 0.45, 0.75, 0.15 + 0.3 * i, 0.17 + 0.3 * i);
    for (int i = 0; i < 3; ++i) board(-0.51 + 0.5 * i, -0.49 + 0.5 * i, 0.45, 0.75, 0.0, 1.07);
  }
  addBoard({0.45, -0.4, 0.28}, {0.75, 0.4, 0.3}, all);
  return all;
}

std::optional<std::vector<Triangle>> ofFile(const std::string& path) {
  const auto file = sharedData(path);
  if (!file) return std::nullopt;
  SceneImportOptions asFile;
  asFile.up = UpAxis::Y;  // no turn: both files have +Z up, and so has the robot
  const auto imported = importScene(*file, asFile);
  if (!imported.ok()) throw std::runtime_error(describe(imported.error()));
  return imported.value().scene.triangles;
}

double shareFree(const PlanStage& stage, unsigned seed) {
  std::mt19937_64 random(seed);
  Scratch scratch;
  int free = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto q = stage.draw(random);
    free += stage.edges->answer(q, q, scratch).value().isUsable() ? 1 : 0;
  }
  return static_cast<double>(free) / kDraws;
}

/// The root link stands on the floor, where a scene has one.
void settle(const Robot& robot, PlanStage& stage) {
  RawScene raw;
  raw.triangles = stage.triangles;
  raw.objectOf.assign(raw.triangles.size(), 0);
  raw.objectNames = {stage.name};
  EdgeOptions options;
  stage.left = {0};
  for (LinkId link = 0; link < robot.avatar().numLinks(); ++link) {
    bool isStill = true;  // nothing above it moves
    for (LinkId j = link; j != kNoParent; j = robot.avatar().skeleton().parent(j)) {
      isStill =
          isStill && robot.joints()[static_cast<std::size_t>(j)].kind == RobotJointKind::Fixed;
    }
    if (isStill && link != 0) stage.left.push_back(link);
  }
  for (const LinkId link : stage.left) options.ignored.push_back({link});
  const auto scene = Scene::build(raw);
  if (!scene.ok()) throw std::runtime_error(describe(scene.error()));
  stage.edges = EdgeQuery::build(robot, scene.value(), options).value();
}

/// What lies within reach of the origin, of a scene that is shifted.
std::vector<Triangle> around(const std::vector<Triangle>& all, const Vector3d& place) {
  std::vector<Triangle> near;
  for (Triangle t : all) {
    Eigen::AlignedBox3d box;
    for (Vector3d& v : t.vertices) {
      v -= place;
      box.extend(v);
    }
    if (box.exteriorDistance(Vector3d(0, 0, 0.4)) < 2.0) near.push_back(t);
  }
  return near;
}

}  // namespace

std::optional<Result<Robot>> sharedRobot(const std::string& name) {
  const auto path = sharedData(name == "panda" ? "robots/franka_panda/panda.urdf"
                                               : "robots/kuka_iiwa/model.urdf");
  if (!path) return std::nullopt;
  auto imported = importRobot(*path);
  if (!imported.ok()) return Result<Robot>(imported.error());
  return Result<Robot>(std::move(imported).value().made.robot);
}

std::vector<double> PlanStage::draw(std::mt19937_64& random) const {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> q;
  for (const RobotCoordinate& c : edges->robot().coordinates()) {
    const double lower = std::max(c.lower, -kPi), upper = std::min(c.upper, kPi);
    q.push_back(lower + unit(random) * (upper - lower));
  }
  return q;
}

std::vector<double> PlanStage::drawFree(std::mt19937_64& random, Scratch& scratch) const {
  for (;;) {
    auto q = draw(random);
    if (edges->answer(q, q, scratch).value().isUsable()) return q;
  }
}

std::optional<PlanStage> planStage(const std::string& name, const Robot& robot, unsigned seed) {
  std::mt19937_64 random(seed);
  PlanStage stage;
  stage.name = name;
  std::optional<std::vector<Triangle>> file;
  if (name.rfind("wires-", 0) == 0) {
    stage.triangles = wires(1e-3 * std::stod(name.substr(6)), random);
  } else if (name == "shelf") {
    stage.triangles = shelf();
  } else {
    file = ofFile(name == "office" ? "scenes/cpr_office.dae" : "scenes/kitchen_fatihrmutfak.ply");
    if (!file) return std::nullopt;
  }
  if (!file) {
    settle(robot, stage);
    return stage;
  }
  Eigen::AlignedBox3d box;
  for (const Triangle& t : *file) {
    for (const Vector3d& v : t.vertices) box.extend(v);
  }
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < kTries; ++i) {
    const Vector3d at(unit(random), unit(random), 0.6 * unit(random));
    stage.triangles = around(*file, box.min() + at.cwiseProduct(box.sizes()));
    if (stage.triangles.empty()) continue;
    settle(robot, stage);
    const double free = shareFree(stage, seed);
    if (free >= 0.25 && free <= 0.75) return stage;
  }
  throw std::runtime_error("no place for the robot in " + name);
}

}  // namespace foretouch::test
