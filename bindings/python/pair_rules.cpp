// bindings/python/pair_rules.cpp: foretouch.PairRules.
#include "bindings/python/pair_rules.h"

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "assets/avatar/avatar_file.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/shared_robot.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

using SharedAvatar = std::shared_ptr<Avatar>;

constexpr std::array<std::pair<const char*, PairReason>, 4> kLeftOutReasons{
    {{"adjacent", PairReason::Adjacent},
     {"rest-overlap", PairReason::RestOverlap},
     {"always", PairReason::Always},
     {"user", PairReason::User}}};

/// Two links, by name or index, and whatever follows them.
struct GivenPair {
  LinkId a = 0, b = 0;
  std::vector<py::object> items;
  std::string what;
};

GivenPair pairFrom(const Avatar& avatar, const py::object& given, const std::string& list,
                   std::size_t place, std::size_t least, std::size_t most) {
  GivenPair pair;
  pair.what = list + "[" + std::to_string(place) + "]";
  pair.items = items(given, pair.what);
  if (pair.items.size() < least || pair.items.size() > most) {
    refuse(ErrorCode::Mismatch, pair.what,
           "expected " + std::to_string(least) + (most > least ? " or more" : "") +
               " items, found " + std::to_string(pair.items.size()));
  }
  pair.a = linkOf(avatar, pair.items[0], pair.what + "[0]");
  pair.b = linkOf(avatar, pair.items[1], pair.what + "[1]");
  return pair;
}

/// The library's options by their names here.
Result<foretouch::PairRules> withKeywords(Result<foretouch::PairRules> made) {
  if (made.ok()) return made;
  Error error = made.error();
  if (error.file == "restSkin") error.file = "rest_skin";
  if (error.file == "alwaysShare") error.file = "always_share";
  return error;
}

std::vector<LinkPair> pairsFrom(const Avatar& avatar, const Shown<shown::Items>& given,
                                const std::string& list) {
  std::vector<LinkPair> pairs;
  for (const py::object& one : items(given, list)) {
    const GivenPair pair = pairFrom(avatar, one, list, pairs.size(), 2, 2);
    pairs.push_back({pair.a, pair.b});
  }
  return pairs;
}

PairRules derive(SharedAvatar avatar, const Shown<shown::Poses>& usualPoses,
                 const Shown<shown::Number>& alwaysShare, bool pairRadii,
                 const Shown<shown::Number>& restSkin, const Shown<shown::Items>& leaveOut) {
  PairRuleOptions options;
  options.alwaysShare = number(alwaysShare, "always_share");
  options.usePairRadii = pairRadii;
  options.restSkin = number(restSkin, "rest_skin");
  options.leftOut = pairsFrom(*avatar, leaveOut, "leave_out");
  std::vector<Pose> poses;
  if (!usualPoses.is_none()) poses = posesFrom(avatar->skeleton(), usualPoses, "usual_poses");
  options.usualPoses = &poses;
  const py::gil_scoped_release free;
  auto rules =
      valueOf(withKeywords(foretouch::PairRules::derive(*avatar, options)), "PairRules.derive");
  return {std::move(avatar), std::move(rules)};
}

PairRules ofRobot(const SharedRobot& robot, const Shown<shown::Integer>& samples,
                  const Shown<shown::Integer>& seed, const Shown<shown::Number>& alwaysShare,
                  const Shown<shown::Items>& leaveOut) {
  RobotPairOptions options;
  options.samples = static_cast<std::int32_t>(
      integer(samples, "samples", 1, std::numeric_limits<std::int32_t>::max()));
  options.seed = static_cast<std::uint64_t>(
      integer(seed, "seed", 0, std::numeric_limits<std::int64_t>::max()));
  options.alwaysShare = number(alwaysShare, "always_share");
  options.leftOut = pairsFrom(*robot.avatar, leaveOut, "leave_out");
  const py::gil_scoped_release free;
  auto rules = valueOf(withKeywords(foretouch::PairRules::derive(*robot.robot, options)),
                       "PairRules.of_robot");
  return {robot.avatar, std::move(rules)};
}

