#include "tools/person/bracket_joiner.h"

#include <algorithm>
#include <iterator>

#include "tools/json_line.h"

namespace foretouch::tools {
void writeBeginAndEnd(const PersonTouch& touch, const char* begins, const char* ends,
                      JsonWriter& out) {
  const auto writeCertain = [&](double s) { touch.isCertain ? out.value(s) : out.null(); };
  out.key(begins);
  out.beginArray();
  out.value(touch.beginsS[0]);
  writeCertain(touch.beginsS[1]);
  out.endArray();
  out.key(ends);
  out.beginArray();
  writeCertain(touch.endsS[0]);
  out.value(touch.endsS[1]);
  out.endArray();
}

void writeShownTouch(const PersonTouch& touch, const std::string& object, JsonWriter& out) {
  out.field("link", touch.link);
  if (touch.other != kNoParent) out.field("other", touch.other);
  if (!object.empty()) out.field("object", object);
  out.field("verdict", touch.isCertain ? "certain" : "possible");
  writeBeginAndEnd(touch, "begins", "ends", out);
  if (touch.beginsBefore) out.field("began_before", true);
  if (touch.endsAfter) out.field("goes_on", true);
  out.field("growth", touch.growth);
}

std::string personTouchLine(const PersonNames& names, const PersonTouch& touch) {
  return objectLine("person_touch", [&](JsonWriter& out) {
    const std::pair<const char*, const std::string&> fields[] = {{"body", names.body},
                                                                 {"link", names.link},
                                                                 {"other_body", names.otherBody},
                                                                 {"other", names.other},
                                                                 {"object", names.object}};
    for (const auto& [name, value] : fields) {
      if (!value.empty()) out.field(name, value);
    }
    if (touch.triangle >= 0) out.field("triangle", touch.triangle);
    out.field("verdict", touch.isCertain ? "certain" : "possible");
    writeBeginAndEnd(touch, "begins_s", "ends_s", out);
    if (touch.beginsBefore) out.field("begins_before", true);
    if (touch.endsAfter) out.field("ends_after", true);
  });
}

void BracketJoiner::add(double beginS, double endS, const StepBrackets& brackets) {
  isNew_ = isNew_ || beginS != endS_;
  if (isNew_) breakOff();
  beginS_ = beginS;
  endS_ = endS;
  nowUnknown_.clear();
  for (const LinkBracket& bracket : brackets.links) take(bracket);
  for (const LinkBracket& bracket : brackets.pairs) take(bracket);
  closeUnseen();
  std::swap(unknown_, nowUnknown_);
  isNew_ = false;
}

void BracketJoiner::take(const LinkBracket& bracket) {
  if (bracket.verdict == BracketVerdict::Excluded) return;
  const Key key{bracket.link, bracket.other};
  const auto known = open_.find(key);
  if (bracket.verdict == BracketVerdict::Unclaimed) {
    nowUnknown_.insert(key);
    if (known != open_.end()) known->second.touch.endsAfter = true;
    return;
  }
  // What ended with the step before, and may begin at once, is one touch.
  const bool goesOn = known != open_.end() && bracket.possibleFrom == 0.0;
  if (known != open_.end() && !goesOn) {
    touches_.push_back(known->second.touch);
    open_.erase(known);
  }
  Open& open = open_[key];
  if (!goesOn) begin(bracket, open.touch);
  open.isSeen = true;
  open.goesOn = bracket.possibleUntil == 1.0;
  open.touch.endsS[1] = timeAt(bracket.possibleUntil);
  open.touch.growth = std::max(open.touch.growth, bracket.growth);
  if (bracket.verdict != BracketVerdict::Certain) return;
  if (!open.touch.isCertain) open.touch.beginsS[1] = timeAt(bracket.certainFrom);
  open.touch.isCertain = true;
  open.touch.endsS[0] = timeAt(bracket.certainUntil);
}

void BracketJoiner::begin(const LinkBracket& bracket, PersonTouch& touch) const {
  touch.link = bracket.link;
  touch.other = bracket.other;
  touch.triangle = bracket.triangle;
  touch.beginsS[0] = timeAt(bracket.possibleFrom);
  const bool isUnknownBefore = isNew_ || unknown_.count({bracket.link, bracket.other}) > 0;
  touch.beginsBefore = isUnknownBefore && bracket.possibleFrom == 0.0;
}

void BracketJoiner::closeUnseen() {
  for (auto it = open_.begin(); it != open_.end();) {
    Open& open = it->second;
    const bool isOver = !open.isSeen || !open.goesOn;
    open.isSeen = false;
    if (isOver) touches_.push_back(open.touch);
    it = isOver ? open_.erase(it) : std::next(it);
  }
}

void BracketJoiner::breakOff() {
  for (auto& [key, open] : open_) {
    open.touch.endsAfter = true;
    touches_.push_back(open.touch);
  }
  open_.clear();
}

std::vector<PersonTouch> BracketJoiner::finish() {
  breakOff();
  std::stable_sort(
      touches_.begin(), touches_.end(),
      [](const PersonTouch& x, const PersonTouch& y) { return x.beginsS[0] < y.beginsS[0]; });
  return std::move(touches_);
}

}  // namespace foretouch::tools
