// bindings/python/world.cpp: foretouch.World.
#include "bindings/python/world.h"

#include <array>
#include <limits>
#include <pybind11/stl.h>
#include <type_traits>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "bindings/python/surface.h"
#include "bindings/snake_case.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, WhenSilent>, 3> kSilences{
    {{"wait", WhenSilent::Wait},
     {"hold-still", WhenSilent::HoldStill},
     {"undecided", WhenSilent::Undecided}}};

/// An error about an option or argument is one about its keyword.
template <typename T>
T worldValue(Result<T> result) {
  if (result.ok()) return std::move(result).value();
  Error error = result.error();
  error.file = snakeCase(error.file);
  if (error.file == "utime") error.file = "utime_us";
  if (error.file == "self") error.file = "self_pairs";
  throw Failure(error);
}

}  // namespace

World::World(std::shared_ptr<const Scene> still, const WorldOptions& options)
    : still_(std::move(still)),
      tolerance_(options.tolerance),
      own_(worldValue(
          foretouch::World::build(still_ ? std::optional<Scene>(*still_) : std::nullopt, options))),
      world_(*own_) {}

World::World(std::shared_ptr<const Scene> still, const WorldOptions& options,
             foretouch::World& world)
    : still_(std::move(still)), tolerance_(options.tolerance), world_(world) {}

template <typename Call>
auto World::change(const char* place, const Call& call) {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return worldValue(inFile(call(), place));
}

void World::with(const char* place, const std::function<Result<Done>(foretouch::World&)>& call) {
  change(place, [&] { return call(world_); });
}

BodyId World::addWith(BodyShape shape,
                      const std::function<Result<BodyId>(foretouch::World&)>& call) {
  return change("add", [&]() -> Result<BodyId> {
    auto shapes = std::make_shared<BodyShapes>(*shapes_);
    shapes->push_back(std::move(shape));
    auto body = call(world_);
    if (body.ok()) shapes_ = std::move(shapes);
    return body;
  });
}

BodyId World::add(BodyShape shape, const BodyOptions& options) {
  return addWith(shape, [&](foretouch::World& world) {
    return shape.avatar ? world.add(*shape.avatar, options) : world.add(*shape.mesh, options);
  });
}

void World::push(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  change("pose", [&] { return world_.push(body, utimeUs, pose); });
}

void World::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const Pose& pose) {
  change("pose", [&] { return world_.attach(body, carrier, utimeUs, pose); });
}

void World::detach(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  change("pose", [&] { return world_.detach(body, utimeUs, pose); });
}

void World::ask(BodyGroup a, BodyGroup b, bool isAsked) {
  change("", [&] { return world_.ask(a, b, isAsked); });
}

void World::askStill(BodyGroup group, bool isAsked) {
  change("", [&] { return world_.askStill(group, isAsked); });
}

void World::forgetBefore(std::int64_t utimeUs) {
  change("", [&]() -> Result<Done> {
    world_.forgetBefore(utimeUs);
    return Done{};
  });
}

std::int64_t World::forgetBeyond(std::size_t bytes) {
  std::int64_t us = 0;
  change("", [&]() -> Result<Done> {
    us = world_.forgetBeyond(bytes);
    return Done{};
  });
  return us;
}

void World::thinBefore(std::int64_t utimeUs, double metres) {
  change("", [&] { return world_.thinBefore(utimeUs, metres); });
}

std::size_t World::poseBytes() {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return world_.poseBytes();
}

std::optional<std::int64_t> World::knownUntilUs() {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return world_.knownUntilUs();
}

std::optional<BodyId> World::waitsFor() {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return world_.waitsFor();
}

foretouch::WorldContacts World::contacts(std::int64_t fromUs, std::int64_t toUs) {
  foretouch::WorldContacts answer;
  change("window", [&] {
    if (isScratchSuspect_) scratch_ = Scratch();
    isScratchSuspect_ = true;
    auto done = world_.contacts(fromUs, toUs, scratch_, answer);
    isScratchSuspect_ = false;
    return done;
  });
  return answer;
}

