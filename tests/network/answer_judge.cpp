#include "tests/network/answer_judge.h"

#include <algorithm>
#include <sstream>

#include "middleware/pair/link_query.h"
#include "network/wire/codec.h"
#include "tests/support/judged_answer.h"

namespace foretouch::test {
namespace {

constexpr std::size_t kMostViolations = 20;

bool isOneLife(const PoseId& x, const PoseId& y) {
  return x.sender == y.sender && x.life == y.life;
}

}  // namespace

void AnswerJudge::judge(const HandedPose& pose, const ContactsMessage& answer) {
  SimulationTally& tally = run_.tally;
  ++tally.answered;
  if (answer.kind == StepKind::First) ++tally.timelines;
  if (answer.kind == StepKind::AcrossGap) ++tally.gaps;
  for (const Verdict verdict : answer.verdicts) ++tally.verdicts[static_cast<std::size_t>(verdict)];
  for (const AnsweredContact& contact : answer.contacts) {
    if (contact.contact.verdict != Verdict::Undecided) continue;
    ++tally.reasons[static_cast<std::size_t>(contact.contact.reason)];
  }
  checkForm(pose, answer);
  checkPlace(pose, answer);
  if (canJudge(pose, answer)) judgeLinks(pose, answer);
  last_ = pose;
  hasLast_ = true;
}

/// What holds of every answer, whatever it is about.
void AnswerJudge::checkForm(const HandedPose& pose, const ContactsMessage& answer) {
  if (answer.sequenceTo != pose.sequence || answer.utimeToUs != pose.utimeUs) {
    violation(answer, "is not about the pose that was taken");
  }
  if (answer.verdicts.size() != static_cast<std::size_t>(body_.avatar.numLinks())) {
    violation(answer, "does not have a verdict for every link");
  }
  const auto clear = std::count(answer.verdicts.begin(), answer.verdicts.end(), Verdict::Clear);
  if (answer.contacts.size() + static_cast<std::size_t>(clear) != answer.verdicts.size()) {
    violation(answer, "does not list the links that are not clear");
  }
  for (std::size_t i = 1; i < answer.contacts.size(); ++i) {
    const LinkContact& before = answer.contacts[i - 1].contact;
    if (before.freeUntil > answer.contacts[i].contact.freeUntil) {
      violation(answer, "does not list the earliest first");
    }
  }
  if (answer.kind == StepKind::AcrossGap && clear > 0) violation(answer, "is clear across a gap");
  Bytes bytes, again;
  encode(answer, bytes);
  ContactsMessage decoded;
  const Reject reject = decode(bytes, decoded);
  if (reject != Reject::None) {
    violation(answer, std::string("cannot be read: ") + foretouch::toString(reject));
    return;
  }
  encode(decoded, again);
  if (bytes != again) violation(answer, "is another one after the wire");
}

/// Once each, and in order.
void AnswerJudge::checkPlace(const HandedPose& pose, const ContactsMessage& answer) {
  if (pose.isAltered) {
    ++run_.tally.alteredAnswered;
  } else if (!answered_.insert(pose.id).second) {
    violation(answer, "has been answered before");
  }
  if (answer.kind == StepKind::First) {
    if (answer.sequenceFrom != answer.sequenceTo || answer.utimeFromUs != answer.utimeToUs) {
      violation(answer, "begins a timeline, but not at an instant");
    }
    return;
  }
  if (!hasLast_ || answer.sequenceFrom != last_.sequence || answer.utimeFromUs != last_.utimeUs) {
    violation(answer, "does not begin where the answer before it ended");
  } else if (answer.sequenceTo <= answer.sequenceFrom || answer.utimeToUs <= answer.utimeFromUs) {
    violation(answer, "goes back in time");
  }
}

/// Where the truth between the two poses is known.
bool AnswerJudge::canJudge(const HandedPose& pose, const ContactsMessage& answer) {
  if (pose.isAltered) return false;
  if (answer.kind == StepKind::First) return true;
  if (!hasLast_ || last_.isAltered) return false;
  if (isOneLife(last_.id, pose.id)) {
    if (last_.id.index < pose.id.index) return true;
    violation(answer, "goes back in the sender's poses");
    return false;
  }
  const SimulatedSender& sender = senders_[static_cast<std::size_t>(pose.id.sender)];
  if (last_.id.sender == pose.id.sender && !sender.hasSessions) {
    if (answer.kind == StepKind::Consecutive) ++run_.tally.unknowable;
    return false;
  }
  violation(answer, "is a step from one sender to another");
  return false;
}

void AnswerJudge::judgeLinks(const HandedPose& pose, const ContactsMessage& answer) {
  const Skeleton& skeleton = body_.avatar.skeleton();
  const bool isInstant = answer.kind == StepKind::First;
  const PoseId from = isInstant ? pose.id : last_.id;
  std::vector<oracle::Motion> steps;
  for (PoseId id = from; id.index < pose.id.index; ++id.index) {
    PoseId next = id;
    ++next.index;
    steps.push_back(oracleMotion(skeleton, truth(id), truth(next)));
  }
  if (isInstant) steps.push_back(oracleMotion(skeleton, truth(pose.id), truth(pose.id)));
  for (LinkId link = 0; link < body_.avatar.numLinks(); ++link) {
    if (answer.verdicts[static_cast<std::size_t>(link)] == Verdict::Clear) {
      judgeClear(link, answer, steps);
    }
  }
  const oracle::Motion whole = oracleMotion(skeleton, truth(from), truth(pose.id));
  for (const AnsweredContact& contact : answer.contacts) judgeLink(contact.contact, answer, whole);
}

/// Free in every true step, those among them that nobody told the receiver of.
void AnswerJudge::judgeClear(LinkId link, const ContactsMessage& answer,
                             const std::vector<oracle::Motion>& truth) {
  if (body_.capsules[static_cast<std::size_t>(link)].empty()) return;
  const LinkContact clear = internal::clearContact(link);
  for (const oracle::Motion& step : truth) {
    record(judgement(clear, answer.tolerance, step), link, answer);
  }
}

void AnswerJudge::judgeLink(const LinkContact& contact, const ContactsMessage& answer,
                            const oracle::Motion& motion) {
  if (body_.capsules[static_cast<std::size_t>(contact.link)].empty()) {
    if (contact.verdict != Verdict::Undecided) violation(answer, "touches without a surface");
    return;
  }
  if (contact.verdict == Verdict::Undecided && contact.freeUntil == 0.0) return;  // claims nothing
  record(judgement(contact, answer.tolerance, motion), contact.link, answer);
}

/// Which of the link's LSS it was is not in the message: one of them must fit.
oracle::Judgement AnswerJudge::judgement(const LinkContact& contact, double tolerance,
                                         const oracle::Motion& motion) const {
  const auto& capsules = body_.capsules[static_cast<std::size_t>(contact.link)];
  oracle::Judge judge(scene_.oracle, motion, contact.link, capsules);
  oracle::Answer answer = plain(contact);
  oracle::Judgement result;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    answer.capsule = static_cast<int>(i);
    result = judge.judge(answer, tolerance);
    if (result.finding == oracle::Finding::Ok) break;
  }
  return result;
}

