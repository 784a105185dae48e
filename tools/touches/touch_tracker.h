// tools/touches/touch_tracker.h: the answers of steps, in order, as touches. Pure: the same answers
// give the same touches. The rules: docs/concepts.md, "Touches".
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

#include "middleware/contact.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

/// What a step's answer says about the scene, link by link.
enum class TouchScope : std::uint8_t {
  FirstOfLink,  ///< Each link's first contact: what else it touches then is not said.
  EveryObject,  ///< Each link's first contact with each object.
};

/// A contact of a step's answer; `contact` is not clear.
struct TouchRow {
  const LinkContact* contact = nullptr;
  LinkId other = -1;         ///< As in TouchPair.
  std::string_view object;   ///< As there; not read if the link is undecided, but for own links.
  double timeS = 0.0;        ///< The contact's time.
  std::int64_t utimeUs = 0;  ///< The same, for streams.
  bool isMissed = false;     ///< The link is known to touch nothing at either pose of the step.
  bool isGround = false;

  [[nodiscard]] bool isUndecided() const { return contact->verdict == Verdict::Undecided; }
  /// There is contact, or within the tolerance of it, at the step's earlier pose.
  [[nodiscard]] bool isAtStart() const {
    return contact->verdict == Verdict::StartsInContact ||
           (contact->verdict == Verdict::Contact && !(contact->toi > 0.0));
  }
};

/// The answer to a step. What it points to must live until addStep() returns.
struct TouchStep {
  std::int64_t step = 0;
  std::vector<TouchRow> rows;  ///< Earliest first, as answered; those of own links anywhere.
};

class TouchTracker {
 public:
  explicit TouchTracker(TouchScope scope) : scope_(scope) {}

  /// Adds the step after the last one: it begins at the pose that ended that. Appends the touches
  /// that it ends to `ended`, and to `begun` the place in `step.rows` of each row that begins one.
  void addStep(const TouchStep& step, std::vector<Touch>& ended, std::vector<std::size_t>& begun);

  /// Ends all touches, as nothing is known of what follows the last step.
  void breakOff(std::vector<Touch>& ended);

  [[nodiscard]] std::size_t open() const { return open_.size(); }

  /// A touch as its first row leaves it.
  [[nodiscard]] static Touch firstOf(const TouchRow& row, std::int64_t step);

 private:
  struct Key {
    LinkId link, other;
    std::string_view object;
  };
  /// Finds pairs by keys, without a copy of the object's name.
  struct IsLess {
    using is_transparent = void;
    template <typename X, typename Y>
    bool operator()(const X& x, const Y& y) const {
      return std::tie(x.link, x.other, x.object) < std::tie(y.link, y.other, y.object);
    }
  };
  struct Open {
    Touch touch;
    bool isLastMissed = false;  ///< TouchRow::isMissed of its last row.
  };
  /// What a step says about an open touch at its earlier pose.
  enum class Fate : std::uint8_t { Persists, Hidden, Left, Unknown };

  [[nodiscard]] static Key keyOf(const TouchPair& pair) {
    return {pair.link, pair.other, pair.object};
  }
  [[nodiscard]] static Key keyOf(const TouchRow& row) {
    return {row.contact->link, row.other, row.object};
  }
  void index(const TouchStep& step);
  [[nodiscard]] Fate fateOf(const TouchPair& pair) const;
  [[nodiscard]] static Fate fateBy(const TouchRow& undecided);
  void endWhatDoesNotPersist(std::int64_t step, std::vector<Touch>& ended);
  [[nodiscard]] bool take(const TouchRow& row, std::int64_t step);
  static void grow(Open& open, const TouchRow& row, std::int64_t step);

  TouchScope scope_;
  std::map<TouchPair, Open, IsLess> open_;
  // For the step that is being added: the first row of each pair, the first contact of each link,
  // and where the link is undecided, all of the scene.
  std::map<Key, const TouchRow*, IsLess> rowOf_;
  std::map<LinkId, const TouchRow*> contactOf_, undecidedOf_;
};

}  // namespace foretouch::tools
