// bindings/python/ask.cpp: World.probe(), what a ray, a cast or a shape meets at an instant;
// World.probe_many(), the same of arrays of them; and World.fly(), what something that flies hits
// first.
#include "middleware/ask/ask.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/world.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, AskWhich>, 3> kWhich{
    {{"closest", AskWhich::Closest}, {"any", AskWhich::Any}, {"all", AskWhich::All}}};

/// None: what stands still; a body; (body, link); (body or None, None, object).
AskPart partFrom(World& world, py::handle given, const char* what) {
  AskPart part;
  if (given.is_none()) return part;
  if (!py::isinstance<py::tuple>(given)) {
    part.body = smallInteger(given, what);
    return part;
  }
  const auto tuple = py::reinterpret_borrow<py::tuple>(given);
  if (tuple.empty() || tuple.size() > 3) {
    refuse(ErrorCode::Mismatch, what, "expected (body, link) or (body, link, object)");
  }
  if (!tuple[0].is_none()) part.body = smallInteger(tuple[0], what);
  if (tuple.size() > 1 && !tuple[1].is_none()) {
    const BodyShape shape = part.body < 0 ? BodyShape{} : world.shape(part.body);
    part.link = shape.avatar ? linkOf(*shape.avatar, tuple[1], what) : smallInteger(tuple[1], what);
  }
  if (tuple.size() > 2 && !tuple[2].is_none()) part.object = smallInteger(tuple[2], what);
  return part;
}

void appendParts(World& world, const py::object& given, const char* what,
                 std::vector<AskPart>& parts) {
  if (given.is_none()) return;
  for (const py::object& item : items(given, what)) parts.push_back(partFrom(world, item, what));
}

/// Whole microseconds and a fraction of one.
WorldTime timeFrom(py::handle given, const char* what) {
  if (!py::isinstance<py::tuple>(given)) return {instantFrom(given, what), 0.0};
  const auto tuple = py::reinterpret_borrow<py::tuple>(given);
  if (tuple.size() != 2) refuse(ErrorCode::Mismatch, what, "expected (microseconds, fraction)");
  return {instantFrom(tuple[0], what), number(tuple[1], what)};
}

std::uint32_t groupsFrom(const py::object& given) {
  if (given.is_none()) return ~std::uint32_t{0};
  std::uint32_t groups = 0;
  for (const py::object& item : items(given, "groups")) {
    const std::int64_t group = integer(item, "groups", 0, kNumBodyGroups - 1);
    groups |= std::uint32_t{1} << static_cast<unsigned>(group);
  }
  return groups;
}

const char* wordOf(AskVerdict verdict) {
  if (verdict == AskVerdict::Hit) return "hit";
  return verdict == AskVerdict::Clear ? "clear" : "unknown";
}

const char* wordOf(AskUnknown why) {
  constexpr const char* kWords[] = {"assumed", "silent", "not_there", "unresolved", "open"};
  return kWords[slotOf(why)];
}

py::list toPython(const std::vector<UnknownBody>& bodies) {
  const py::object type = pythonType("UnknownBody");
  py::list unknown;
  for (const UnknownBody& body : bodies) {
    const bool isStill = body.body == kStillScene, isWhole = body.object == kEveryObject;
    unknown.append(type(isStill ? py::object(py::none()) : py::object(py::int_(body.body)),
                        wordOf(body.why),
                        isWhole ? py::object(py::none()) : py::object(py::int_(body.object))));
  }
  return unknown;
}

py::object toPython(World& world, const WorldHit& hit) {
  const bool hasWeights = hit.what.triangle >= 0;
  return pythonType("WorldHit")(
      hit.distance, sideToPython(hit.what, hit.object, world.still().get(), *world.shapes()),
      Numbers(3, hit.nhat_W.data()),
      hasWeights ? py::object(Numbers(3, hit.weights.data())) : py::object(py::none()),
      hit.isAssumed);
}

py::object toPython(World& world, const WorldAnswer& answer) {
  py::list hits;
  for (const WorldHit& hit : answer.hits) hits.append(toPython(world, hit));
  return pythonType("WorldAnswer")(wordOf(answer.verdict()), hits, toPython(answer.unknown),
                                   answer.isComplete());
}

std::vector<Eigen::Vector3d> pointsFrom(py::handle given, const char* what) {
  const Numbers rows = numbers(given, what, {kAny, 3});
  std::vector<Eigen::Vector3d> points;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    points.emplace_back(Eigen::Map<const Eigen::Vector3d>(rows.data(i, 0)));
  }
  return points;
}

