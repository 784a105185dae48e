// tools/world/world_touches.h: what touches what in a world, from first contact to where it ends
// (docs/concepts.md). In a world that is followed these are its intervals of contact, with their
// exact ends; in others they are made of the answers of windows. Links of all bodies are numbered
// as one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "middleware/contact.h"
#include "tools/touches/touch_strength.h"
#include "tools/touches/touch_tracker.h"
#include "tools/world/world_intervals.h"
#include "tools/world/world_windows.h"

namespace foretouch::tools {

/// The links of all bodies, body after body; a mesh counts as one.
class LinkNumbers {
 public:
  explicit LinkNumbers(const LoadedWorld& world);

  [[nodiscard]] LinkId of(BodyId body, LinkId link) const { return first_[slotOf(body)] + link; }
  [[nodiscard]] LinkId of(const ContactSide& side) const { return of(side.body, side.link); }
  [[nodiscard]] BodyId bodyOf(LinkId number) const;
  [[nodiscard]] LinkId linkOf(LinkId number) const {
    return number - first_[slotOf(bodyOf(number))];
  }

 private:
  std::vector<LinkId> first_;  // per body, and the sum
};

/// Which side of a touch is which: numbers of links, and the object if the other one is the scene.
struct TouchSides {
  BodyId a = 0, b = kStillScene;
  LinkId linkOfA = 0, linkOfB = 0;
};

/// `link` and `other` are LinkNumbers, those of bodies in this order; -1: the scene.
struct WorldTouch : Touch {
  WorldContact first;  ///< The contact that it begins with.
  // Where the world was followed.
  std::optional<TouchStrength> strength;  ///< The strength of that contact.
  WorldTime until;                        ///< `endS`, exactly.
};

/// Counts of a whole replay.
struct WorldTouchCounts {
  std::int64_t scene = 0, bodies = 0, own = 0;  ///< With the scene, two bodies, own links.
  std::int64_t missed = 0;                      ///< Of these: not seen where windows begin and end.
};

class WorldTouches {
 public:
  /// `world` and `followed` outlive it. `followed`: all reports on the time of the windows,
  /// after its finish(); null: the world is not followed.
  WorldTouches(const LoadedWorld& world, const WorldIntervals* followed);

  /// Windows in order.
  void add(const WorldStep& step);
  /// Call after the last one.
  void finish();

  /// The touches after finish(), by begin.
  [[nodiscard]] const std::vector<WorldTouch>& listed() const { return listed_; }
  [[nodiscard]] const WorldTouchCounts& counts() const { return counts_; }
  [[nodiscard]] TouchSides sidesOf(const TouchPair& touch) const;

 private:
  using Key = std::tuple<LinkId, LinkId, std::string>;           // as TouchPair
  using PairKey = std::tuple<LinkId, BodyId, LinkId, ObjectId>;  // by which intervals differ
  void takeIntervals();
  void addFollowed(const WorldStep& step);
  void addAsked(const WorldStep& step);
  void placeInWindows(WorldTouch& touch) const;
  void addRow(const WorldContact& contact, const WorldStep& step);
  void addUnknown(const WorldStep& step);
  [[nodiscard]] PairKey pairOf(const WorldContact& contact) const;
  [[nodiscard]] bool isCarried(BodyId body, BodyId carrier, LinkId link, std::int64_t us) const;
  [[nodiscard]] std::string objectOf(const WorldContact& contact) const;
  void keepEnded();
  void count(const Touch& touch);

  const LoadedWorld& world_;
  const WorldIntervals* followed_;
  LinkNumbers numbers_;
  std::vector<WorldTouch> listed_;
  WorldTouchCounts counts_;
  // Where the world is followed.
  std::vector<std::int64_t> cuts_;  // where windows begin, and the last one ends
  std::map<PairKey, std::vector<std::size_t>> placesOf_;  // in `listed_`, by begin
  // Where it is not.
  TouchTracker tracker_;
  std::map<Key, WorldContact> open_;  // with the contact it begins with
  // For the window that is being added.
  TouchStep step_;
  std::vector<LinkContact> contacts_;
  std::vector<std::size_t> rowOf_, begunRows_;
  std::vector<Touch> ended_;
};

}  // namespace foretouch::tools
