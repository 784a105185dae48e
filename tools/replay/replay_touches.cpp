#include "tools/replay/replay_touches.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/json_line.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

TouchScope scopeOf(const QueryOptions& query) {
  return query.scope == Scope::EveryObject ? TouchScope::EveryObject : TouchScope::FirstOfLink;
}

}  // namespace

Result<ReplayTouches> ReplayTouches::start(const ReplayInputs& inputs) {
  ReplayTouches touches(inputs);
  if (!StepFollower::canFollow(inputs)) return touches;
  FORETOUCH_TRY(auto follower, StepFollower::start(inputs));
  touches.followed_.emplace(inputs, std::move(follower));
  return touches;
}

ReplayTouches::ReplayTouches(const ReplayInputs& inputs)
    : inputs_(inputs), tracker_(scopeOf(inputs.query)) {}

Result<Done> ReplayTouches::add(const StepAnswer& answer) {
  ++steps_;
  begun_.clear();
  if (followed_) {
    FORETOUCH_CHECK(followed_->add(answer, begun_, ended_));
  } else {
    track(answer);
  }
  list();
  return Done{};
}

Result<Done> ReplayTouches::finish() {
  begun_.clear();
  if (followed_) {
    FORETOUCH_CHECK(followed_->finish(begun_, ended_));
  } else {
    tracker_.breakOff(ended_);
  }
  list();
  std::sort(listed_.begin(), listed_.end(), isListedBefore);
  return Done{};
}

void ReplayTouches::track(const StepAnswer& answer) {
  const bool isByObject = inputs_.query.scope == Scope::EveryObject;
  const std::vector<LinkContact>& contacts = isByObject ? answer.objects : answer.contacts;
  step_.step = answer.step;
  step_.rows.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    addRow(contacts[i], answer, i < answer.onGround.size() && answer.onGround[i]);
  }
  for (const PairContact& contact : answer.pairs) addRow(contact, answer);
  begunRows_.clear();
  tracker_.addStep(step_, ended_, begunRows_);
  for (const std::size_t i : begunRows_) {
    const TouchRow& row = step_.rows[i];
    begun_.push_back(
        {*row.contact, answer.step, row.timeS, std::string(row.object), row.isMissed, row.other});
  }
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
    text += objectLine("touch", [&](JsonWriter& out) { writeTouch(touch, words, out); });
  }
  return text + touchSummaryLine(counts_, steps_, {inputs_.query.self.has_value(), areFollowed()});
}

}  // namespace foretouch::tools