bool isRows(py::handle given) {
  return py::isinstance<py::array>(given) && py::reinterpret_borrow<py::array>(given).ndim() == 2;
}

/// A point; (centre, radius); (a, b, radius); an array of corners (n, 3), or (corners, radius).
void readShape(py::handle given, Lss& shape, std::vector<Eigen::Vector3d>& hull) {
  shape = Lss{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
  py::object place = py::reinterpret_borrow<py::object>(given);
  if (py::isinstance<py::tuple>(given)) {
    const auto tuple = py::reinterpret_borrow<py::tuple>(given);
    // An array counts as a number, too.
    if (tuple.size() == 3 && PySequence_Check(tuple[0].ptr()) != 0) {
      shape = lssFrom(given, "shape");
      return;
    }
    if (tuple.size() == 2) {
      place = tuple[0];
      shape.radius = number(tuple[1], "shape");
    }
  }
  if (isRows(place)) {
    hull = pointsFrom(place, "shape");
    if (hull.empty()) refuse(ErrorCode::Empty, "shape", "expected corners, found none");
  } else {
    shape.a = shape.b = point(place, "shape");
  }
}

/// What a question is about.
struct Whom {
  const py::object &only, &without, &groups;
  const Shown<shown::Truth>& still;
};

void complete(World& world, const Whom& whom, AskWhom& question) {
  question.groups = groupsFrom(whom.groups);
  question.asksStill = whom.still.cast<bool>();
  appendParts(world, whom.only, "only", question.only);
  appendParts(world, whom.without, "without", question.without);
}

/// What a thread's questions keep, for the world that it asked last.
Scratch& scratchOfThread() {
  thread_local Scratch scratch;
  return scratch;
}

py::object probe(World& world, const py::object& time, const py::object& shape,
                 const py::object& direction, const Shown<shown::Number>& reach,
                 const py::object& within, const Shown<shown::Text>& which, const py::object& only,
                 const py::object& without, const py::object& instants, const py::object& groups,
                 const Shown<shown::Truth>& still, const Shown<shown::Truth>& solids) {
  WorldQuestion question;
  question.time = timeFrom(time, "utime_us");
  readShape(shape, question.shape, question.hull);
  question.solids = solids.cast<bool>();
  if (!direction.is_none() && !within.is_none()) {
    refuse(ErrorCode::Mismatch, "within", "expected a direction or a distance within, found both");
  }
  question.what = !direction.is_none() ? AskWhat::Cast
                  : !within.is_none()  ? AskWhat::Nearest
                                       : AskWhat::Overlap;
  if (!direction.is_none()) question.direction = point(direction, "direction");
  question.reach = within.is_none() ? number(reach, "reach") : number(within, "within");
  question.which = oneOf(which, "which", kWhich);
  complete(world, {only, without, groups, still}, question);
  if (!instants.is_none()) {
    for (const auto& [body, seen] : mapping(instants, "instants")) {
      question.instants.push_back({smallInteger(body, "instants"), timeFrom(seen, "instants")});
    }
  }
  WorldAnswer answer;
  Scratch& scratch = scratchOfThread();
  world.with("probe",
             [&](foretouch::World& of) { return askWorld(of, question, scratch, answer); });
  return toPython(world, answer);
}

/// One for all, or one per question: the i-th.
class PerQuestion {
 public:
  PerQuestion(py::handle given, const char* what, py::ssize_t count)
      : isOne_(PyNumber_Check(given.ptr()) != 0 && !py::isinstance<py::array>(given)),
        values_(isOne_ ? Numbers(1) : numbers(given, what, {count})) {
    if (isOne_) *values_.mutable_data() = number(given, what);
  }
  [[nodiscard]] double at(py::ssize_t i) const { return values_.data()[isOne_ ? 0 : i]; }

 private:
  bool isOne_;
  Numbers values_;
};

class PerQuestionTime {
 public:
  PerQuestionTime(py::handle given, const char* what, py::ssize_t count) {
    if (py::isinstance<py::array>(given) || py::isinstance<py::list>(given)) {
      values_ = integers(given, what, {count});
    } else {
      one_ = timeFrom(given, what);
    }
  }
  [[nodiscard]] WorldTime at(py::ssize_t i) const {
    return values_.size() > 0 ? WorldTime{values_.data()[i], 0.0} : one_;
  }

 private:
  Integers values_;
  WorldTime one_;
};

Eigen::Vector3d rowOf(const Numbers& rows, py::ssize_t i) {
  return Eigen::Map<const Eigen::Vector3d>(rows.data(i, 0));
}

/// One value per answer: of its first hit, or what there is without one.
template <typename Value, typename Of>
py::array_t<Value> columnOf(const std::vector<WorldAnswer>& answers, Value without, const Of& of) {
  py::array_t<Value> made(static_cast<py::ssize_t>(answers.size()));
  Value* const values = made.mutable_data();
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto& hits = answers[i].hits;
    values[i] = hits.empty() ? without : static_cast<Value>(of(hits.front()));
  }
  return made;
}