std::shared_ptr<const BodyShapes> World::shapes() {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return shapes_;
}

BodyShape World::shape(BodyId body) {
  const auto all = shapes();
  if (body >= 0 && slotOf(body) < all->size()) return (*all)[slotOf(body)];
  refuse(ErrorCode::UnknownName, "body",
         "expected one of the " + std::to_string(all->size()) + " that were added, found " +
             std::to_string(body),
         body);
}

std::int32_t smallInteger(py::handle given, const char* what) {
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(integer(given, what, Limits::min(), Limits::max()));
}

std::int64_t instantFrom(py::handle given, const char* what) {
  return integer(given, what, -kMostUtimeUs, kMostUtimeUs);
}

WorldOptions worldOptionsFrom(const py::object& tolerance, const py::object& askMeshes,
                              const py::object& workPerPair, const py::object& workPerWindow,
                              const py::object& mostNear) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  WorldOptions options;
  options.tolerance = number(tolerance, "tolerance");
  options.askMeshes = boolean(askMeshes, "ask_meshes");
  options.workPerPair = static_cast<std::uint64_t>(integer(workPerPair, "work_per_pair", 0, kMost));
  if (!workPerWindow.is_none()) {
    options.workPerWindow =
        static_cast<std::uint64_t>(integer(workPerWindow, "work_per_window", 0, kMost));
  }
  if (!mostNear.is_none()) {
    options.mostNear = static_cast<std::size_t>(integer(mostNear, "most_near", 0, kMost));
  }
  return options;
}

WhenSilent whenSilentFrom(const py::object& given) {
  return oneOf(given, "when_silent", kSilences);
}

