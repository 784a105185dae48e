// tools/world/world_touches.h: the answers of a world's windows as touches (docs/concepts.md): who
// touches whom, from first contact to where it ends. Links of all bodies are numbered as one.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "middleware/contact.h"
#include "tools/touches/touch_tracker.h"
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

/// Counts of a whole replay.
struct WorldTouchCounts {
  std::int64_t scene = 0, bodies = 0, own = 0;  ///< With the scene, of two bodies, of own links.
  std::int64_t missed = 0;  ///< Of these: nobody who looks where windows begin and end sees them.
};

class WorldTouches {
 public:
  /// `world` outlives it.
  explicit WorldTouches(const LoadedWorld& world);

  /// Windows in order. Returns the places of the contacts of the answer that begin touches; valid
  /// until the next call.
  const std::vector<std::size_t>& add(const WorldStep& step);
  /// After the last one.
  void finish();

  /// After finish(), by begin; `link` and `other` are LinkNumbers, of bodies in this order.
  [[nodiscard]] const std::vector<Touch>& listed() const { return listed_; }
  [[nodiscard]] const WorldTouchCounts& counts() const { return counts_; }
  [[nodiscard]] TouchSides sidesOf(const TouchPair& touch) const;

 private:
  using Pair = std::pair<LinkId, LinkId>;  // -1: the scene
  void addRow(const WorldContact& contact, const WorldStep& step);
  void addUnknown(const WorldStep& step);
  [[nodiscard]] bool isCarried(BodyId body, BodyId carrier, LinkId link, std::int64_t us) const;
  void keepEnded();

  const LoadedWorld& world_;
  LinkNumbers numbers_;
  TouchTracker tracker_;
  std::multiset<Pair> open_;
  std::vector<Touch> listed_;
  WorldTouchCounts counts_;
  // Of the window that is being added.
  TouchStep step_;
  std::vector<LinkContact> contacts_;
  std::vector<std::size_t> rowOf_, begunRows_, begun_;
  std::vector<Touch> ended_;
};

}  // namespace foretouch::tools