template <typename Of>
Numbers rowsOf(const std::vector<WorldAnswer>& answers, const Of& of) {
  Numbers made({static_cast<py::ssize_t>(answers.size()), py::ssize_t{3}});
  double* values = made.mutable_data();
  for (const WorldAnswer& answer : answers) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *values++ = answer.hits.empty() ? std::numeric_limits<double>::quiet_NaN()
                                      : of(answer.hits.front(), axis);
    }
  }
  return made;
}

py::object toPython(const std::vector<WorldAnswer>& answers) {
  py::array_t<std::uint8_t> verdicts(static_cast<py::ssize_t>(answers.size()));
  py::array_t<bool> complete(static_cast<py::ssize_t>(answers.size()));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    verdicts.mutable_data()[i] = static_cast<std::uint8_t>(answers[i].verdict());
    complete.mutable_data()[i] = answers[i].isComplete();
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto number = [&](auto of) { return columnOf<std::int32_t>(answers, -1, of); };
  return pythonType("WorldAnswers")(
      verdicts, columnOf<double>(answers, kNone, [](const WorldHit& hit) { return hit.distance; }),
      number([](const WorldHit& hit) { return hit.what.body; }),
      number([](const WorldHit& hit) { return hit.what.link; }),
      number([](const WorldHit& hit) { return hit.what.lss; }),
      number([](const WorldHit& hit) { return hit.what.triangle; }),
      number([](const WorldHit& hit) { return hit.object; }),
      rowsOf(answers,
             [](const WorldHit& hit, std::size_t axis) {
               return hit.what.p_W[static_cast<Eigen::Index>(axis)];
             }),
      rowsOf(answers, [](const WorldHit& hit,
                         std::size_t axis) { return hit.nhat_W[static_cast<Eigen::Index>(axis)]; }),
      rowsOf(answers, [](const WorldHit& hit, std::size_t axis) { return hit.weights[axis]; }),
      columnOf<bool>(answers, false, [](const WorldHit& hit) { return hit.isAssumed; }), complete);
}

std::vector<std::pair<BodyId, PerQuestionTime>> instantsFrom(const py::object& given,
                                                             py::ssize_t count) {
  std::vector<std::pair<BodyId, PerQuestionTime>> all;
  if (given.is_none()) return all;
  for (const auto& [body, seen] : mapping(given, "instants")) {
    all.emplace_back(smallInteger(body, "instants"), PerQuestionTime(seen, "instants", count));
  }
  return all;
}

py::object probeMany(World& world, const py::object& time, const Shown<shown::Array>& a,
                     const py::object& b, const py::object& radius, const py::object& hull,
                     const py::object& direction, const py::object& reach, const py::object& within,
                     const Shown<shown::Text>& which, const py::object& only,
                     const py::object& without, const py::object& instants,
                     const py::object& groups, const Shown<shown::Truth>& still,
                     const Shown<shown::Truth>& solids) {
  const Numbers from = numbers(a, "a", {kAny, 3});
  const py::ssize_t count = from.shape(0);
  if (!direction.is_none() && !within.is_none()) {
    refuse(ErrorCode::Mismatch, "within", "expected a direction or a distance within, found both");
  }
  WorldQuestion common;
  common.what = !direction.is_none() ? AskWhat::Cast
                : !within.is_none()  ? AskWhat::Nearest
                                     : AskWhat::Overlap;
  common.which = oneOf(which, "which", kWhich);
  if (common.which == AskWhich::All) {
    refuse(ErrorCode::OutOfRange, "which", "expected 'closest' or 'any': arrays have one hit each");
  }
  common.solids = solids.cast<bool>();
  if (!hull.is_none()) common.hull = pointsFrom(hull, "hull");
  complete(world, {only, without, groups, still}, common);
  const Numbers to = b.is_none() ? from : numbers(b, "b", {count, 3});
  const Numbers ways =
      direction.is_none() ? Numbers() : numbers(direction, "direction", {count, 3});
  const PerQuestion radii(radius, "radius", count);
  const PerQuestion reaches(within.is_none() ? reach : within,
                            within.is_none() ? "reach" : "within", count);
  const PerQuestionTime times(time, "utime_us", count);
  const auto seen = instantsFrom(instants, count);
  std::vector<WorldQuestion> questions(static_cast<std::size_t>(count), common);
  for (py::ssize_t i = 0; i < count; ++i) {
    WorldQuestion& question = questions[static_cast<std::size_t>(i)];
    question.shape = {rowOf(from, i), rowOf(to, i), radii.at(i)};
    if (!direction.is_none()) question.direction = rowOf(ways, i);
    question.reach = reaches.at(i);
    question.time = times.at(i);
    for (const auto& [body, at] : seen) question.instants.push_back({body, at.at(i)});
  }
  std::vector<WorldAnswer> answers;
  Scratch& scratch = scratchOfThread();
  world.with("probe_many",
             [&](foretouch::World& of) { return askWorld(of, questions, scratch, answers); });
  return toPython(answers);
}