namespace {

Pose bodyPose(World& world, BodyId body, const py::object& given) {
  const BodyShape shape = world.shape(body);
  const Skeleton& skeleton = shape.avatar ? shape.avatar->skeleton() : skeletonOfProp();
  return poseFrom(skeleton, skeleton.numJoints() == 1 ? withJointAxis(given) : given, "pose");
}

std::unique_ptr<World> createWorld(std::shared_ptr<Scene> still,
                                   const Shown<shown::Number>& tolerance,
                                   const Shown<shown::Truth>& askMeshes,
                                   const Shown<shown::Integer>& workPerPair,
                                   const Shown<shown::Integer>& workPerWindow,
                                   const Shown<shown::Integer>& mostNear) {
  return std::make_unique<World>(
      std::move(still),
      worldOptionsFrom(tolerance, askMeshes, workPerPair, workPerWindow, mostNear));
}

BodyId addBody(World& world, const py::object& shape, const Shown<shown::Integer>& group,
               const Shown<shown::Text>& whenSilent, const Shown<shown::PairRules>& selfPairs,
               const Shown<shown::Surface>& surface, const py::object& skin) {
  BodyOptions options;
  options.group = smallInteger(group, "group");
  options.whenSilent = whenSilentFrom(whenSilent);
  if (py::isinstance<Avatar>(shape)) {
    const auto avatar = shape.cast<std::shared_ptr<Avatar>>();
    options.self = rulesFrom(selfPairs, *avatar);
    options.surface = surfaceFrom(surface, *avatar);
    if (!skin.is_none()) {
      if (!py::isinstance<SkinOfAvatar>(skin)) {
        refuse(ErrorCode::Mismatch, "skin", "expected a foretouch.Skin");
      }
      options.skin = skin.cast<const SkinOfAvatar&>().skin;
    }
    return world.add({avatar, nullptr}, options);
  }
  if (!py::isinstance<Scene>(shape)) {
    refuse(ErrorCode::Mismatch, "shape", "expected a foretouch.Avatar or a foretouch.Scene");
  }
  if (!selfPairs.is_none()) {
    refuse(ErrorCode::Mismatch, "self_pairs", "expected None: a mesh has no links of its own");
  }
  for (const auto& [given, name] :
       {std::pair<py::object, const char*>{surface, "surface"}, {skin, "skin"}}) {
    if (given.is_none()) continue;
    refuse(ErrorCode::Mismatch, name, "expected None: a mesh touches by its triangles anyway");
  }
  return world.add({nullptr, shape.cast<std::shared_ptr<Scene>>()}, options);
}

void pushPose(World& world, const Shown<shown::Integer>& body, const Shown<shown::Integer>& utimeUs,
              const Shown<shown::Pose>& pose) {
  const BodyId id = smallInteger(body, "body");
  world.push(id, instantFrom(utimeUs, "utime_us"), bodyPose(world, id, pose));
}

void attachBody(World& world, const Shown<shown::Integer>& body,
                const Shown<shown::Integer>& carrier, const Shown<shown::Integer>& utimeUs,
                const Shown<shown::Pose>& pose, const Shown<shown::Link>& link,
                const Shown<shown::Truth>& movesInFrame) {
  const BodyId id = smallInteger(body, "body"), by = smallInteger(carrier, "carrier");
  const BodyShape holding = world.shape(by);
  const LinkId hand =
      holding.avatar ? linkOf(*holding.avatar, link, "link") : smallInteger(link, "link");
  world.attach(id, {by, hand, boolean(movesInFrame, "moves_in_frame")},
               instantFrom(utimeUs, "utime_us"), bodyPose(world, id, pose));
}

void detachBody(World& world, const Shown<shown::Integer>& body,
                const Shown<shown::Integer>& utimeUs, const Shown<shown::Pose>& pose) {
  const BodyId id = smallInteger(body, "body");
  world.detach(id, instantFrom(utimeUs, "utime_us"), bodyPose(world, id, pose));
}

void askGroups(World& world, const Shown<shown::Integer>& a, const Shown<shown::Integer>& b,
               const Shown<shown::Truth>& isAsked) {
  world.ask(smallInteger(a, "a"), smallInteger(b, "b"), boolean(isAsked, "is_asked"));
}

void askStillGroup(World& world, const Shown<shown::Integer>& group,
                   const Shown<shown::Truth>& isAsked) {
  world.askStill(smallInteger(group, "group"), boolean(isAsked, "is_asked"));
}

py::object contactsIn(World& world, const Shown<shown::Integer>& fromUs,
                      const Shown<shown::Integer>& toUs) {
  const auto answer = world.contacts(instantFrom(fromUs, "from_us"), instantFrom(toUs, "to_us"));
  return toPython(answer, world.still().get(), *world.shapes());
}

std::string textOfWorld(World& world) {
  return "<foretouch.World of " + std::to_string(world.shapes()->size()) + " bodies>";
}

/// What it remembers.
void bindHistory(py::class_<World>& bound) {
  bound
      .def(
          "forget_before",
          [](World& world, const Shown<shown::Integer>& utimeUs) {
            world.forgetBefore(instantFrom(utimeUs, "utime_us"));
          },
          py::arg("utime_us"),
          "Lets go of what no window from there on needs; earlier poses and windows are refused.")
      .def(
          "forget_beyond",
          [](World& world, std::size_t bytes) { return world.forgetBeyond(bytes); },
          py::arg("bytes"),
          "The same by memory: the oldest poses of all, until pose_bytes is at most as many. "
          "Tells\n"
          "the instant (us) before which all is forgotten.")
      .def(
          "thin_before",
          [](World& world, const Shown<shown::Integer>& utimeUs,
             const Shown<shown::Number>& metres) {
            world.thinBefore(instantFrom(utimeUs, "utime_us"), number(metres, "metres"));
          },
          py::arg("utime_us"), py::arg("metres"),
          "Lets go of earlier poses between others that say nearly the same: no point is ever\n"
          "farther than so many metres from where all poses that were pushed have it.")
      .def_property_readonly("pose_bytes", &World::poseBytes,
                             "What the poses that are kept take: 56 n + 256 of one of n joints.");
}

}  // namespace

