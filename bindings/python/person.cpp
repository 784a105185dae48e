// bindings/python/person.cpp: foretouch.BracketQuery and read_bounds().
#include <array>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "articulated/motion_model.h"
#include "assets/bounds/bound_presets.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/int_enum.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "lss/index.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, MotionModel>, 3> kModels{
    {{"constant-rate", MotionModel::ConstantRate},
     {"cubic", MotionModel::Cubic},
     {"cubic-late", MotionModel::CubicLate}}};

PyObject* verdictType = nullptr;

py::object toPython(const LinkBound& bound) {
  return pythonType("LinkBound")(bound.error, bound.acceleration, bound.followFloor,
                                 bound.followShare, bound.speed, bound.aheadSpeed,
                                 bound.aheadAcceleration);
}

LinkBound boundFrom(py::handle given, const std::string& what) {
  if (!py::isinstance(given, pythonType("LinkBound"))) {
    refuse(ErrorCode::Mismatch, what, "expected a foretouch.LinkBound");
  }
  const auto value = [&](const char* name) { return number(given.attr(name), what + "." + name); };
  return {value("error"), value("acceleration"), value("follow_floor"),      value("follow_share"),
          value("speed"), value("ahead_speed"),  value("ahead_acceleration")};
}

/// One for all links, or one per link; the library judges their number and values.
std::vector<LinkBound> boundsFrom(py::handle given, const Avatar& avatar) {
  if (py::isinstance(given, pythonType("LinkBound"))) {
    return std::vector<LinkBound>(countOf(avatar.numLinks()), boundFrom(given, "bounds"));
  }
  std::vector<LinkBound> bounds;
  for (const py::object& one : items(given, "bounds")) {
    bounds.push_back(boundFrom(one, "bounds[" + std::to_string(bounds.size()) + "]"));
  }
  return bounds;
}

double secondsFrom(py::handle given) {
  constexpr double kMost = 1e6;
  const double seconds = number(given, "seconds");
  if (seconds > 0.0 && seconds <= kMost) return seconds;
  refuse(ErrorCode::OutOfRange, "seconds", "expected a number above 0 and at most 1e6");
}

/// What steps have in common, as numpy has it: one row per step, one column per link.
class BracketRows {
 public:
  BracketRows(std::size_t steps, std::size_t links)
      : verdicts_(shape(steps, links)),
        triangles_(shape(steps, links)),
        possible_(shape(steps, links, 2)),
        certain_(shape(steps, links, 2)),
        growths_(shape(steps, links)),
        to_{verdicts_.mutable_data(), triangles_.mutable_data(), possible_.mutable_data(),
            certain_.mutable_data(), growths_.mutable_data()} {}

  /// Needs no GIL.
  void add(const StepBrackets& step) {
    for (const LinkBracket& bracket : step.links) {
      *to_.verdict++ = static_cast<std::uint8_t>(bracket.verdict);
      *to_.triangle++ = bracket.triangle;
      *to_.growth++ = bracket.growth;
      addSpan(bracket.verdict >= BracketVerdict::Possible, bracket.possibleFrom,
              bracket.possibleUntil, to_.possible);
      addSpan(bracket.verdict == BracketVerdict::Certain, bracket.certainFrom, bracket.certainUntil,
              to_.certain);
    }
    for (const LinkBracket& bracket : step.pairs) pairs_.emplace_back(steps_, bracket);
    ++steps_;
  }

  [[nodiscard]] py::object toPython(const Avatar& avatar) const {
    py::list pairs;
    for (const auto& [step, bracket] : pairs_) {
      const bool isCertain = bracket.verdict == BracketVerdict::Certain;
      pairs.append(pythonType("PairBracket")(
          step, nameOf(avatar, bracket.link), nameOf(avatar, bracket.other),
          memberOf(verdictType, bracket.verdict),
          py::make_tuple(bracket.possibleFrom, bracket.possibleUntil),
          isCertain ? py::object(py::make_tuple(bracket.certainFrom, bracket.certainUntil))
                    : py::none()));
    }
    return pythonType("Brackets")(verdicts_, possible_, certain_, triangles_, growths_, pairs);
  }

 private:
  template <typename... Extents>
  static std::vector<py::ssize_t> shape(Extents... extents) {
    return {static_cast<py::ssize_t>(extents)...};
  }
  static void addSpan(bool isKnown, double from, double until, double*& to) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    *to++ = isKnown ? from : kNone;
    *to++ = isKnown ? until : kNone;
  }

  py::array_t<std::uint8_t> verdicts_;
  py::array_t<std::int32_t> triangles_;
  Numbers possible_, certain_, growths_;
  struct {
    std::uint8_t* verdict;
    std::int32_t* triangle;
    double *possible, *certain, *growth;
  } to_;
  std::vector<std::pair<std::size_t, LinkBracket>> pairs_;
  std::size_t steps_ = 0;
};

