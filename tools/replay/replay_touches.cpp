#include "tools/replay/replay_touches.h"

#include <algorithm>
#include <utility>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/reported_contact.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

TouchScope scopeOf(const QueryOptions& query) {
  return query.scope == Scope::EveryObject ? TouchScope::EveryObject : TouchScope::FirstOfLink;
}

}  // namespace

ReplayTouches::ReplayTouches(const ReplayInputs& inputs)
    : inputs_(inputs), tracker_(scopeOf(inputs.query)) {}

const std::vector<TouchRow>& ReplayTouches::add(const StepAnswer& answer) {
  const bool isByObject = inputs_.query.scope == Scope::EveryObject;
  const std::vector<LinkContact>& contacts = isByObject ? answer.objects : answer.contacts;
  step_.step = answer.step;
  step_.rows.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    addRow(contacts[i], answer, i < answer.onGround.size() && answer.onGround[i]);
  }
  for (const PairContact& contact : answer.pairs) addRow(contact, answer);
  begun_.clear();
  tracker_.addStep(step_, ended_, begun_);
  ++steps_;
  list();
  begunRows_.clear();
  for (const std::size_t i : begun_) begunRows_.push_back(step_.rows[i]);
  return begunRows_;
}

void ReplayTouches::finish() {
  tracker_.breakOff(ended_);
  list();
  std::sort(listed_.begin(), listed_.end(), isListedBefore);
}

void ReplayTouches::addRow(const LinkContact& contact, const StepAnswer& answer, bool isGround) {
  TouchRow& row = step_.rows.emplace_back();
  row.contact = &contact;
  row.isGround = isGround;
  if (contact.verdict == Verdict::Undecided) return;
  row.object = inputs_.scene.objectNames()[slotOf(inputs_.scene.object(contact.triangle))];
  row.timeS = timeOf(contact, answer.t0S, answer.t1S);
  const std::vector<LinkId>& missed = answer.missedByPoses;
  row.isMissed = std::find(missed.begin(), missed.end(), contact.link) != missed.end();
}

void ReplayTouches::addRow(const PairContact& contact, const StepAnswer& answer) {
  TouchRow& row = step_.rows.emplace_back();
  row.contact = &contact;
  row.other = contact.other;
  row.object = inputs_.avatar.skeleton().name(contact.other);
  row.timeS = timeOf(contact, answer.t0S, answer.t1S);
}

/// Counts what has ended, and keeps what is listed of it.
void ReplayTouches::list() {
  const bool isIgnored = inputs_.request.ground.use == GroundUse::Ignore;
  for (Touch& touch : ended_) {
    counts_.add(touch);
    if (!isIgnored || !touch.isGround) listed_.push_back(std::move(touch));
  }
  ended_.clear();
}

std::string ReplayTouches::lines() const {
  std::string text;
  const Skeleton& skeleton = inputs_.avatar.skeleton();
  for (const Touch& touch : listed_) {
    const std::string link = jsonString(skeleton.name(touch.link));
    const bool isOwn = touch.other >= 0;
    const std::string name = jsonString(touch.object);
    TouchWords words;
    words.link = link;
    (isOwn ? words.other : words.object) = name;
    JsonWriter out(text);
    out.beginObject();
    out.key("touch");
    out.beginObject();
    writeTouch(touch, words, out);
    out.endObject();
    out.endObject();
    text += "\n";
  }
  return text + touchSummaryLine(counts_, steps_, inputs_.query.self.has_value());
}

}  // namespace foretouch::tools
