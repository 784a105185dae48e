// bindings/python/robots.cpp: foretouch.Robot and foretouch.EdgeQuery.

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "articulated/robot.h"
#include "assets/certificate/certificate_writer.h"
#include "assets/import/model_import.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/importer_place.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "bindings/python/shared_robot.h"
#include "lss/index.h"
#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, RobotJointKind>, 5> kJointKinds{
    {{"fixed", RobotJointKind::Fixed},
     {"revolute", RobotJointKind::Revolute},
     {"continuous", RobotJointKind::Continuous},
     {"prismatic", RobotJointKind::Prismatic},
     {"planar", RobotJointKind::Planar}}};

SharedRobot shared(Robot robot) {
  auto avatar = std::make_shared<Avatar>(robot.avatar());
  return {std::make_shared<Robot>(std::move(robot)), std::move(avatar)};
}

/// Takes a key out of a joint's dict; what is left at the end is unknown.
py::object taken(py::dict& joint, const char* key) {
  if (!joint.contains(key)) return py::none();
  py::object value = joint[key];
  joint.attr("pop")(key);
  return value;
}

double numberOr(const py::object& given, const std::string& what, double otherwise) {
  return given.is_none() ? otherwise : number(given, what);
}

RobotJoint jointFrom(const Avatar& avatar, py::handle given, const std::string& what) {
  py::dict parts = mapping(given, what).attr("copy")();
  RobotJoint joint;
  joint.kind = oneOf(taken(parts, "kind"), what + ".kind", kJointKinds);
  if (const auto name = taken(parts, "name"); !name.is_none()) {
    joint.name = text(name, what + ".name");
  }
  if (const auto axis = taken(parts, "axis"); !axis.is_none()) {
    joint.axis = point(axis, what + ".axis");
  }
  joint.lower = numberOr(taken(parts, "lower"), what + ".lower", joint.lower);
  joint.upper = numberOr(taken(parts, "upper"), what + ".upper", joint.upper);
  if (const auto leader = taken(parts, "mimic_of"); !leader.is_none()) {
    joint.mimicOf = linkOf(avatar, leader, what + ".mimic_of");
  }
  joint.mimicFactor = numberOr(taken(parts, "mimic_factor"), what + ".mimic_factor", 1.0);
  joint.mimicOffset = numberOr(taken(parts, "mimic_offset"), what + ".mimic_offset", 0.0);
  for (const auto& [key, value] : parts) {
    refuseName(
        what, "key", py::str(key).cast<std::string>(),
        {"kind", "name", "axis", "lower", "upper", "mimic_of", "mimic_factor", "mimic_offset"});
  }
  return joint;
}

SharedRobot robotFromJoints(const std::shared_ptr<Avatar>& avatar,
                            const Shown<shown::Items>& given) {
  std::vector<RobotJoint> joints;
  for (const py::object& one : items(given, "joints")) {
    joints.push_back(jointFrom(*avatar, one, "joints[" + std::to_string(joints.size()) + "]"));
  }
  return shared(valueOf(Robot::build(*avatar, std::move(joints)), "joints"));
}

SharedRobot loadUrdf(const Shown<shown::Path>& file, const Shown<shown::Texts>& packages,
                     const Shown<shown::Truth>& visual, const Shown<shown::Integer>& maxLss,
                     const Shown<shown::Path>& importer) {
  const std::string from = path(file, "path");
  RobotImportOptions options;
  options.reading.import.importer = importerPlace(importer);
  options.reading.packagePaths = texts(packages, "packages");
  options.reading.urdfSurface =
      boolean(visual, "visual") ? UrdfSurface::Visual : UrdfSurface::Collision;
  options.making.maxLssPerLink =
      static_cast<int>(integer(maxLss, "max_lss", 1, std::int64_t{kMaxLssPerLink}));
  const py::gil_scoped_release free;
  return shared(valueOf(importRobot(from, options), from).made.robot);
}

SharedRobot robotWithTool(const SharedRobot& robot, const Shown<shown::Link>& link,
                          const Shown<shown::Text>& name, const Shown<shown::Items>& lss) {
  std::vector<Lss> all;
  for (const py::object& one : items(lss, "lss")) {
    all.push_back(lssFrom(one, "lss[" + std::to_string(all.size()) + "]"));
  }
  return shared(valueOf(robot.robot->withTool(linkOf(*robot.avatar, link, "link"),
                                              text(name, "name"), std::move(all))));
}

