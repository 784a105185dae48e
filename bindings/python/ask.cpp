// bindings/python/ask.cpp: World.probe(), what a ray, a cast or a shape meets at an instant; and
// World.fly(), what something that flies hits first.
#include <array>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/world.h"
#include "lss/index.h"
#include "middleware/ask/flight.h"

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
  constexpr const char* kWords[] = {"assumed", "silent", "not_there", "unresolved"};
  return kWords[slotOf(why)];
}

py::list toPython(const std::vector<UnknownBody>& bodies) {
  const py::object type = pythonType("UnknownBody");
  py::list unknown;
  for (const UnknownBody& body : bodies) unknown.append(type(body.body, wordOf(body.why)));
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

/// A point; (centre, radius); (a, b, radius).
Lss shapeFrom(py::handle given) {
  if (py::isinstance<py::tuple>(given)) {
    const auto tuple = py::reinterpret_borrow<py::tuple>(given);
    if (tuple.size() == 2) {
      const Eigen::Vector3d centre = point(tuple[0], "shape");
      return {centre, centre, number(tuple[1], "shape")};
    }
    if (tuple.size() == 3 && PyNumber_Check(tuple[0].ptr()) == 0) return lssFrom(given, "shape");
  }
  const Eigen::Vector3d place = point(given, "shape");
  return {place, place, 0.0};
}

/// Whom a question is about.
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

/// What a thread's questions keep: of the world that it asked last.
Scratch& scratchOfThread() {
  thread_local Scratch scratch;
  return scratch;
}

py::object probe(World& world, const py::object& time, const py::object& shape,
                 const py::object& direction, const Shown<shown::Number>& reach,
                 const py::object& within, const Shown<shown::Text>& which, const py::object& only,
                 const py::object& without, const py::object& instants, const py::object& groups,
                 const Shown<shown::Truth>& still) {
  WorldQuestion question;
  question.time = timeFrom(time, "utime_us");
  question.shape = shapeFrom(shape);
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

py::object fly(World& world, const Shown<shown::Integer>& fromUs, const Shown<shown::Integer>& toUs,
               const py::object& shape, const Shown<shown::Array>& way, const py::object& only,
               const py::object& without, const py::object& groups,
               const Shown<shown::Truth>& still) {
  FlightQuestion question;
  question.fromUs = instantFrom(fromUs, "from_us");
  question.toUs = instantFrom(toUs, "to_us");
  question.shape = shapeFrom(shape);
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
      py::arg("groups") = py::none(), py::arg("still") = true,
      "What a shape meets at an instant: WorldAnswer. With a direction, what it hits on its way;\n"
      "within a distance, what is nearest to it; else what it overlaps. shape: a point,\n"
      "(centre, radius) or (a, b, radius). utime_us: microseconds, or (microseconds, fraction).");
  module.attr("World").attr("fly") = py::cpp_function(
      &fly, py::name("fly"), py::is_method(module.attr("World")), py::arg("from_us"),
      py::arg("to_us"), py::arg("shape"), py::arg("way"), py::kw_only(),
      py::arg("only") = py::none(), py::arg("without") = py::none(), py::arg("groups") = py::none(),
      py::arg("still") = true,
      "What a shape that flies straight by `way` hits first while the bodies move: FlightAnswer.");
}

}  // namespace foretouch::python
