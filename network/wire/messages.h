// network/wire/messages.h: the messages on the wire, as plain values, and why one was not accepted.
// Units and frames are those of network/lcm/*.lcm, which define the bytes: metres, unit quaternions
// (w, x, y, z), microseconds since the Unix epoch; parent-relative poses (roots: in the world W).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/bracket/bracket.h"
#include "middleware/query/query.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch {

enum class Reject : std::uint8_t {
  None,
  // About the bytes.
  Length,        ///< Shorter or longer than its own counts say, or a text without its end.
  Fingerprint,   ///< Another type's, or another version's.
  Version,       ///< The `version` field is not kMessageVersion.
  Limit,         ///< A count beyond its limit.
  NonFinite,     ///< NaN or infinity in a joint that is marked valid, or in another message.
  NonUnit,       ///< A quaternion whose norm is off by more than kMaxQuaternionNormError.
  OutOfRange,    ///< A finite number outside its range: a coordinate, a time, a flag.
  BadName,       ///< Not a legal joint name, or one that a skeleton has twice.
  BadIndex,      ///< A joint or link that cannot exist, or one that is listed twice.
  BadHierarchy,  ///< A parent after its child.
  BadHash,       ///< A skeleton whose hash is not that of its content.
  // About the content.
  UnknownAvatar,     ///< The service does not have this avatar.
  NoMatch,           ///< A skeleton without any joint name of the avatar's.
  OldGeneration,     ///< A skeleton older than the one in use.
  UnknownSkeleton,   ///< A pose before any skeleton.
  SkeletonMismatch,  ///< A pose of another skeleton than the one in use.
  // About its place in the stream.
  Duplicate,      ///< The same session, sequence and capture time again.
  OutOfOrder,     ///< Older than a pose that has been answered.
  StaleStamp,     ///< A later sequence with a capture time that is not later.
  FutureStamp,    ///< Captured longer than StreamPolicy::maxStepUs after the last pose.
  OldSession,     ///< From a sender that has been restarted since.
  FutureSession,  ///< Its sender says it starts more than a day after the message arrived.
  Late,           ///< For an instant that the world has answered already.
  // About a moving world.
  UnknownBody,   ///< A pose of a body not introduced before; a carrier or link that is not there.
  HeldFast,      ///< A pose of a body that another one holds fast.
  UnknownShape,  ///< A body whose shape is not in the world file.
  CarrierLoop,   ///< A body that would carry itself.
  SolidCarrier,  ///< A body that a solid one would carry.
  // About its sender.
  OtherSender,      ///< Not from the address and port that speak for the avatar.
  Unauthenticated,  ///< Without the code that the key makes, or with another one.
  Replayed,         ///< With a right code, and old, or of a time that is not now.
  // About the service.
  Overrun,  ///< The oldest waiting pose when the queue was full.
};
inline constexpr std::size_t kNumRejects = static_cast<std::size_t>(Reject::Overrun) + 1;

/// A stable word, as it appears in status_t and in metrics: "out-of-order"; "none".
[[nodiscard]] const char* toString(Reject reject);

/// The number of refusals for each reason.
using RejectCounts = std::array<std::uint64_t, kNumRejects>;

inline constexpr std::int16_t kMessageVersion = 1;

/// Channels; a second instance may add a suffix to all of them.
inline constexpr char kSkeletonChannel[] = "FORETOUCH_SKELETON";
inline constexpr char kPoseChannel[] = "FORETOUCH_POSE";
inline constexpr char kContactsChannel[] = "FORETOUCH_CONTACTS";
inline constexpr char kSolidChannel[] = "FORETOUCH_SOLID";
inline constexpr char kPersonChannel[] = "FORETOUCH_PERSON";
inline constexpr char kStatusChannel[] = "FORETOUCH_STATUS";
/// For logs only.
inline constexpr char kSpeakerChannel[] = "FORETOUCH_SPEAKER";
/// Length of a whole channel name, suffix included, in bytes (LCM_MAX_CHANNEL_NAME_LENGTH).
inline constexpr std::size_t kMaxChannelBytes = 63;

/// Largest message, in bytes: a skeleton of kMaxJoints joints with long names fits.
inline constexpr std::size_t kMaxMessageBytes = 4u << 20;
/// Longest text in a message other than a joint's name, in bytes.
inline constexpr std::size_t kMaxTextBytes = 4096;