template <typename T, typename Of>
py::array_t<T> perCoordinate(const Robot& robot, const Of& of) {
  py::array_t<T> made(static_cast<py::ssize_t>(robot.numCoordinates()));
  T* to = made.mutable_data();
  for (const RobotCoordinate& coordinate : robot.coordinates()) *to++ = of(coordinate);
  return made;
}

py::list coordinateNames(const SharedRobot& robot) {
  py::list names;
  for (const auto& coordinate : robot.robot->coordinates()) names.append(readable(coordinate.name));
  return names;
}

py::object poseOf(const SharedRobot& robot, const Shown<shown::Array>& q) {
  const std::size_t count = robot.robot->numCoordinates();
  const Numbers given = numbers(q, "q", {static_cast<py::ssize_t>(count)});
  valueOf(robot.robot->checked(given.data(), count));
  Pose pose;
  robot.robot->poseAt(given.data(), pose);
  return toPython(pose);
}

/// They touch nothing, whatever they do.
py::list linksWithoutVolume(const SharedRobot& robot) {
  py::list names;
  for (LinkId link = 0; link < robot.avatar->numLinks(); ++link) {
    if (robot.avatar->lss(link).empty()) names.append(nameOf(*robot.avatar, link));
  }
  return names;
}

/// (poses, at) of a list of configurations.
py::tuple pathOf(const SharedRobot& robot, const Shown<shown::Array>& q) {
  const Numbers given =
      numbers(q, "q", {kAny, static_cast<py::ssize_t>(robot.robot->numCoordinates())});
  const auto path =
      valueOf(robot.robot->pathAlong(given.data(), static_cast<std::size_t>(given.shape(0))));
  Numbers at(static_cast<py::ssize_t>(path.at.size()));
  std::copy(path.at.begin(), path.at.end(), at.mutable_data());
  return py::make_tuple(toPython(path.poses, robot.robot->joints().size()), at);
}

/// A column of the answers.
template <typename T, typename Of>
py::array_t<T> columnOf(const std::vector<EdgeAnswer>& answers, const Of& of) {
  py::array_t<T> made(static_cast<py::ssize_t>(answers.size()));
  T* to = made.mutable_data();
  for (const EdgeAnswer& answer : answers) *to++ = of(answer);
  return made;
}

/// `scenes`: that of the query, then those of its props.
py::object edgesOf(const std::vector<EdgeAnswer>& answers, const SharedRobot& robot,
                   const std::vector<std::shared_ptr<Scene>>& scenes) {
  Numbers points({static_cast<py::ssize_t>(answers.size()), py::ssize_t{3}});
  double* to = points.mutable_data();
  for (const EdgeAnswer& answer : answers) {
    const Eigen::Vector3d& p = answer.contact.p_WScene;
    to = std::copy(p.data(), p.data() + 3, to);
  }
  using A = const EdgeAnswer&;
  const auto isClear = [](A a) { return a.verdict == Verdict::Clear; };
  return pythonType("Edges")(
      columnOf<std::uint8_t>(answers, [](A a) { return static_cast<std::uint8_t>(a.verdict); }),
      columnOf<double>(answers, [](A a) { return a.freeUntil; }),
      columnOf<bool>(answers, [](A a) { return a.isUsable(); }),
      columnOf<std::int32_t>(answers, [&](A a) { return isClear(a) ? -1 : a.contact.link; }),
      columnOf<std::int32_t>(answers, [&](A a) { return isClear(a) ? -1 : a.contact.other; }),
      columnOf<std::int32_t>(answers, [&](A a) { return isClear(a) ? -1 : a.contact.triangle; }),
      points, columnOf<std::int32_t>(answers, [](A a) { return a.prop; }), robot.avatar, scenes);
}

/// Slopes are None where they were not asked for.
py::object clearancesOf(const std::vector<EdgeClearance>& answers, py::object slopes0,
                        py::object slopes1) {
  const auto columnOfAll = [&](auto type, const auto& of) {
    py::array_t<decltype(type)> made(static_cast<py::ssize_t>(answers.size()));
    auto* to = made.mutable_data();
    for (const EdgeClearance& answer : answers) *to++ = of(answer);
    return made;
  };
  const auto vectors = [&](const auto& of) {
    Numbers made({static_cast<py::ssize_t>(answers.size()), py::ssize_t{3}});
    double* to = made.mutable_data();
    for (const EdgeClearance& answer : answers) {
      const Eigen::Vector3d& p = of(answer);
      to = std::copy(p.data(), p.data() + 3, to);
    }
    return made;
  };
  using A = const EdgeClearance&;
  return pythonType("Clearances")(
      columnOfAll(double{}, [](A a) { return a.lower; }),
      columnOfAll(double{}, [](A a) { return a.upper; }),
      columnOfAll(double{}, [](A a) { return a.t; }),
      columnOfAll(std::int32_t{}, [](A a) { return a.link; }),
      columnOfAll(std::int32_t{}, [](A a) { return a.triangle; }),
      columnOfAll(std::int32_t{}, [](A a) { return a.prop; }),
      columnOfAll(bool{}, [](A a) { return a.isAlone; }),
      vectors([](A a) -> const Eigen::Vector3d& { return a.p_WLink; }),
      vectors([](A a) -> const Eigen::Vector3d& { return a.p_WScene; }),
      vectors([](A a) -> const Eigen::Vector3d& { return a.nhat_SL_W; }), std::move(slopes0),
      std::move(slopes1));
}

