#include "tests/network/broken_rule.h"

#include <algorithm>

namespace foretouch::test {

Reject BrokenRule::take(StreamSolver& solver, const PoseId& id, std::int32_t numJoints,
                        PoseMessage& message, ContactsMessage& answer) {
  if (mutation_ == Mutation::None) return solver.take(message, answer);
  const std::int64_t session = message.session, sequence = message.sequence;
  changeJoints(numJoints, message);
  changePlace(id, message);
  const Reject reject = solver.take(message, answer);
  if (reject != Reject::None) return reject;
  hasLast_ = true;
  saidSession_ = session;
  saidSequence_ = sequence;
  last_ = message;
  taken_.insert(id);
  changeAnswer(answer);
  return Reject::None;
}

void BrokenRule::changeJoints(std::int32_t numJoints, PoseMessage& message) const {
  for (PoseJoint& joint : message.joints) {
    const bool isValid = (joint.flags & kJointValid) != 0;
    if (mutation_ == Mutation::InvalidIsValid && unitQuaternion(joint.rotation)) {
      if (!isValid) joint.flags |= kJointValid | kJointTracked;
    }
    if (mutation_ == Mutation::StaleIsTracked && isValid) joint.flags |= kJointTracked;
  }
  if (mutation_ != Mutation::MissingIsAtRest) return;
  for (std::int32_t j = 0; j < numJoints; ++j) {
    const auto is = [j](const PoseJoint& joint) { return joint.joint == j; };
    if (std::none_of(message.joints.begin(), message.joints.end(), is)) {
      message.joints.push_back({j, kJointValid | kJointTracked, Quaternion::Identity()});
    }
  }
}

void BrokenRule::changePlace(const PoseId& id, PoseMessage& message) {
  if (!hasLast_) return;
  const bool isNext = message.session == saidSession_ && message.sequence > saidSequence_;
  const bool isCopy = taken_.count(id) != 0;
  const auto follow = [&] {
    message.session = last_.session;
    message.sequence = last_.sequence + 1;
    message.utimeUs = std::max(message.utimeUs, last_.utimeUs + 1);
    message.utimeUs = std::min(message.utimeUs, last_.utimeUs + 100'000);
  };
  if (mutation_ == Mutation::GapsAreSteps && message.session == saidSession_) {
    const std::int64_t shift = last_.sequence - saidSequence_;
    message.sequence = isNext ? last_.sequence + 1 : message.sequence + shift;
  }
  if (mutation_ == Mutation::RestartsAreSteps) {
    if (message.session > saidSession_) follow();
    if (isNext) {
      message.session = last_.session;
      message.sequence += last_.sequence - saidSequence_;
    }
  }
  if (mutation_ == Mutation::CopiesAreNew && isCopy) follow();
}

void BrokenRule::changeAnswer(ContactsMessage& answer) const {
  if (mutation_ == Mutation::ContactsAreLate) {
    for (AnsweredContact& listed : answer.contacts) {
      if (listed.contact.verdict != Verdict::Contact || listed.contact.toi > 0.99) continue;
      listed.contact.toi += 0.01;
      listed.contact.freeUntil = listed.contact.toi;
    }
    std::stable_sort(answer.contacts.begin(), answer.contacts.end(),
                     [](const AnsweredContact& x, const AnsweredContact& y) {
                       return isReportedBefore(x.contact, y.contact);
                     });
  }
  if (mutation_ == Mutation::LastIsForgotten && answer.kind == StepKind::Consecutive &&
      !answer.contacts.empty()) {
    const LinkId link = answer.contacts.back().contact.link;
    answer.verdicts[static_cast<std::size_t>(link)] = Verdict::Clear;
    answer.contacts.pop_back();
  }
}

}  // namespace foretouch::test
