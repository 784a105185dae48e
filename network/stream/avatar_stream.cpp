#include "network/stream/avatar_stream.h"

#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "assets/avatar/joint_match.h"
#include "lss/index.h"
#include "network/stream/pose_assembly.h"
#include "network/stream/stream_timeline.h"

namespace foretouch {
namespace {

constexpr int kFewestConfirmations = 1;

Result<Done> checked(const StreamPolicy& policy) {
  if (policy.maxStepUs < 1 || policy.maxStepUs > kMostStepUs) {
    return Error::in("maxStepUs", ErrorCode::OutOfRange,
                     "expected 1 to " + std::to_string(kMostStepUs) + " microseconds, found " +
                         std::to_string(policy.maxStepUs));
  }
  if (policy.confirmations < kFewestConfirmations || policy.confirmations > kMostConfirmations) {
    return Error::in("confirmations", ErrorCode::OutOfRange,
                     "expected " + std::to_string(kFewestConfirmations) + " to " +
                         std::to_string(kMostConfirmations) + " poses, found " +
                         std::to_string(policy.confirmations));
  }
  return Done{};
}

/// The Reject for an error of Skeleton::build().
Reject rejectOf(const Error& error, const RawSkeleton& raw) {
  switch (error.code) {
    case ErrorCode::NonFinite: return Reject::NonFinite;
    case ErrorCode::BadHierarchy: return Reject::BadHierarchy;
    case ErrorCode::LimitExceeded: return Reject::Limit;
    case ErrorCode::OutOfRange: {  // a rotation or an offset
      const auto& joint = raw.joints[slotOf(error.index)];
      return joint.offset.cwiseAbs().maxCoeff() > kMaxCoordinate ? Reject::OutOfRange
                                                                 : Reject::NonUnit;
    }
    default: return raw.joints.empty() ? Reject::Limit : Reject::BadName;
  }
}

/// The order of a sender's skeletons.
struct SkeletonStamp {
  std::int64_t session = 0;
  std::int32_t generation = 0;
  std::int64_t hash = 0;
};

/// Why `next` may not replace `inUse`, which has another hash.
Reject orderOf(const SkeletonStamp& inUse, const SkeletonStamp& next) {
  if (next.session != inUse.session) {
    return next.session < inUse.session ? Reject::OldSession : Reject::None;
  }
  return next.generation <= inUse.generation ? Reject::OldGeneration : Reject::None;
}

/// A skeleton refused for its age but sent again and again: its sender was restarted, or its clock
/// was set back.
class SkeletonRun {
 public:
  void clear() { count_ = 0; }
  /// Copies of one message count once.
  [[nodiscard]] bool completes(const SkeletonStamp& stamp, std::int64_t sendUtimeUs, int needed) {
    const bool isSame = count_ > 0 && stamp.session == stamp_.session &&
                        stamp.generation == stamp_.generation && stamp.hash == stamp_.hash;
    if (isSame && sendUtimeUs <= sendUtimeUs_) return false;
    count_ = isSame ? count_ + 1 : 1;
    stamp_ = stamp;
    sendUtimeUs_ = sendUtimeUs;
    return count_ >= needed;
  }

 private:
  int count_ = 0;
  SkeletonStamp stamp_;
  std::int64_t sendUtimeUs_ = 0;
};

}  // namespace

/// A skeleton that a sender has said, and the poses of it.
struct KnownSkeleton {
  KnownSkeleton(const SkeletonStamp& order, const Skeleton& avatar, bool unmatchedAtRest)
      : stamp(order), assembly(avatar, unmatchedAtRest) {}
  SkeletonStamp stamp;
  internal::PoseAssembly assembly;
};

struct AvatarStream::Impl {
  Impl(const Avatar& avatar, const StreamPolicy& streamPolicy)
      : policy(streamPolicy), skeleton(avatar.skeleton()), timeline(streamPolicy) {}

  [[nodiscard]] Reject takeSkeleton(const SkeletonMessage& message);
  [[nodiscard]] Reject takePose(const PoseMessage& message, StreamStep& step);
  [[nodiscard]] Reject takeOther(const PoseMessage& message, StreamStep& step);
  void accept(const PoseMessage& message, const internal::PosePlace& place, StreamStep& step);
  void describe(const PoseMessage& message, const internal::PosePlace& place, StreamStep& step);