/// Any number of threads may use one at once: they take turns, each on all its threads.
class PythonEdgeQuery {
 public:
  PythonEdgeQuery(SharedRobot robot, std::vector<std::shared_ptr<Scene>> scenes,
                  const EdgeOptions& options, int threads)
      : robot_(std::move(robot)),
        scenes_(std::move(scenes)),
        question_(valueOf(EdgeQuery::build(*robot_.robot, *scenes_.front(), options))),
        pool_(valueOf(WorkerPool::start(threads))) {}

  [[nodiscard]] const SharedRobot& robot() const { return robot_; }
  [[nodiscard]] const std::shared_ptr<Scene>& scene() const { return scenes_.front(); }

  void place(const Shown<shown::Integer>& prop, const Shown<shown::Pose>& pose) {
    const auto which = static_cast<std::size_t>(
        integer(prop, "prop", 0, static_cast<std::int64_t>(question_.numProps()) - 1));
    std::optional<RigidPose> where;
    if (!pose.is_none()) {
      const Pose given = poseFrom(skeletonOfProp(), withJointAxis(pose), "pose");
      where = RigidPose{given.rotations[0], given.translations[0]};
    }
    const py::gil_scoped_release free;
    const std::lock_guard<std::mutex> lock(mutex_);
    valueOf(question_.place(which, where));
  }

  py::object answer(const Shown<shown::Array>& q0, const Shown<shown::Array>& q1) {
    const auto [from, to] = ends(q0, q1);
    std::vector<EdgeAnswer> answers;
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> lock(mutex_);
      valueOf(question_.answerAll(from.data(), to.data(), static_cast<std::size_t>(from.shape(0)),
                                  pool_, answers));
    }
    return edgesOf(answers, robot_, scenes_);
  }

  py::object clearance(const Shown<shown::Array>& q, const Shown<shown::Array>& q1,
                       bool withSlopes) {
    const bool isPath = q1.is_none();
    const Numbers from = configurations(q, isPath ? "q" : "q0");
    const py::ssize_t n = from.shape(1);
    if (isPath && from.shape(0) < 2) {
      refuse(ErrorCode::Empty, "q", "expected at least two configurations");
    }
    const Numbers to = isPath ? from : ends(q, q1).second;
    const py::ssize_t count = from.shape(0) - (isPath ? 1 : 0);
    const double* const second = to.data() + (isPath ? n : 0);
    Numbers slopes0({withSlopes ? count : 0, n}), slopes1({withSlopes ? count : 0, n});
    double *const at0 = withSlopes ? slopes0.mutable_data() : nullptr,
                  *const at1 = withSlopes ? slopes1.mutable_data() : nullptr;
    std::vector<EdgeClearance> answers;
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> lock(mutex_);
      valueOf(question_.clearanceAll(from.data(), second, static_cast<std::size_t>(count), pool_,
                                     answers, at0, at1));
    }
    return withSlopes ? clearancesOf(answers, slopes0, slopes1)
                      : clearancesOf(answers, py::none(), py::none());
  }

  py::object certify(const Shown<shown::Array>& q0, const Shown<shown::Array>& q1,
                     const Shown<shown::Path>& folder) {
    const auto [from, to] = ends(q0, q1);
    const std::string into = path(folder, "folder");
    std::optional<EdgeCertificate> made;
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> lock(mutex_);
      made = valueOf(
          certifyEdges(question_, from.data(), to.data(), static_cast<std::size_t>(from.shape(0))));
      valueOf(writeEdgeCertificate(*made, into));
    }
    py::array_t<bool> proven(static_cast<py::ssize_t>(made->isProven.size()));
    std::copy(made->isProven.begin(), made->isProven.end(), proven.mutable_data());
    return pythonType("CertifiedEdges")(edgesOf(made->answers, robot_, scenes_), proven,
                                        made->counts.spans, made->counts.planes,
                                        made->proof.size());
  }

  py::tuple answerPath(const Shown<shown::Array>& q) {
    const Numbers given = configurations(q, "q");
    std::optional<PathAnswer> path;
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> lock(mutex_);
      path = valueOf(
          question_.answerPath(given.data(), static_cast<std::size_t>(given.shape(0)), pool_));
    }
    return py::make_tuple(path->freeUntil, edgesOf({path->answer}, robot_, scenes_));
  }

 private:
  [[nodiscard]] Numbers configurations(const Shown<shown::Array>& q, const char* what) const {
    return numbers(q, what, {kAny, static_cast<py::ssize_t>(robot_.robot->numCoordinates())});
  }
  [[nodiscard]] std::pair<Numbers, Numbers> ends(const Shown<shown::Array>& q0,
                                                 const Shown<shown::Array>& q1) const {
    Numbers from = configurations(q0, "q0"), to = configurations(q1, "q1");
    if (from.shape(0) != to.shape(0)) {
      refuse(ErrorCode::Mismatch, "q1",
             "expected " + std::to_string(from.shape(0)) + " configurations, as in q0, found " +
                 std::to_string(to.shape(0)));
    }
    return {std::move(from), std::move(to)};
  }

  SharedRobot robot_;
  std::vector<std::shared_ptr<Scene>> scenes_;  // the scene, then those of props
  EdgeQuery question_;
  std::mutex mutex_;
  WorkerPool pool_;
};

