#include "network/stream/stream_solver.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "lss/assert.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

AnswerReason reasonOf(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::None: return AnswerReason::None;
    case UndecidedReason::WorkBudget: return AnswerReason::WorkBudget;
    case UndecidedReason::Resolution: return AnswerReason::Resolution;
    case UndecidedReason::AfterFirst: return AnswerReason::AfterFirst;
  }
  return AnswerReason::Resolution;
}

/// Nothing is claimed of the link.
LinkContact nothingOf(LinkId link) {
  LinkContact contact;
  contact.link = link;
  return contact;
}

/// As contacts_t says it: 0 where there is none.
std::int64_t budgetOf(const QueryOptions& options) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return options.workBudget > kMost ? 0 : static_cast<std::int64_t>(options.workBudget);
}

}  // namespace

StreamSolver::StreamSolver(std::int32_t id, const Avatar& avatar, const Scene& scene,
                           const QueryOptions& options, AvatarStream stream)
    : id_(id), avatar_(avatar), scene_(scene), options_(options), stream_(std::move(stream)) {
  if (options_.fidelity != Fidelity::Skinned || !options_.skin) return;
  for (LinkId link = 0; link < options_.skin->numLinks(); ++link) {
    movedBy_.push_back(options_.skin->linksMoving(link));
  }
}

Result<StreamSolver> StreamSolver::make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                        const QueryOptions& options, const StreamPolicy& policy) {
  if (options.scope != Scope::EveryLink) {
    return Error{ErrorCode::OutOfRange, "scope", -1, -1,
                 "expected the scope 'links': of a stream every link is answered"};
  }
  if (options.fidelity != Fidelity::Link && options.fidelity != Fidelity::Exact &&
      options.fidelity != Fidelity::Skinned) {
    return Error{ErrorCode::OutOfRange, "fidelity", -1, -1,
                 "expected link, exact or skinned: one joint that is not known would be in the "
                 "volume of many links"};
  }
  if (options.deadlineUs < std::numeric_limits<double>::infinity()) {
    return Error{ErrorCode::OutOfRange, "deadline", -1, -1,
                 "expected a work budget instead: no clock decides what a stream is answered"};
  }
  auto stream = AvatarStream::make(avatar, policy);
  if (!stream.ok()) return stream.error();
  StreamSolver solver(id, avatar, scene, options, std::move(stream).value());
  const Pose rest = restPose(avatar.skeleton());
  const auto tried = solver.query(rest, rest);
  if (!tried.ok()) return tried.error();
  return solver;
}

Reject StreamSolver::take(const SkeletonMessage& message) {
  return message.avatar == id_ ? stream_.take(message) : Reject::UnknownAvatar;
}

Reject StreamSolver::take(const PoseMessage& message, ContactsMessage& answer) {
  if (message.avatar != id_) return Reject::UnknownAvatar;
  StreamStep step;
  const Reject reject = stream_.take(message, step);
  if (reject != Reject::None) return reject;
  lastStep_ = step;
  const SteadyClock::time_point start = SteadyClock::now();
  const auto done = query(*step.from, *step.to);
  lastQueryUs_ = std::chrono::duration<double, std::micro>(SteadyClock::now() - start).count();
  FORETOUCH_ASSERT(done.ok());  // make() has tried these options
  if (!done.ok()) {
    for (LinkContact& contact : contacts_.links) {
      contact = nothingOf(contact.link);
      contact.reason = UndecidedReason::Resolution;
    }
  }
  fill(step, answer);
  return Reject::None;
}

Result<Done> StreamSolver::query(const Pose& from, const Pose& to) {
  motion_.assign(avatar_.skeleton(), from, to);
  return firstContacts(avatar_, motion_, scene_, options_, scratch_, contacts_);
}

void StreamSolver::fill(const StreamStep& step, ContactsMessage& answer) {
  answer.avatar = id_;
  answer.session = step.session;
  answer.sequenceFrom = step.sequenceFrom;
  answer.sequenceTo = step.sequenceTo;
  answer.utimeFromUs = step.utimeFromUs;
  answer.utimeToUs = step.utimeToUs;
  answer.skeletonHash = step.skeletonHash;
  answer.kind = step.kind;
  answer.lost = step.lost;
  answer.tolerance = options_.tolerance;
  answer.fidelity = options_.fidelity;
  answer.workBudget = budgetOf(options_);
  answer.queryUs = lastQueryUs_;

  notClear_.clear();
  answer.verdicts.resize(contacts_.links.size());
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    AnswerReason reason = AnswerReason::None;
    const LinkContact contact = answered(link, step, reason);
    answer.verdicts[static_cast<std::size_t>(link)] = contact.verdict;
    if (contact.verdict != Verdict::Clear) notClear_.emplace_back(contact, reason);
  }
  std::sort(notClear_.begin(), notClear_.end(),
            [](const auto& x, const auto& y) { return isReportedBefore(x.first, y.first); });
  answer.contacts.resize(notClear_.size());
  for (std::size_t i = 0; i < notClear_.size(); ++i) {
    list(notClear_[i].first, notClear_[i].second, answer.contacts[i]);
  }
}

LinkContact StreamSolver::answered(LinkId link, const StreamStep& step,
                                   AnswerReason& reason) const {
  const LinkContact& found = contacts_.links[static_cast<std::size_t>(link)];
  const bool isTouching =
      found.verdict == Verdict::Contact || found.verdict == Verdict::StartsInContact;
  reason = unknownOf(link, step);
  if (reason == AnswerReason::None && step.kind == StepKind::AcrossGap && !isTouching) {
    reason = AnswerReason::Gap;
  }
  if (reason != AnswerReason::None) return nothingOf(link);
  if (found.verdict == Verdict::Undecided) reason = reasonOf(found.reason);
  return found;
}

AnswerReason StreamSolver::unknownOf(LinkId link, const StreamStep& step) const {
  const std::vector<AnswerReason>& unknown = *step.unknown;
  const AnswerReason own = unknown[static_cast<std::size_t>(link)];
  if (own != AnswerReason::None || movedBy_.empty()) return own;
  for (const LinkId moving : movedBy_[static_cast<std::size_t>(link)]) {
    const AnswerReason reason = unknown[static_cast<std::size_t>(moving)];
    if (reason != AnswerReason::None) return reason;
  }
  return AnswerReason::None;
}

void StreamSolver::list(const LinkContact& contact, AnswerReason reason,
                        AnsweredContact& listed) const {
  listed.contact = contact;
  listed.contact.lss = -1;
  listed.reason = reason;
  listed.linkName = avatar_.skeleton().name(contact.link);
  if (contact.triangle < 0) {
    listed.objectName.clear();
    return;
  }
  const auto object = static_cast<std::size_t>(scene_.object(contact.triangle));
  listed.objectName = scene_.objectNames()[object];
}

}  // namespace foretouch