struct SkeletonMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0;
  std::int64_t sendUtimeUs = 0;
  std::int32_t generation = 0;
  std::int64_t hash = 0;  ///< skeletonHash() of `skeleton`.
  std::string source;
  double rateHz = 0.0;  ///< 0: unknown.
  RawSkeleton skeleton;
};

/// Bits of PoseJoint::flags.
enum JointFlag : std::uint8_t { kJointValid = 1, kJointTracked = 2, kJointInferred = 4 };
constexpr std::uint8_t kKnownJointFlags = kJointValid | kJointTracked | kJointInferred;

struct PoseJoint {
  std::int32_t joint = 0;  ///< Index in the sender's skeleton.
  std::uint8_t flags = 0;
  Quaternion rotation = Quaternion::Identity();  ///< Meaningless unless kJointValid.
};

struct PoseTranslation {
  std::int32_t joint = 0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Sequences from here on are a receiver's own count, for a sender that numbers nothing (VMC): that
/// no pose was lost between two of them cannot be known, and no step is Consecutive.
inline constexpr std::int64_t kFirstUncounted = std::int64_t{1} << 61;
/// From here on it does not say when poses were captured, either: their times are of receipt, and
/// no claim may rest on the time between them.
inline constexpr std::int64_t kFirstUntimed = kFirstUncounted + (std::int64_t{1} << 60);
/// Times of capture of uncounted poses are off by at most half of this (us).
inline constexpr std::int64_t kUncountedClockUs = 4000;

struct PoseMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0;
  std::int64_t sequence = 0;
  std::int64_t utimeUs = 0;  ///< Capture.
  std::int64_t sendUtimeUs = 0;
  std::int64_t skeletonHash = 0;
  std::vector<PoseJoint> joints;              ///< Each joint at most once, in any order.
  std::vector<PoseTranslation> translations;  ///< For joints that are in `joints`.
};

/// The kind of step that an answer covers.
enum class StepKind : std::int8_t {
  Consecutive = 0,  ///< From one sent pose to the next.
  First = 1,        ///< The first pose of a timeline: an instant, not a motion.
  AcrossGap = 2,    ///< Poses between the two were lost: nothing is clear.
};
inline constexpr std::int8_t kNumStepKinds = 3;
[[nodiscard]] const char* toString(StepKind kind);

/// One link that is not clear.
struct AnsweredContact {
  LinkContact contact;  ///< `lss` does not travel (-1).
  std::string linkName, objectName;
};

struct ContactsMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0;
  std::int64_t sequenceFrom = 0, sequenceTo = 0;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;  ///< Capture.
  std::int64_t skeletonHash = 0;
  StepKind kind = StepKind::Consecutive;
  std::int64_t lost = 0;
  double tolerance = 0.0;
  Fidelity fidelity = Fidelity::Link;
  std::int64_t workBudget = 0;            ///< QueryOptions::workBudget; 0: none.
  std::vector<Verdict> verdicts;          ///< One per link of the avatar, in order.
  std::vector<AnsweredContact> contacts;  ///< Links that are not clear, earliest first.
  std::int64_t receiveUtimeUs = 0;
  std::int64_t sendUtimeUs = 0;
  double queryUs = 0.0;
};

/// Limits of a solid_t: the largest fits into kMaxMessageBytes.
inline constexpr std::size_t kMaxSolidJoints = 512, kMaxSolidPoses = 64, kMaxSolidContacts = 256;

/// What holds the shown pose from the tracked one at one place.
struct ShownContact {
  SolidContact contact;
  std::string linkName;
  std::string otherName;  ///< The object, or the own link, that is touched.
};