std::unique_ptr<PythonEdgeQuery> makeEdges(
    const SharedRobot& robot, std::shared_ptr<Scene> scene, const Shown<shown::Number>& tolerance,
    const Shown<shown::Number>& clearance, const Shown<shown::PairRules>& selfPairs,
    const Shown<shown::Items>& ignore, const Shown<shown::Integer>& threads,
    const Shown<shown::Items>& props, const Shown<shown::Number>& clearanceTolerance,
    const Shown<shown::Number>& clearanceWithin) {
  EdgeOptions options;
  options.clearanceTolerance = number(clearanceTolerance, "clearance_tolerance");
  options.clearanceWithin = clearanceWithin.is_none() ? options.clearanceWithin
                                                      : number(clearanceWithin, "clearance_within");
  options.tolerance = number(tolerance, "tolerance");
  options.clearance = number(clearance, "clearance");
  if (!selfPairs.is_none()) options.self = rulesFrom(selfPairs, *robot.avatar);
  options.ignored = ignoredFrom(ignore, *robot.avatar, *scene);
  std::vector<std::shared_ptr<Scene>> scenes{std::move(scene)};
  for (const py::object& prop : items(props, "props")) {
    if (!py::isinstance<Scene>(prop)) refuse(ErrorCode::Mismatch, "props", "expected scenes");
    scenes.push_back(prop.cast<std::shared_ptr<Scene>>());
    options.props.push_back({*scenes.back(), RigidPose{}, {}});
  }
  const int many = static_cast<int>(integer(threads, "threads", 1, kMaxPoolThreads));
  return std::make_unique<PythonEdgeQuery>(robot, std::move(scenes), options, many);
}