/// Any number of threads may use one at once: they take turns.
class PythonBracketQuery {
 public:
  PythonBracketQuery(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
                     const BracketOptions& options)
      : avatar_(std::move(avatar)),
        scene_(std::move(scene)),
        question_(valueOf(BracketQuery::build(*avatar_, *scene_, options))) {}

  [[nodiscard]] const std::shared_ptr<Avatar>& avatar() const { return avatar_; }
  [[nodiscard]] const std::shared_ptr<Scene>& scene() const { return scene_; }

  /// `ask(step, scratch, brackets)` for each of `steps`.
  template <typename Ask>
  [[nodiscard]] py::object answers(std::size_t steps, const Ask& ask) {
    BracketRows rows(steps, countOf(avatar_->numLinks()));
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> lock(mutex_);
      StepBrackets brackets;
      for (std::size_t step = 0; step < steps; ++step) {
        valueOf(ask(question_, step, scratch_, brackets));
        rows.add(brackets);
      }
    }
    return rows.toPython(*avatar_);
  }

 private:
  std::shared_ptr<Avatar> avatar_;
  std::shared_ptr<Scene> scene_;
  BracketQuery question_;
  std::mutex mutex_;
  Scratch scratch_;
};

std::unique_ptr<PythonBracketQuery> createQuery(
    std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene, Shown<shown::Text> fidelity,
    Shown<shown::Surface> surface, Shown<shown::Items> ignore, Shown<shown::PairRules> selfPairs,
    Shown<shown::Number> resolution, const py::object& workBudget) {
  BracketOptions options;
  const auto given = surfaceFrom(surface, *avatar);
  if (fidelityFrom(fidelity, "fidelity") == Fidelity::Exact) {
    if (!given) refuse(ErrorCode::Mismatch, "surface", "expected one at fidelity 'exact'");
    options.surface = given;
  }
  options.ignored = ignoredFrom(ignore, *avatar, *scene);
  options.self = rulesFrom(selfPairs, *avatar);
  options.resolution = number(resolution, "resolution");
  if (!workBudget.is_none()) {
    options.workBudget = static_cast<std::uint64_t>(
        integer(workBudget, "work_budget", 0, std::numeric_limits<std::int64_t>::max()));
  }
  return std::make_unique<PythonBracketQuery>(std::move(avatar), std::move(scene), options);
}

py::object answer(PythonBracketQuery& query, const Shown<shown::Poses>& given,
                  const py::object& boundsGiven, const Shown<shown::Number>& secondsGiven,
                  const Shown<shown::Text>& between) {
  const Avatar& avatar = *query.avatar();
  const std::vector<Pose> poses = posesFrom(avatar.skeleton(), given, "poses");
  if (poses.size() < 2) {
    refuse(ErrorCode::Empty, "poses",
           "expected at least two poses, found " + std::to_string(poses.size()));
  }
  const auto bounds = boundsFrom(boundsGiven, avatar);
  const double seconds = secondsFrom(secondsGiven);
  const MotionModel model = oneOf(between, "between", kModels);
  const auto poseOf = [&](std::size_t i) { return i < poses.size() ? &poses[i] : nullptr; };
  return query.answers(poses.size() - 1, [&](const BracketQuery& question, std::size_t i,
                                             Scratch& scratch, StepBrackets& brackets) {
    const PosedStep step{i > 0 ? poseOf(i - 1) : nullptr,
                         poseOf(i),
                         poseOf(i + 1),
                         model == MotionModel::CubicLate ? poseOf(i + 2) : nullptr,
                         seconds,
                         seconds,
                         seconds};
    return question.answer(step, model, bounds, scratch, brackets);
  });
}

/// A step between two poses alone.
struct TwoPoses {
  TwoPoses(const Avatar& avatar, py::handle start, py::handle end, py::handle seconds)
      : from(poseFrom(avatar.skeleton(), start, "start")),
        to(poseFrom(avatar.skeleton(), end, "end")),
        step{nullptr, &from, &to, nullptr, 0.0, secondsFrom(seconds), 0.0} {}
  TwoPoses(const TwoPoses&) = delete;
  TwoPoses& operator=(const TwoPoses&) = delete;
  Pose from, to;
  PosedStep step;
};