void bindWorld(py::module_& module) {
  bindWorldAnswer(module);
  py::class_<World> bound(
      module, "World",
      "Everything that moves, on one timeline: avatars, rigid props and what they carry, each\n"
      "known at instants of its own (whole microseconds since any epoch), beside an optional\n"
      "scene that stands still. Threads that call one wait for one another.");
  bound
      .def(
          py::init(&createWorld), py::arg("still") = py::none(), py::kw_only(),
          py::arg("tolerance") = WorldOptions().tolerance,
          py::arg("ask_meshes") = WorldOptions().askMeshes,
          py::arg("work_per_pair") = WorldOptions().workPerPair,
          py::arg("work_per_window") = py::none(), py::arg("most_near") = py::none(),
          "ask_meshes: whether two meshes are asked if they meet, and a mesh and `still`.\n"
          "work_per_pair: evaluations (about 10 ns each) that two bodies may cost in a window, "
          "and\n"
          "a body by itself between two poses. work_per_window: that all pairs may cost together,\n"
          "shared by bodies. Beyond it: undecided. most_near: who may meet more than so many "
          "others\n"
          "in a window is crowded; two of them are not asked about each other, and are `silent`.")
      .def("add", &addBody, py::arg("shape"), py::kw_only(), py::arg("group") = 0,
           py::arg("when_silent") = toString(WhenSilent::Wait), py::arg("self_pairs") = py::none(),
           py::arg("surface") = py::none(), py::arg("skin") = py::none(),
           "A body, by its number: of an Avatar, whose LSS touch, or of a Scene in the prop's own\n"
           "frame, whose triangles do. group: 0 to 31. when_silent: after its last pose it is\n"
           "waited for ('wait'), taken to stay ('hold-still') or unknown ('undecided').\n"
           "self_pairs: PairRules: asks whether own links touch, too. surface: of the avatar: its\n"
           "triangles touch in place of its LSS. skin: of the avatar: what probe() meets, bent as\n"
           "it is then.")
      .def(
          "push", &pushPose, py::arg("body"), py::arg("utime_us"), py::arg("pose"),
          "The body's next pose: in W, or in the frame of what carries it. Of one joint, as every\n"
          "mesh is, a pair of (4,) and (3,) will do.")
      .def("attach", &attachBody, py::arg("body"), py::arg("carrier"), py::arg("utime_us"),
           py::arg("pose"), py::kw_only(), py::arg("link") = 0, py::arg("moves_in_frame") = false,
           "From then on a link of another body carries it; pose: there, in that link's frame.\n"
           "moves_in_frame: its poses go on in that frame; else it is held fast, without any.")
      .def("detach", &detachBody, py::arg("body"), py::arg("utime_us"), py::arg("pose"),
           "From then on nobody carries it; pose: there, in W.")
      .def("ask", &askGroups, py::arg("a"), py::arg("b"), py::arg("is_asked"),
           "Whether bodies of two groups are asked if they meet; everything is, to begin with.")
      .def("ask_still", &askStillGroup, py::arg("group"), py::arg("is_asked"),
           "The same of bodies of a group and what stands still.")
      .def_property_readonly("known_until", &World::knownUntilUs,
                             "Until when all is known, or taken to be (us); None before any pose.")
      .def_property_readonly("waits_for", &World::waitsFor,
                             "The body that known_until waits for; None: nobody.")
      .def("contacts", &contactsIn, py::arg("from_us"), py::arg("to_us"),
           "The first contact, in the window, of every two links that are asked: WorldContacts.")
      .def_property_readonly("num_bodies", [](World& world) { return world.shapes()->size(); })
      .def_property_readonly("tolerance", &World::tolerance)
      .def("__repr__", &textOfWorld);
  bindHistory(bound);
}

}  // namespace foretouch::python