void bindRobot(py::module_& module) {
  py::class_<SharedRobot>(
      module, "Robot",
      "An avatar whose joints move by coordinates (rad or m): a configuration q has one number\n"
      "per coordinate. Immutable; any number of threads may use one.")
      .def_static("load_urdf", &loadUrdf, py::arg("path"), py::kw_only(),
                  py::arg("packages") = py::tuple(), py::arg("visual") = false,
                  py::arg("max_lss") = 4, py::arg("importer") = py::none(),
                  "A URDF, in the frame of its root link (docs/robots.md says what is refused).\n"
                  "packages: where package://NAME/ is; max_lss: LSS around a link's meshes.")
      .def_static("from_joints", &robotFromJoints, py::arg("avatar").none(false), py::arg("joints"),
                  "joints: one dict per joint of the avatar: kind ('fixed', 'revolute',\n"
                  "'continuous', 'prismatic', 'planar'), and name, axis, lower, upper, mimic_of,\n"
                  "mimic_factor, mimic_offset.")
      .def("with_tool", &robotWithTool, py::arg("link"), py::arg("name"), py::arg("lss"),
           "Another robot: with a link of its own, fixed to `link`; lss: a list of\n"
           "(a, b, radius), in the link's frame.")
      .def("pose", &poseOf, py::arg("q"),
           "The pose at q, as a Pose. A Motion between two of them turns each joint on the\n"
           "shorter arc, which is another way where it turns by more than half a turn: path().")
      .def(
          "path", &pathOf, py::arg("q"),
          "(poses, at) of q (n, coordinates): the poses there, and in between as many as it takes\n"
          "for each joint to turn the way that q says, as on an edge. at: where each lies, i + t.")
      .def_property_readonly("num_coordinates",
                             [](const SharedRobot& r) { return r.robot->numCoordinates(); })
      .def_property_readonly("names", &coordinateNames, "Of the coordinates.")
      .def_property_readonly("lower",
                             [](const SharedRobot& r) {
                               return perCoordinate<double>(
                                   *r.robot, [](const RobotCoordinate& c) { return c.lower; });
                             })
      .def_property_readonly("upper",
                             [](const SharedRobot& r) {
                               return perCoordinate<double>(
                                   *r.robot, [](const RobotCoordinate& c) { return c.upper; });
                             })
      .def_property_readonly("is_periodic",
                             [](const SharedRobot& r) {
                               return perCoordinate<bool>(
                                   *r.robot, [](const RobotCoordinate& c) { return c.isPeriodic; });
                             })
      .def_property_readonly("avatar", [](const SharedRobot& r) { return r.avatar; })
      .def_property_readonly("links_without_volume", &linksWithoutVolume,
                             "Their file gives them no shape, so they touch nothing.")
      .def("__repr__", [](const SharedRobot& r) {
        const std::size_t bare = linksWithoutVolume(r).size();
        return "<foretouch.Robot of " + std::to_string(r.avatar->numLinks()) + " links, " +
               (bare > 0 ? std::to_string(bare) + " of them without volume, " : "") +
               std::to_string(r.robot->numCoordinates()) + " coordinates>";
      });
}

}  // namespace

void bindRobots(py::module_& module) {
  bindRobot(module);
  const EdgeOptions usual;
  py::class_<PythonEdgeQuery>(
      module, "EdgeQuery",
      "The question of a motion planner: is the straight line in joint coordinates from q0 to q1\n"
      "free, and if not, how far? Proven. Any number of threads may ask one.")
      .def(
          py::init(&makeEdges), py::arg("robot"), py::arg("scene").none(false), py::kw_only(),
          py::arg("tolerance") = usual.tolerance, py::arg("clearance") = usual.clearance,
          py::arg("self_pairs") = py::none(), py::arg("ignore") = py::tuple(),
          py::arg("threads") = 1, py::arg("props") = py::tuple(),
          py::arg("clearance_tolerance") = usual.clearanceTolerance,
          py::arg("clearance_within") = py::none(),
          "clearance (m): clear proves that the robot keeps more than this away; self_pairs:\n"
          "PairRules of robot.avatar; ignore: links and pairs (link, object); threads: of a call;\n"
          "props: scenes, each in a frame of its own, which place() moves; at first that is W;\n"
          "clearance_tolerance, clearance_within (m): how far the bounds of clearance() may be\n"
          "apart, and how far it looks, which is unlimited if None.")
      .def("place", &PythonEdgeQuery::place, py::arg("prop"), py::arg("pose"),
           "Moves a prop, by its place in props; nothing is built anew. pose: (rotation, "
           "translation),\n"
           "or None: it is not there.")
      .def("answer", &PythonEdgeQuery::answer, py::arg("q0"), py::arg("q1"),
           "q0 and q1 (n, coordinates): n edges; an Edges, whose describe() says what they meet.\n"
           "An edge from q to q asks about q.")
      .def("clearance", &PythonEdgeQuery::clearance, py::arg("q"), py::arg("q1") = py::none(),
           py::kw_only(), py::arg("slopes") = false,
           "How near edges come to the scene and to props: bounds, when and where. q (T,\n"
           "coordinates): a path, whose T - 1 edges are asked; with q1: edges from q to q1.\n"
           "A Clearances. slopes: also how it changes with both ends.")
      .def("certify", &PythonEdgeQuery::certify, py::arg("q0"), py::arg("q1"), py::arg("folder"),
           "As answer(), and writes why the clear edges are clear into the folder: scene.obj,\n"
           "avatar.json, edges.txt and certificate.txt, for foretouch-verify. A CertifiedEdges.")
      .def(
          "answer_path", &PythonEdgeQuery::answerPath, py::arg("q"),
          "q (n, coordinates): a path. (free_until, edge): it is free on [0, free_until), counted\n"
          "in edges, and what its first edge that is not clear met; n - 1 if all are clear.")
      .def_property_readonly("robot", &PythonEdgeQuery::robot)
      .def_property_readonly("scene", &PythonEdgeQuery::scene);
}

}  // namespace foretouch::python