  StreamPolicy policy;
  Skeleton skeleton;
  std::optional<KnownSkeleton> inUse;
  /// The next one, until its first pose comes (isNext); else the one that was in use before.
  std::optional<KnownSkeleton> other;
  bool isNext = false;
  bool isNewSpeaker = false;
  bool leftTrace = false;
  SkeletonRun oldSkeletons;
  internal::StreamTimeline timeline;
  std::vector<UndecidedReason> unknown;
};

AvatarStream::AvatarStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AvatarStream::AvatarStream(AvatarStream&&) noexcept = default;
AvatarStream& AvatarStream::operator=(AvatarStream&&) noexcept = default;
AvatarStream::~AvatarStream() = default;

Result<AvatarStream> AvatarStream::make(const Avatar& avatar, const StreamPolicy& policy) {
  FORETOUCH_CHECK(checked(policy));
  return AvatarStream(std::make_unique<Impl>(avatar, policy));
}

Reject AvatarStream::take(const SkeletonMessage& message) {
  const Reject reject = impl_->takeSkeleton(message);
  impl_->leftTrace = reject == Reject::OldSession || reject == Reject::OldGeneration;
  if (reject != Reject::None) ++counts_.rejects[slotOf(reject)];
  return reject;
}

Reject AvatarStream::Impl::takeSkeleton(const SkeletonMessage& message) {
  const auto built = Skeleton::build(message.skeleton);
  if (!built.ok()) return rejectOf(built.error(), message.skeleton);
  if (message.hash != skeletonHash(message.skeleton)) return Reject::BadHash;
  const SkeletonStamp stamp{message.session, message.generation, message.hash};
  if (inUse && message.hash == inUse->stamp.hash) {
    if (orderOf(inUse->stamp, stamp) == Reject::None) inUse->stamp = stamp;
    oldSkeletons.clear();
    return Reject::None;
  }
  const auto match = matchJoints(skeleton, built.value());
  if (!match.ok()) return Reject::NoMatch;
  const Reject order = inUse && !isNewSpeaker ? orderOf(inUse->stamp, stamp) : Reject::None;
  if (order != Reject::None &&
      !oldSkeletons.completes(stamp, message.sendUtimeUs, policy.confirmations)) {
    return order;
  }
  oldSkeletons.clear();
  // Said again before its first pose, or while it is the one before: its poses are still good.
  const bool isKnown = other && other->stamp.hash == message.hash;
  std::optional<KnownSkeleton>& place = inUse ? other : inUse;
  if (!isKnown) {
    place.emplace(stamp, skeleton, policy.unmatchedAtRest);
    place->assembly.use(match.value(), built.value().numJoints());
  }
  place->stamp = stamp;
  isNext = other.has_value();
  return Reject::None;
}

bool AvatarStream::leftTrace() const {
  return impl_->leftTrace;
}

void AvatarStream::changeSpeaker() {
  impl_->isNewSpeaker = true;
  impl_->oldSkeletons.clear();
}

std::array<std::optional<std::int64_t>, 2> AvatarStream::knownHashes() const {
  std::array<std::optional<std::int64_t>, 2> hashes;
  if (impl_->inUse) hashes[0] = impl_->inUse->stamp.hash;
  if (impl_->other) hashes[1] = impl_->other->stamp.hash;
  return hashes;
}

Reject AvatarStream::take(const PoseMessage& message, StreamStep& step) {
  ++counts_.poses;
  impl_->leftTrace = false;
  const Reject reject = impl_->takePose(message, step);
  if (reject != Reject::None) {
    ++counts_.rejects[slotOf(reject)];
    return reject;
  }
  ++counts_.accepted;
  if (step.kind == StepKind::First) ++counts_.timelines;
  if (step.kind == StepKind::AcrossGap) ++counts_.gaps;
  if (step.lost > kMostCountedLost) {
    ++counts_.vastGaps;
  } else {
    counts_.lost += static_cast<std::uint64_t>(step.lost);
  }
  return Reject::None;
}

Reject AvatarStream::Impl::takePose(const PoseMessage& message, StreamStep& step) {
  using internal::Beginning;
  if (!inUse) return Reject::UnknownSkeleton;
  if (message.skeletonHash != inUse->stamp.hash) return takeOther(message, step);
  const Reject content = inUse->assembly.check(message);
  if (content != Reject::None) return content;
  const internal::PosePlace place =
      timeline.place({message.session, message.sequence, message.utimeUs},
                     isNewSpeaker ? Beginning::Speaker : Beginning::None);
  leftTrace = place.reject != Reject::Duplicate;
  if (place.reject != Reject::None) return place.reject;
  accept(message, place, step);
  return Reject::None;
}

/// A pose of the skeleton that is said to be the next one, or of the one before: the latter are of
/// a sender whose skeleton another one has replaced, and bring it back if they go on.
Reject AvatarStream::Impl::takeOther(const PoseMessage& message, StreamStep& step) {
  using internal::Beginning;
  if (!other || message.skeletonHash != other->stamp.hash) return Reject::SkeletonMismatch;
  const Reject content = other->assembly.check(message);
  if (content != Reject::None) return content;
  const internal::PoseStamp stamp{message.session, message.sequence, message.utimeUs};
  internal::PosePlace place;
  if (isNewSpeaker) {
    place = timeline.place(stamp, Beginning::Speaker);
  } else {
    place = isNext ? timeline.place(stamp, Beginning::Skeleton) : timeline.placeOfPrevious(stamp);
  }
  leftTrace = place.reject != Reject::Duplicate;
  if (place.reject != Reject::None) return place.reject;
  std::swap(inUse, other);
  isNext = false;
  place.isSession = true;
  accept(message, place, step);
  return Reject::None;
}

void AvatarStream::Impl::accept(const PoseMessage& message, const internal::PosePlace& place,
                                StreamStep& step) {
  oldSkeletons.clear();
  isNewSpeaker = false;
  inUse->assembly.assemble(message, place.isSession);
  describe(message, place, step);
}

void AvatarStream::Impl::describe(const PoseMessage& message, const internal::PosePlace& place,
                                  StreamStep& step) {
  const internal::PoseAssembly::Known& to = inUse->assembly.later();
  const auto& from = place.kind == StepKind::First ? to : inUse->assembly.earlier();
  internal::findUnknownLinks(skeleton, from.reasons, to.reasons, unknown);
  step.kind = place.kind;
  step.from = &from.pose;
  step.to = &to.pose;
  step.session = message.session;
  step.sequenceFrom = place.from.sequence;
  step.sequenceTo = message.sequence;
  step.utimeFromUs = place.from.utimeUs;
  step.utimeToUs = message.utimeUs;
  step.skeletonHash = message.skeletonHash;
  step.lost = place.lost;
  step.unknown = &unknown;
  step.unknownJoints = &to.reasons;
}

}  // namespace foretouch
