// bindings/python/follower.cpp: foretouch.Follower, and what it reports as plain data.
#include <limits>
#include <memory>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "bindings/python/world.h"
#include "lss/index.h"
#include "middleware/events/told_depth.h"
#include "middleware/events/world_follower.h"
#include "middleware/mechanics/mass.h"
#include "middleware/worker_pool.h"

namespace foretouch::python {
namespace {

std::int64_t followedInstant(py::handle given, const char* what) {
  return integer(given, what, -kMostUtimeUs, kMostUtimeUs);
}

FollowOptions followOptions(const Shown<shown::Integer>& threads,
                            const Shown<shown::Integer>& cutUs) {
  FollowOptions options;
  options.threads = static_cast<int>(integer(threads, "threads", 1, kMaxPoolThreads));
  options.cutUs = integer(cutUs, "cut_us", 0, kMostCutUs);
  return options;
}

template <typename T>
T followedValue(Result<T> result) {
  if (!result.ok()) throw Failure(result.error());
  return std::move(result).value();
}

/// A world's events as Python has them.
class Tales {
 public:
  Tales(const Scene* still, const BodyShapes& shapes) : still_(still), shapes_(shapes) {}

  [[nodiscard]] py::list events(const std::vector<WorldEvent>& events) const {
    const py::object type = pythonType("WorldEvent"), pointType = pythonType("EventPoint");
    py::list all;
    for (const WorldEvent& e : events) {
      py::list points;
      for (std::size_t i = 0; i < e.numPoints; ++i) {
        points.append(pointType(Numbers(3, e.points[i].p_WA.data()),
                                Numbers(3, e.points[i].p_WB.data()), e.points[i].separation));
      }
      const auto isOf = [&](LeaveCause cause) {
        return e.kind == EventKind::Leave && e.cause == cause;
      };
      all.append(type(toString(e.kind), e.time.us, e.time.fraction, e.since.us, e.since.fraction,
                      sideOf(e.a, e.object), sideOf(e.b, e.object), e.separation,
                      depthOrNone(toldDepth(e)), Numbers(3, e.nhat_BA_W.data()),
                      Numbers(3, e.velocity_W.data()), e.approachSpeed, e.approachLower,
                      e.approachUpper, e.effectiveMass, points, reasonOf(e.reason),
                      isOf(LeaveCause::NotAsked), e.isAssumed, isOf(LeaveCause::Moved)));
    }
    return all;
  }

  [[nodiscard]] py::list parts(const std::vector<WorldPart>& parts) const {
    const py::object type = pythonType("WorldPart");
    py::list all;
    for (const WorldPart& p : parts) {
      all.append(type(kindOf(p.kind), p.from.us, p.from.fraction, p.to.us, p.to.fraction,
                      p.since.us, p.since.fraction, sideOf(p.a, p.object), sideOf(p.b, p.object),
                      reasonOf(p.reason), p.beganBefore, p.goesOn, p.isAssumed));
    }
    return all;
  }

  [[nodiscard]] py::list open(const std::vector<OpenPart>& parts) const {
    const py::object type = pythonType("OpenPart");
    py::list all;
    for (const OpenPart& p : parts) {
      all.append(type(kindOf(p.kind), p.since.us, p.since.fraction, sideOf(p.a, p.object),
                      sideOf(p.b, p.object), reasonOf(p.reason), p.isAssumed));
    }
    return all;
  }

 private:
  static const char* kindOf(PartKind kind) {
    return kind == PartKind::Contact ? "contact" : "unresolved";
  }
  static py::object reasonOf(UndecidedReason reason) {
    if (reason == UndecidedReason::None) return py::none();
    return py::str(toString(reason));
  }

  [[nodiscard]] py::object sideOf(const ContactSide& side, ObjectId object) const {
    return sideToPython(side, object, still_, shapes_);
  }

  const Scene* still_;
  const BodyShapes& shapes_;
};

class Follower {
 public:
  Follower(World& world, std::int64_t fromUs, const FollowOptions& options)
      : world_(world), follower_(followedValue(WorldFollower::start(fromUs, options))) {}