PairRules asking(SharedAvatar avatar, const Shown<shown::Items>& asked) {
  const std::vector<LinkPair> pairs = pairsFrom(*avatar, asked, "asked");
  auto rules = valueOf(foretouch::PairRules::asking(*avatar, pairs), "PairRules.asking");
  return {std::move(avatar), std::move(rules)};
}

/// The old name let people believe that its list was of the pairs to ask.
[[noreturn]] void exactly(const SharedAvatar&, const Shown<shown::Items>&,
                          const Shown<shown::Items>&) {
  refuse(ErrorCode::Mismatch, "PairRules.exactly",
         "is no more, as its name did not say which pairs its list was of: expected "
         "PairRules.asking(avatar, pairs) for the pairs to ask, or PairRules.leaving_out(avatar, "
         "pairs, radii) for those to leave out, which exactly() took");
}

PairRules leavingOut(SharedAvatar avatar, const Shown<shown::Items>& leftOut,
                     const Shown<shown::Items>& radii) {
  std::vector<LeftOutPair> pairs;
  for (const py::object& one : items(leftOut, "left_out")) {
    const GivenPair pair = pairFrom(*avatar, one, "left_out", pairs.size(), 2, 3);
    const PairReason reason = pair.items.size() == 2
                                  ? PairReason::User
                                  : oneOf(pair.items[2], pair.what + "[2]", kLeftOutReasons);
    pairs.push_back({pair.a, pair.b, reason});
  }
  std::vector<PairRadius> own;
  for (const py::object& one : items(radii, "radii")) {
    const std::vector<py::object> parts = items(one, "radii[" + std::to_string(own.size()) + "]");
    const std::string what = "radii[" + std::to_string(own.size()) + "]";
    if (parts.size() != 5) {
      refuse(ErrorCode::Mismatch, what, "expected (a, lss_a, b, lss_b, radius)");
    }
    const auto lss = [&](std::size_t i) {
      return static_cast<std::int32_t>(
          integer(parts[i], what + "[" + std::to_string(i) + "]", 0, kMaxLssPerLink - 1));
    };
    own.push_back({linkOf(*avatar, parts[0], what + "[0]"), lss(1),
                   linkOf(*avatar, parts[2], what + "[2]"), lss(3),
                   number(parts[4], what + "[4]")});
  }
  auto rules = valueOf(foretouch::PairRules::leavingOut(*avatar, std::move(pairs), std::move(own)),
                       "PairRules.leaving_out");
  return {std::move(avatar), std::move(rules)};
}

PairRules load(const Shown<shown::Path>& file, SharedAvatar avatar) {
  const std::string from = path(file, "path");
  const py::gil_scoped_release free;
  auto rules = valueOf(readPairsFile(from, *avatar), from);
  return {std::move(avatar), std::move(rules)};
}

void save(const PairRules& own, const Shown<shown::Path>& file) {
  const std::string to = path(file, "path");
  const py::gil_scoped_release free;
  valueOf(writePairsFile(own.rules, *own.avatar, to), to);
}

py::list leftOutList(const PairRules& own) {
  const py::object type = pythonType("LeftOutPair");
  py::list list;
  for (const LeftOutPair& pair : own.rules.leftOut()) {
    list.append(
        type(nameOf(*own.avatar, pair.a), nameOf(*own.avatar, pair.b), toString(pair.reason)));
  }
  return list;
}

py::list radiusList(const PairRules& own) {
  const py::object type = pythonType("PairRadius");
  py::list list;
  for (const PairRadius& one : own.rules.radii()) {
    list.append(type(nameOf(*own.avatar, one.a), one.lssA, nameOf(*own.avatar, one.b), one.lssB,
                     one.radius));
  }
  return list;
}

py::list touchList(const PairRules& own) {
  const py::object type = pythonType("PairTouches");
  py::list list;
  for (const PairTouches& pair : own.rules.touches()) {
    list.append(type(nameOf(*own.avatar, pair.a), nameOf(*own.avatar, pair.b), pair.touches));
  }
  return list;
}

