#include "network/stream/stream_solver.h"

#include <chrono>
#include <limits>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// As in contacts_t: 0 if there is none.
std::int64_t budgetOf(const QueryOptions& options) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return options.workBudget > kMost ? 0 : static_cast<std::int64_t>(options.workBudget);
}

}  // namespace

StreamSolver::StreamSolver(std::int32_t id, Query query, AvatarStream stream)
    : id_(id), query_(std::move(query)), stream_(std::move(stream)) {
  if (options().fidelity != Fidelity::Skinned) return;
  const SkinnedSurface& skin = *options().skin;
  for (LinkId link = 0; link < skin.numLinks(); ++link) {
    movedBy_.push_back(skin.linksMoving(link));
  }
}

Result<StreamSolver> StreamSolver::make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                        const QueryOptions& options, const StreamPolicy& policy) {
  if (options.scope != Scope::EveryLink) {
    return Error::in("scope", ErrorCode::OutOfRange,
                     "expected the scope 'links': of a stream every link is answered");
  }
  if (options.deadlineUs < std::numeric_limits<double>::infinity()) {
    return Error::in("deadline", ErrorCode::OutOfRange,
                     "expected a work budget instead: no clock decides what a stream is answered");
  }
  FORETOUCH_TRY(auto stream, AvatarStream::make(avatar, policy));
  FORETOUCH_TRY(auto query, Query::build(avatar, scene, options));
  return StreamSolver(id, std::move(query), std::move(stream));
}

Result<Done> StreamSolver::makeSolid(const SolidOptions& options) {
  FORETOUCH_TRY(auto solid, SolidStream::make(id_, avatar(), query_.scene(), options));
  solid_.emplace(std::move(solid));
  return Done{};
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
  motion_.assign(avatar().skeleton(), *step.from, *step.to);
  query_.answer(motion_, scratch_, contacts_);
  lastQueryUs_ = std::chrono::duration<double, std::micro>(SteadyClock::now() - start).count();
  fill(step, answer);
  return Reject::None;
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
  answer.tolerance = options().tolerance;
  answer.fidelity = options().fidelity;
  answer.workBudget = budgetOf(options());
  answer.queryUs = lastQueryUs_;

  answer.verdicts.clear();
  for (LinkContact& contact : contacts_.links) {
    const UndecidedReason reason = notClaimed(contact, step);
    if (reason != UndecidedReason::None) contact = undecidedContact(contact.link, 0.0, reason);
    answer.verdicts.push_back(contact.verdict);
  }
  listReported(contacts_.links.data(), contacts_.links.size(), reported_);
  answer.contacts.resize(reported_.size());
  for (std::size_t i = 0; i < reported_.size(); ++i) {
    list(contacts_.links[slotOf(reported_[i])], answer.contacts[i]);
  }
}

UndecidedReason StreamSolver::notClaimed(const LinkContact& found, const StreamStep& step) const {
  const UndecidedReason unknown = unknownOf(found.link, step);
  if (unknown != UndecidedReason::None || step.kind != StepKind::AcrossGap) return unknown;
  const bool isTouching =
      found.verdict == Verdict::Contact || found.verdict == Verdict::StartsInContact;
  return isTouching ? UndecidedReason::None : UndecidedReason::Gap;
}

UndecidedReason StreamSolver::unknownOf(LinkId link, const StreamStep& step) const {
  const std::vector<UndecidedReason>& unknown = *step.unknown;
  const UndecidedReason own = unknown[slotOf(link)];
  if (own != UndecidedReason::None || movedBy_.empty()) return own;
  for (const LinkId moving : movedBy_[slotOf(link)]) {
    const UndecidedReason reason = unknown[slotOf(moving)];
    if (reason != UndecidedReason::None) return reason;
  }
  return UndecidedReason::None;
}

void StreamSolver::list(const LinkContact& contact, AnsweredContact& listed) const {
  listed.contact = contact;
  listed.contact.lss = -1;
  listed.linkName = avatar().skeleton().name(contact.link);
  if (contact.triangle < 0) {
    listed.objectName.clear();
    return;
  }
  const auto object = static_cast<std::size_t>(query_.scene().object(contact.triangle));
  listed.objectName = query_.scene().objectNames()[object];
}

}  // namespace foretouch