  /// Weighs a rigid body.
  void weigh(BodyId body, const Mass& mass) {
    world_.with("body", [&](foretouch::World&) { return follower_.weigh(body, mass); });
  }
  /// Weighs an avatar: its LSS weigh so much in all.
  void weighLss(BodyId body, const Avatar& avatar, double kg) {
    world_.with("kg", [&](foretouch::World&) -> Result<Done> {
      auto masses = massesOfLinks(avatar, kg);
      if (!masses.ok()) return masses.error();
      if (avatar.numLinks() == 1) return follower_.weigh(body, masses.value().front());
      auto mass = AvatarMass::build(avatar.skeleton(), std::move(masses).value());
      if (!mass.ok()) return mass.error();
      return follower_.weigh(body, std::move(mass).value());
    });
  }

  [[nodiscard]] py::object follow(std::int64_t untilUs) {
    world_.with("until_us",
                [&](foretouch::World& world) { return follower_.follow(world, untilUs, answer_); });
    return toPython(answer_, world_);
  }

  [[nodiscard]] py::list open() {
    const auto shapes = world_.shapes();
    return Tales(world_.still().get(), *shapes).open(follower_.open());
  }
  [[nodiscard]] std::int64_t followedUntilUs() const { return follower_.followedUntilUs(); }
  [[nodiscard]] World& world() { return world_; }

 private:
  World& world_;
  WorldFollower follower_;
  WorldEvents answer_;
};

void weighBody(Follower& follower, const Shown<shown::Integer>& body,
               const Shown<shown::Number>& kg, const py::object& center,
               const py::object& inertia) {
  using Limits = std::numeric_limits<std::int32_t>;
  const auto id = static_cast<BodyId>(integer(body, "body", Limits::min(), Limits::max()));
  const BodyShape shape = follower.world().shape(id);
  const double weight = number(kg, "kg");
  if (center.is_none() != inertia.is_none()) {
    refuse(ErrorCode::Mismatch, center.is_none() ? "center" : "inertia",
           "expected both center and inertia, or none of them");
  }
  if (center.is_none()) {
    if (shape.avatar) return follower.weighLss(id, *shape.avatar, weight);
    refuse(ErrorCode::Mismatch, "center", "expected center and inertia of a body of triangles");
  }
  Mass mass;
  mass.kg = weight;
  mass.center_B = point(center, "center");
  const Numbers given = numbers(inertia, "inertia", {3, 3});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      mass.inertia_B(row, column) = *given.data(row, column);
    }
  }
  follower.weigh(id, mass);
}

}  // namespace

py::object toPython(const WorldEvents& events, World& world) {
  const auto shapes = world.shapes();
  const Tales tales(world.still().get(), *shapes);
  py::list silent;
  const py::object silentType = pythonType("SilentBody");
  for (const SilentBody& one : events.silent) {
    silent.append(silentType(one.body, one.sinceUs, toString(one.takenTo)));
  }
  return pythonType("WorldEvents")(events.fromUs, events.toUs, tales.events(events.events),
                                   tales.parts(events.parts), silent);
}

void bindFollower(py::module_& module) {
  module.attr("EVERY_BODY") = kEveryBody;
  py::class_<Follower>(
      module, "Follower",
      "Follows a world from an instant on: who enters and leaves whom, each once, at its own\n"
      "instant, however many happen between two poses. Nothing before is told.")
      .def(py::init([](World& world, const Shown<shown::Integer>& fromUs,
                       const Shown<shown::Integer>& threads, const Shown<shown::Integer>& cutUs) {
             return std::make_unique<Follower>(world, followedInstant(fromUs, "from_us"),
                                               followOptions(threads, cutUs));
           }),
           py::arg("world"), py::arg("from_us"), py::kw_only(), py::arg("threads") = 1,
           py::arg("cut_us") = 0, py::keep_alive<1, 2>())
      .def("weigh", &weighBody, py::arg("body"), py::arg("kg"), py::kw_only(),
           py::arg("center") = py::none(), py::arg("inertia") = py::none(),
           "What a body weighs, for effective masses: its LSS in all, or a rigid body with its\n"
           "center (3,) and inertia (3, 3) about that, in its frame. Others are moved by nothing.")
      .def(
          "follow",
          [](Follower& follower, const Shown<shown::Integer>& untilUs) {
            return follower.follow(followedInstant(untilUs, "until_us"));
          },
          py::arg("until_us"),
          "Everything that happens from where the last call ended until then: WorldEvents.")
      .def_property_readonly("open", &Follower::open,
                             "Who is in contact where the last follow() ended, and since when.")
      .def_property_readonly("followed_until", &Follower::followedUntilUs,
                             "Where the last follow() ended, microseconds.");
}

}  // namespace foretouch::python
