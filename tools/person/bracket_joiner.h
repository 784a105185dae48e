// tools/person/bracket_joiner.h: brackets of steps, joined to touches: link by link and pair by
// pair. Seconds.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "articulated/skeleton.h"
#include "assets/json_writer.h"
#include "middleware/bracket/bracket.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Nothing is touched before beginsS[0] and after endsS[1]; if it is certain, the touch began by
/// beginsS[1] and had not ended before endsS[0].
struct PersonTouch {
  LinkId link = 0, other = kNoParent;
  TriangleId triangle = -1;  ///< The scene's one that was, or may have been, touched first.
  bool isCertain = false;
  double beginsS[2] = {0.0, 0.0}, endsS[2] = {0.0, 0.0};
  bool beginsBefore = false, endsAfter = false;  ///< What is known begins, or ends, in it.
  double growth = 0.0;  ///< The largest distance between person and model in it (m).
};

/// The names of what is in a touch, for a line of results; an empty one is left out.
struct PersonNames {
  std::string body, link, otherBody, other, object;
};
/// Two arrays, earlier first, under these names: [possible, certain] and [certain, possible]; what
/// is not certain is null.
void writeBeginAndEnd(const PersonTouch& touch, const char* begins, const char* ends,
                      JsonWriter& out);
/// The fields of a touch that a page shows (docs/formats.md, "View documents").
void writeShownTouch(const PersonTouch& touch, const std::string& object, JsonWriter& out);
/// {"person_touch": {...}} (docs/formats.md).
[[nodiscard]] std::string personTouchLine(const PersonNames& names, const PersonTouch& touch);

/// Joins the touches of both sides, for one question.
class BracketJoiner {
 public:
  /// Takes the brackets of [beginS, endS], which is not before that of the last call; nothing is
  /// known of what lies between.
  void add(double beginS, double endS, const StepBrackets& brackets);
  /// The touches in the order of their begins. Call once.
  [[nodiscard]] std::vector<PersonTouch> finish();

 private:
  struct Open {
    PersonTouch touch;
    bool isSeen = false;  // in the step at hand
    bool goesOn = false;  // to the step's end
  };
  void take(const LinkBracket& bracket);
  void begin(const LinkBracket& bracket, PersonTouch& touch) const;
  void closeUnseen();
  void breakOff();
  [[nodiscard]] double timeAt(double t) const { return beginS_ + t * (endS_ - beginS_); }

  using Key = std::pair<LinkId, LinkId>;
  std::map<Key, Open> open_;
  std::set<Key> unknown_, nowUnknown_;  // nothing is claimed of them in the last step, and in this
  std::vector<PersonTouch> touches_;
  bool isNew_ = true;  // nothing is known of what was before the step at hand
  double beginS_ = 0.0, endS_ = 0.0;
};

}  // namespace foretouch::tools
