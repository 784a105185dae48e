#include "network/stream/step_batch.h"

#include <algorithm>

#include "network/stream/person_stream.h"

namespace foretouch {

namespace {

void copySolid(const ShownStep& shown, WatchedSolid& solid) {
  const SolidMessage& answer = shown.answer;
  solid.from = shown.from;
  solid.to = answer.shown();
  solid.state = answer.state;
  solid.limit = answer.limit;
  solid.isCertified = answer.isCertified;
  solid.deviation = answer.deviation;
  solid.lift = answer.lift;
  solid.clearance = answer.clearance;
  solid.snapInUs = answer.snapInUs;
}

void addBrackets(const PersonStream& person, std::vector<WatchedBracket>& brackets) {
  for (std::size_t i = 0; i < person.numSaid(); ++i) {
    const PersonMessage& said = person.said(i);
    const std::size_t room = kMaxBatchContacts - std::min(kMaxBatchContacts, brackets.size());
    const std::size_t taken = std::min(room, said.brackets.size());
    for (std::size_t k = 0; k < taken; ++k) {
      brackets.push_back({said.brackets[k].bracket, said.utimeFromUs, said.utimeToUs});
    }
  }
}

}  // namespace

void StepBatch::add(const StreamStep& step, const ContactsMessage& answer, const ShownStep* shown,
                    const PersonStream* person) {
  newest_.from = *step.from;
  newest_.to = *step.to;
  newest_.kind = answer.kind;
  newest_.sequence = answer.sequenceTo;
  newest_.lost = answer.lost;
  newest_.utimeFromUs = answer.utimeFromUs;
  newest_.utimeToUs = answer.utimeToUs;
  newest_.queryUs = answer.queryUs;
  const auto serviceUs = static_cast<double>(answer.sendUtimeUs - answer.receiveUtimeUs);
  newest_.addedUs = std::max(0.0, serviceUs - answer.queryUs);
  newest_.isSolid = shown != nullptr;
  if (shown != nullptr) copySolid(*shown, newest_.solid);
  if (person != nullptr) addBrackets(*person, brackets_);
  const std::size_t room = kMaxBatchContacts - contacts_.size();
  const std::size_t taken = std::min(room, answer.contacts.size());
  for (std::size_t i = 0; i < taken; ++i) contacts_.push_back(answer.contacts[i].contact);
  if (taken > 0) {
    touchingSteps_.push_back(
        {answer.sequenceTo, answer.utimeFromUs, answer.utimeToUs, contacts_.size()});
  }
  numLeftOut_ += answer.contacts.size() - taken;
  ++numSteps_;
}

void StepBatch::clear() {
  contacts_.clear();
  touchingSteps_.clear();
  brackets_.clear();
  numSteps_ = numLeftOut_ = 0;
}

}  // namespace foretouch
