// bindings/python/solid.h: a solid avatar, and what one tick of it shows.
#pragma once

#include <memory>
#include <mutex>

#include "articulated/avatar.h"
#include "bindings/python/arguments.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::python {

/// One tick's answer, immutable.
struct SolidTick {
  std::shared_ptr<const Avatar> avatar;  ///< For names.
  std::shared_ptr<const Scene> scene;
  foretouch::SolidTick tick;
};

/// Where a tracked body is, checked but for the pose.
struct Tracked {
  Pose pose;
  double dtS = 0.0;
  std::vector<std::uint8_t> isTracked;  ///< Empty: nothing is lost.
};

/// Threads may call one, and wait for one another. Callers hold the GIL; the methods release it
/// while they work.
class SolidAvatar {
 public:
  /// Throws if the library refuses the options.
  SolidAvatar(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
              const SolidOptions& options);

  [[nodiscard]] const std::shared_ptr<Avatar>& avatar() const { return avatar_; }
  [[nodiscard]] std::shared_ptr<Scene> scene();

  [[nodiscard]] SolidTick follow(const Tracked& tracked);
  void reset();
  void reset(const Pose& place);
  void changeScene(std::shared_ptr<Scene> scene);

 private:
  /// Calls a function of `solid_` without the GIL.
  template <typename Call>
  void change(const char* place, const Call& call);

  std::shared_ptr<Avatar> avatar_;
  std::mutex mutex_;  // never waited for with the GIL held
  std::shared_ptr<Scene> scene_;
  foretouch::SolidAvatar solid_;
  bool isSuspect_ = false;  // memory ran out half-way
};

/// The keywords of a solid avatar, as given; those that are null are as usual.
struct GivenSolidOptions {
  py::object skin, tolerance, catchUp, visibility, floor, feet, up, mostLift, mostDeviation,
      mostLimbDeviation, patience, maySnap, snapNotice, aroundPerTick, aroundInAll, placingReach,
      ignore, selfPairs, workBudget;
};
/// TypeError for a keyword that is not one of these.
[[nodiscard]] GivenSolidOptions solidKeywords(const py::kwargs& given);

/// Looks up the names of links and objects. The library itself checks the values.
[[nodiscard]] SolidOptions solidOptionsFrom(const GivenSolidOptions& given, const Avatar& avatar,
                                            const Scene& scene);
/// An error about an option is one about its keyword.
[[nodiscard]] Error withKeywordsOfSolid(Error error);

/// Booleans, or integers of which 0 is lost; empty for None.
[[nodiscard]] std::vector<std::uint8_t> flagsFrom(const py::object& given, const Avatar& avatar);

void bindSolidTick(py::module_& module);

}  // namespace foretouch::python