/// What a solid avatar shows at one pose. Poses are of the avatar's joints, bit for bit as proven.
struct SolidMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t utimeUs = 0;  ///< Capture.
  StepKind kind = StepKind::First;
  std::int64_t lost = 0;
  std::int64_t stepUs = 0;      ///< The time from the pose before, as the avatar got it.
  std::int64_t avatarHash = 0;  ///< skeletonHash() of the avatar's skeleton.
  double skin = 0.0, tolerance = 0.0, catchUp = 0.0;
  std::int64_t workBudget = 0;

  SolidState state = SolidState::Placing;
  SolidLimit limit = SolidLimit::None;
  bool isCertified = false, hasAppeared = false;
  double deviation = 0.0, lift = 0.0;
  double clearance = 0.0;  ///< 0 if it is not certified, or did not move.
  std::int64_t snapInUs = -1;
  std::vector<SolidJointState> joints;  ///< One per joint.
  std::vector<double> linkDeviation;    ///< One per link.
  /// At least one pose, the last of which is shown, and when each is reached, in (0, 1] of the
  /// step; at 0 where it appeared, or if it did not move.
  std::vector<Pose> way;
  std::vector<double> times;
  std::vector<ShownContact> contacts;
  std::int32_t contactsLeftOut = 0;  ///< Beyond kMaxSolidContacts.
  SolidCounters counters;

  std::int64_t receiveUtimeUs = 0, sendUtimeUs = 0;
  double solidUs = 0.0;

  [[nodiscard]] const Pose& shown() const { return way.back(); }
};

/// Brackets in a person_t.
inline constexpr std::size_t kMaxPersonBrackets = 256;

/// What a link, or two of them, perhaps or surely touched in a step.
struct ToldBracket {
  LinkBracket bracket;
  std::string linkName;
  std::string otherName;  ///< The object, or the own link, that is touched.
};

/// A claim that a pose shows to be wrong.
struct BrokenBound {
  enum class Claim : std::uint8_t {
    InGap,  ///< LinkBound::speed: two poses are farther apart.
    Ahead,  ///< LinkBound::aheadSpeed and aheadAcceleration: the next pose is elsewhere.
  };
  LinkId link = 0;
  Claim claim = Claim::InGap;
  double beyond = 0.0;  ///< By how much (m).
};
/// "gap", "ahead".
[[nodiscard]] const char* toString(BrokenBound::Claim claim);

/// What the person did in a step, within bounds, and what may come. t is 0 at the step's earlier
/// pose and 1 at its later one.
struct PersonMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t utimeUs = 0;  ///< Capture of the pose that let this be said.
  MotionModel model = MotionModel::ConstantRate;
  std::int64_t boundsHash = 0;
  double resolution = 0.0;

  StepKind kind = StepKind::First;  ///< The step's; First: none is answered.
  std::int64_t sequenceFrom = 0, sequenceTo = 0;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
  std::vector<BracketVerdict> verdicts;   ///< Each link's with the scene, in order.
  std::vector<std::int64_t> notBeforeUs;  ///< As many: no touch until then; -1: not claimed.
  std::int64_t aheadUs = 0;               ///< How far it looks ahead of utimeUs; 0: not at all.
  std::vector<ToldBracket> brackets;      ///< What is Possible or Certain.
  std::int32_t bracketsLeftOut = 0;       ///< Beyond kMaxPersonBrackets.
  std::vector<BrokenBound> broken;

  std::int64_t receiveUtimeUs = 0, sendUtimeUs = 0;
  double personUs = 0.0;

  /// It is about links that poses in between did not know, and about no other.
  [[nodiscard]] bool isOfFoundLinks() const {
    return kind == StepKind::AcrossGap && sequenceTo < sequence;
  }
};

struct StatusMessage {
  std::int64_t utimeUs = 0, startUtimeUs = 0;
  std::string build, scene;
  std::int32_t numAvatars = 0, numWorkers = 0;
  std::int64_t received = 0, answered = 0, rejected = 0, lost = 0, gaps = 0, waiting = 0;
  struct Count {
    std::string reason;
    std::int64_t count = 0;
  };
  std::vector<Count> counts;
  std::int64_t publishFailures = 0, journalFailures = 0, kernelDrops = 0;
  double latencyP50Us = 0.0, latencyP99Us = 0.0, latencyMaxUs = 0.0;
  double queryP50Us = 0.0, queryP99Us = 0.0, queryMaxUs = 0.0;
};

/// What a service's log holds of an avatar from here on comes from another sender.
struct SpeakerMessage {
  std::int32_t avatar = 0;
  std::int64_t utimeUs = 0;   ///< Receipt of its first message.
  std::uint32_t address = 0;  ///< IPv4, in host byte order.
  std::uint16_t port = 0;     ///< UDP, in host byte order.
};

/// The hash of names, parents and rest pose, as defined in docs/formats.md ("Skeleton hash"): XXH64
/// over the joints in order. Two skeletons with the same hash count as the same.
[[nodiscard]] std::int64_t skeletonHash(const RawSkeleton& skeleton);

}  // namespace foretouch