const char* reasonOf(const PairRules& own, const Shown<shown::Link>& a,
                     const Shown<shown::Link>& b) {
  const LinkId first = linkOf(*own.avatar, a, "a"), second = linkOf(*own.avatar, b, "b");
  if (first == second) refuse(ErrorCode::OutOfRange, "b", "expected two different links");
  return toString(own.rules.reasonOf(first, second));
}

std::string textOf(const PairRules& own) {
  return "<foretouch.PairRules: " + std::to_string(own.rules.numAsked()) + " of " +
         std::to_string(own.rules.numPairs()) + " pairs asked>";
}

}  // namespace

void bindPairRules(py::module_& module) {
  const PairRuleOptions usual;
  const RobotPairOptions ofRobotUsual;
  py::class_<PairRules>(module, "PairRules",
                        "Which pairs of an avatar's own links a query asks whether they touch.\n"
                        "Every pair that is left out is a hole in the proof, so each has a "
                        "reason. Immutable.")
      .def_static("derive", &derive, py::arg("avatar").none(false), py::kw_only(),
                  py::arg("usual_poses") = py::none(), py::arg("always_share") = usual.alwaysShare,
                  py::arg("pair_radii") = false, py::arg("rest_skin") = usual.restSkin,
                  py::arg("leave_out") = py::tuple(),
                  "Leaves out links of which one moves the other ('adjacent'), links that overlap\n"
                  "at rest ('rest-overlap'), links that touch in always_share of usual_poses\n"
                  "('always'), and the pairs of leave_out ('user'). pair_radii: LSS that overlap\n"
                  "at rest count with smaller radii instead, rest_skin metres apart there; only\n"
                  "for fidelity 'link'.")
      .def_static(
          "of_robot", &ofRobot, py::arg("robot").none(false), py::kw_only(),
          py::arg("samples") = ofRobotUsual.samples, py::arg("seed") = ofRobotUsual.seed,
          py::arg("always_share") = ofRobotUsual.alwaysShare, py::arg("leave_out") = py::tuple(),
          "For a Robot: from `samples` configurations drawn within its limits. Leaves out\n"
          "adjacent links, links that touch in always_share of the samples, and leave_out.\n"
          "Pairs that no sample touched are asked: `touches` has the counts.")
      .def_static("leaving_out", &leavingOut, py::arg("avatar").none(false), py::arg("left_out"),
                  py::arg("radii") = py::tuple(),
                  "Asks all pairs but those of left_out: (a, b) or (a, b, reason). radii:\n"
                  "(a, lss_a, b, lss_b, radius).")
      .def_static("asking", &asking, py::arg("avatar").none(false), py::arg("asked"),
                  "Asks only the pairs of the list, (a, b), and leaves out all others.")
      .def_static("exactly", &exactly, py::arg("avatar"), py::arg("left_out"),
                  py::arg("radii") = py::tuple(),
                  "Refused: asking() takes the pairs to ask, leaving_out() those to leave out.")
      .def_static("load", &load, py::arg("path"), py::arg("avatar").none(false),
                  "A file of foretouch avatar pairs.")
      .def("save", &save, py::arg("path"))
      .def("reason_of", &reasonOf, py::arg("a"), py::arg("b"),
           "'asked', or why the pair is left out.")
      .def_property_readonly("avatar", [](const PairRules& own) { return own.avatar; })
      .def_property_readonly(
          "num_pairs", [](const PairRules& own) { return own.rules.numPairs(); },
          "Of different links that both have LSS.")
      .def_property_readonly("num_asked", [](const PairRules& own) { return own.rules.numAsked(); })
      .def_property_readonly("left_out", &leftOutList)
      .def_property_readonly("radii", &radiusList)
      .def_property_readonly(
          "num_usual_poses", [](const PairRules& own) { return own.rules.numUsualPoses(); },
          "That the rules were derived from.")
      .def_property_readonly("touches", &touchList,
                             "Of every pair, in how many of these it touches.")
      .def("__repr__", &textOf);
}

}  // namespace foretouch::python