void AnswerJudge::record(const oracle::Judgement& judgement, LinkId link,
                         const ContactsMessage& answer) {
  ++run_.tally.judged;
  if (judgement.finding == oracle::Finding::Ok) return;
  if (judgement.finding == oracle::Finding::Unproved) {
    ++run_.tally.unproved;
    return;
  }
  std::ostringstream what;
  what.precision(17);
  what << "link " << link << " "
       << foretouch::toString(answer.verdicts[static_cast<std::size_t>(link)]) << " -> "
       << toString(judgement.finding) << " " << judgement.what << " at t "
       << static_cast<double>(judgement.time) << ", separation "
       << static_cast<double>(judgement.separation);
  violation(answer, what.str());
}

void AnswerJudge::violation(const ContactsMessage& answer, const std::string& what) {
  if (run_.violations.size() >= kMostViolations) return;
  std::ostringstream line;
  line << "avatar " << answer.avatar << ", session " << answer.session << ", sequence "
       << answer.sequenceFrom << " to " << answer.sequenceTo << " ("
       << foretouch::toString(answer.kind) << "): " << what;
  run_.violations.push_back(line.str());
}

const Pose& AnswerJudge::truth(const PoseId& id) const {
  const auto& lives = senders_[static_cast<std::size_t>(id.sender)].lives;
  return lives[static_cast<std::size_t>(id.life)][static_cast<std::size_t>(id.index)];
}

}  // namespace foretouch::test
