// bindings/python/solid.cpp: foretouch.SolidAvatar.
#include "bindings/python/solid.h"

#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

template <typename T>
T solidValue(Result<T> result) {
  if (!result.ok()) throw Failure(withKeywordsOfSolid(result.error()));
  return std::move(result).value();
}

}  // namespace

std::vector<std::uint8_t> flagsFrom(const py::object& given, const Avatar& avatar) {
  if (given.is_none()) return {};
  const py::object array = py::module_::import("numpy").attr("asarray")(given);
  const bool isTruth = array.attr("dtype").attr("kind").cast<std::string>() == "b";
  const Integers flags = integers(isTruth ? py::object(array.attr("astype")("int64")) : array,
                                  "is_tracked", {avatar.numLinks()});
  std::vector<std::uint8_t> found;
  for (py::ssize_t j = 0; j < flags.size(); ++j) found.push_back(flags.at(j) != 0 ? 1 : 0);
  return found;
}

SolidAvatar::SolidAvatar(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
                         const SolidOptions& options)
    : avatar_(std::move(avatar)),
      scene_(std::move(scene)),
      solid_(solidValue(foretouch::SolidAvatar::build(*avatar_, *scene_, options))) {}

template <typename Call>
void SolidAvatar::change(const char* place, const Call& call) {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (isSuspect_) {  // then it begins anew
    solid_ = solidValue(foretouch::SolidAvatar::build(*avatar_, *scene_, solid_.options()));
  }
  isSuspect_ = true;
  const Result<Done> done = inFile(call(solid_), place);
  isSuspect_ = false;
  solidValue(done);
}

std::shared_ptr<Scene> SolidAvatar::scene() {
  const py::gil_scoped_release free;
  const std::lock_guard<std::mutex> lock(mutex_);
  return scene_;
}

SolidTick SolidAvatar::follow(const Tracked& tracked) {
  SolidTick tick{avatar_, nullptr, {}};
  change("tracked", [&](foretouch::SolidAvatar& solid) {
    tick.scene = scene_;
    const auto* const flags = tracked.isTracked.empty() ? nullptr : &tracked.isTracked;
    return solid.follow({tracked.pose, tracked.dtS, flags}, tick.tick);
  });
  return tick;
}

void SolidAvatar::reset() {
  change("", [](foretouch::SolidAvatar& solid) -> Result<Done> {
    solid.reset();
    return Done{};
  });
}

void SolidAvatar::reset(const Pose& place) {
  change("place", [&](foretouch::SolidAvatar& solid) { return solid.reset(place); });
}

void SolidAvatar::changeScene(std::shared_ptr<Scene> scene) {
  change("scene", [&](foretouch::SolidAvatar& solid) {
    auto done = solid.changeScene(*scene);
    if (done.ok()) scene_ = std::move(scene);
    return done;
  });
}