py::object answerGap(PythonBracketQuery& query, const Shown<shown::Pose>& start,
                     const Shown<shown::Pose>& end, const py::object& boundsGiven,
                     const Shown<shown::Number>& seconds) {
  const TwoPoses two(*query.avatar(), start, end, seconds);
  const auto bounds = boundsFrom(boundsGiven, *query.avatar());
  return query.answers(
      1, [&](const BracketQuery& question, std::size_t, Scratch& scratch, StepBrackets& brackets) {
        return question.answerGap(two.step, bounds, scratch, brackets);
      });
}

py::object lookAhead(PythonBracketQuery& query, const Shown<shown::Pose>& start,
                     const Shown<shown::Pose>& end, const py::object& boundsGiven,
                     const Shown<shown::Number>& seconds, const Shown<shown::Number>& given) {
  const TwoPoses two(*query.avatar(), start, end, seconds);
  const auto bounds = boundsFrom(boundsGiven, *query.avatar());
  const double horizon = number(given, "horizon");
  return query.answers(
      1, [&](const BracketQuery& question, std::size_t, Scratch& scratch, StepBrackets& brackets) {
        return question.lookAhead(two.step, horizon, bounds, scratch, brackets);
      });
}

py::list readBounds(const Shown<shown::Path>& given, const Avatar& avatar,
                    const Shown<shown::Text>& between, const Shown<shown::Number>& rateHz) {
  const std::string file = path(given, "path");
  const MotionModel model = oneOf(between, "between", kModels);
  const BoundsFile read = valueOf(foretouch::readBounds(file));
  const LinkBounds known =
      valueOf(inFile(boundsOf(read, avatar.skeleton(), model, number(rateHz, "rate_hz")), file));
  py::list bounds;
  for (const LinkBound& bound : known.bounds) bounds.append(toPython(bound));
  return bounds;
}

}  // namespace

void bindPerson(py::module_& module) {
  verdictType = addIntEnum(module, "BracketVerdict", membersOf<BracketVerdict>(4));
  module.def("read_bounds", &readBounds, py::arg("path"), py::arg("avatar"), py::kw_only(),
             py::arg("between"), py::arg("rate_hz"),
             "The bounds of a file (foretouch bounds learn), or of a preset of docs/person.md,\n"
             "as 'preset:optical': a list of LinkBound, one per link, for\n"
             "poses of this rate with 'constant-rate', 'cubic' or 'cubic-late' between them.");
  py::class_<PythonBracketQuery>(
      module, "BracketQuery",
      "What a person surely touched, may have touched and cannot have touched between poses,\n"
      "given how far they may be from a model of the motion. Any number of threads may ask one.")
      .def(py::init(&createQuery), py::arg("avatar").none(false), py::arg("scene").none(false),
           py::kw_only(), py::arg("fidelity") = "link", py::arg("surface") = py::none(),
           py::arg("ignore") = py::tuple(), py::arg("self_pairs") = py::none(),
           py::arg("resolution") = BracketOptions{}.resolution, py::arg("work_budget") = py::none(),
           "fidelity: 'link', or 'exact' (triangles, which are never certain; needs surface).\n"
           "ignore, self_pairs: as of a Query. resolution: metres; instants are as near to the\n"
           "true ones as that. work_budget: evaluations (about 10 ns each) that a step may cost;\n"
           "once it is spent, what is open is possible.")
      .def("answer", &answer, py::arg("poses"), py::arg("bounds"), py::kw_only(),
           py::arg("seconds"), py::arg("between") = "constant-rate",
           "Every step of poses that are `seconds` apart: Brackets. bounds: one LinkBound, or one\n"
           "per link. between: 'constant-rate', 'cubic', or 'cubic-late', which needs the pose\n"
           "after the step.")
      .def("answer_gap", &answerGap, py::arg("start"), py::arg("end"), py::arg("bounds"),
           py::kw_only(), py::arg("seconds"),
           "Between two poses whose neighbours were lost: Brackets of one step. Of the bounds,\n"
           "speed and error count.")
      .def("look_ahead", &lookAhead, py::arg("start"), py::arg("end"), py::arg("bounds"),
           py::kw_only(), py::arg("seconds"), py::arg("horizon"),
           "After the last two poses: Brackets of one step, in which t is 0 at `end` and 1 after\n"
           "`horizon` seconds. Links are excluded, or possible from possible[0, link, 0] on.")
      .def_property_readonly("avatar", &PythonBracketQuery::avatar)
      .def_property_readonly("scene", &PythonBracketQuery::scene);
}

}  // namespace foretouch::python