py::object fly(World& world, const Shown<shown::Integer>& fromUs, const Shown<shown::Integer>& toUs,
               const py::object& shape, const Shown<shown::Array>& way, const py::object& only,
               const py::object& without, const py::object& groups,
               const Shown<shown::Truth>& still) {
  FlightQuestion question;
  question.fromUs = instantFrom(fromUs, "from_us");
  question.toUs = instantFrom(toUs, "to_us");
  readShape(shape, question.shape, question.hull);
  question.way = point(way, "way");
  complete(world, {only, without, groups, still}, question);
  FlightAnswer answer;
  Scratch& scratch = scratchOfThread();
  world.with("fly", [&](foretouch::World& of) { return askFlight(of, question, scratch, answer); });
  const py::object none = py::none();
  const auto& first = answer.first;
  return pythonType("FlightAnswer")(
      wordOf(answer.verdict()), first ? toPython(world, first->hit) : none,
      first ? py::object(py::int_(first->time.us)) : none,
      first ? py::object(py::float_(first->time.fraction)) : none, toPython(answer.unknown));
}

}  // namespace

void bindAsk(py::module_& module) {
  module.attr("World").attr("probe") = py::cpp_function(
      &probe, py::name("probe"), py::is_method(module.attr("World")), py::arg("utime_us"),
      py::arg("shape"), py::kw_only(), py::arg("direction") = py::none(), py::arg("reach") = 1000.0,
      py::arg("within") = py::none(), py::arg("which") = "closest", py::arg("only") = py::none(),
      py::arg("without") = py::none(), py::arg("instants") = py::none(),
      py::arg("groups") = py::none(), py::arg("still") = true, py::arg("solids") = false,
      "What a shape meets at an instant: WorldAnswer. With a direction, what it hits on its way;\n"
      "within a distance, what is nearest to it; else what it overlaps. shape: a point,\n"
      "(centre, radius), (a, b, radius), or an array of a convex solid's corners (n, 3), which "
      "may\n"
      "have a radius too. solids: closed objects have an inside. utime_us: microseconds, or\n"
      "(microseconds, fraction).");
  module.attr("World").attr("probe_many") = py::cpp_function(
      &probeMany, py::name("probe_many"), py::is_method(module.attr("World")), py::arg("utime_us"),
      py::arg("a"), py::kw_only(), py::arg("b") = py::none(), py::arg("radius") = 0.0,
      py::arg("hull") = py::none(), py::arg("direction") = py::none(), py::arg("reach") = 1000.0,
      py::arg("within") = py::none(), py::arg("which") = "closest", py::arg("only") = py::none(),
      py::arg("without") = py::none(), py::arg("instants") = py::none(),
      py::arg("groups") = py::none(), py::arg("still") = true, py::arg("solids") = false,
      "n questions in one call, of shapes from a to b: WorldAnswers, whose arrays have the first\n"
      "hit of each, to the bit that of probe(). What may be one number for all may be n of them.\n"
      "hull: corners from a, the same for all. instants: a body's, one for all or n.");
  module.attr("World").attr("fly") = py::cpp_function(
      &fly, py::name("fly"), py::is_method(module.attr("World")), py::arg("from_us"),
      py::arg("to_us"), py::arg("shape"), py::arg("way"), py::kw_only(),
      py::arg("only") = py::none(), py::arg("without") = py::none(), py::arg("groups") = py::none(),
      py::arg("still") = true,
      "What a shape that flies straight by `way` hits first while the bodies move: FlightAnswer.");
}

}  // namespace foretouch::python