namespace {

std::unique_ptr<SolidAvatar> createSolid(
    std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene, Shown<shown::Number> skin,
    Shown<shown::Number> tolerance, Shown<shown::Number> catchUp, Shown<shown::Mapping> visibility,
    Shown<shown::Text> floor, Shown<shown::Items> feet, Shown<shown::Array> up,
    Shown<shown::Number> mostLift, Shown<shown::Number> mostDeviation,
    Shown<shown::Number> mostLimbDeviation, Shown<shown::Number> patience,
    Shown<shown::Truth> maySnap, Shown<shown::Number> snapNotice,
    Shown<shown::Integer> aroundPerTick, Shown<shown::Integer> aroundInAll,
    Shown<shown::Number> placingReach, Shown<shown::Items> ignore,
    Shown<shown::PairRules> selfPairs, Shown<shown::Integer> workBudget) {
  const auto options =
      solidOptionsFrom({skin, tolerance, catchUp, visibility, floor, feet, up, mostLift,
                        mostDeviation, mostLimbDeviation, patience, maySnap, snapNotice,
                        aroundPerTick, aroundInAll, placingReach, ignore, selfPairs, workBudget},
                       *avatar, *scene);
  return std::make_unique<SolidAvatar>(std::move(avatar), std::move(scene), options);
}

SolidTick follow(SolidAvatar& solid, const Shown<shown::Pose>& tracked,
                 const Shown<shown::Number>& dt, const Shown<shown::Array>& isTracked) {
  const Avatar& avatar = *solid.avatar();
  return solid.follow({poseFrom(avatar.skeleton(), tracked, "tracked"), number(dt, "dt"),
                       flagsFrom(isTracked, avatar)});
}

void reset(SolidAvatar& solid, const Shown<shown::Pose>& place) {
  if (place.is_none()) {
    solid.reset();
  } else {
    solid.reset(poseFrom(solid.avatar()->skeleton(), place, "place"));
  }
}

constexpr char kSolidText[] =
    "skin: the gap that it keeps to surfaces where it can, metres; tolerance: of the proofs.\n"
    "catch_up: m/s beyond the tracked speed while it catches up.\n"
    "visibility: {link: weight}: how much an error of the link counts beyond its area; the\n"
    "others by their names: hands 4, trunk and head 100, all else 1.\n"
    "floor: 'lift' (the whole target, as far as the feet ask for, at most most_lift) or 'hold'.\n"
    "feet: the links that 'lift' listens to; None: by their names. up: unit.\n"
    "may_snap: farther off than most_deviation (a limb: most_limb_deviation) for longer than\n"
    "patience, it appears at the tracked pose, if that is free; told snap_notice seconds before.\n"
    "around_per_tick, around_in_all: motions tried for a way around; 0: never.\n"
    "placing_reach: how far off a free place to begin at may be.\n"
    "ignore: a list of links and of pairs (link, object), by name or index, that touch nothing.\n"
    "self_pairs: PairRules: own links stop each other, too.\n"
    "work_budget: evaluations (about 10 ns each) that a tick may cost.";

}  // namespace

void bindSolid(py::module_& module) {
  bindSolidTick(module);
  const SolidOptions usual;
  py::class_<SolidAvatar>(
      module, "SolidAvatar",
      "An avatar that passes through nothing: tracked poses in, shown poses out. Each shown\n"
      "motion, from the last shown pose to the next, is proven free before it is shown. Threads\n"
      "that call one wait for one another.")
      .def(py::init(&createSolid), py::arg("avatar").none(false), py::arg("scene").none(false),
           py::kw_only(), py::arg("skin") = usual.skin, py::arg("tolerance") = usual.tolerance,
           py::arg("catch_up") = usual.catchUp, py::arg("visibility") = py::none(),
           py::arg("floor") = toString(usual.floor), py::arg("feet") = py::none(),
           py::arg("up") = py::make_tuple(usual.up.x(), usual.up.y(), usual.up.z()),
           py::arg("most_lift") = usual.mostLift, py::arg("most_deviation") = usual.mostDeviation,
           py::arg("most_limb_deviation") = usual.mostLimbDeviation,
           py::arg("patience") = usual.patience, py::arg("may_snap") = usual.maySnap,
           py::arg("snap_notice") = usual.snapNotice,
           py::arg("around_per_tick") = usual.aroundPerTick,
           py::arg("around_in_all") = usual.aroundInAll,
           py::arg("placing_reach") = usual.placingReach, py::arg("ignore") = py::tuple(),
           py::arg("self_pairs") = py::none(), py::arg("work_budget") = usual.workBudget,
           kSolidText)
      .def("follow", &follow, py::arg("tracked"), py::arg("dt"), py::arg("is_tracked") = py::none(),
           "One tick: a SolidTick. dt: seconds since the last one. is_tracked: (n,), false for\n"
           "joints whose tracker is lost; None: none is. The first pose is where the avatar\n"
           "begins; if it touches something there, at the nearest free place.")
      .def("reset", &reset, py::arg("place") = py::none(),
           "Forgets the shown pose. The next tracked pose is the first again; with a place, a\n"
           "pose outside of everything, it must be reached from there.")
      .def("change_scene", &SolidAvatar::changeScene, py::arg("scene").none(false),
           "Goes on in another scene: a door has opened.")
      .def_property_readonly("avatar", &SolidAvatar::avatar)
      .def_property_readonly("scene", &SolidAvatar::scene);
}

}  // namespace foretouch::python
