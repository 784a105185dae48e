// network/wire/world_messages.h: the messages of a moving world, as plain values: its bodies, where
// they are, and what happens between them. Units and frames are those of network/wire/lcm, which
// define the bytes. Geometry never travels: a body's shape is a name in the service's world file.
// Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "middleware/events/world_event.h"
#include "middleware/solid_world/solid_world.h"
#include "network/wire/messages.h"

namespace foretouch {

inline constexpr char kBodyChannel[] = "FORETOUCH_BODY";
inline constexpr char kRigidPoseChannel[] = "FORETOUCH_RIGID";
inline constexpr char kEventsChannel[] = "FORETOUCH_EVENTS";
inline constexpr char kPushesChannel[] = "FORETOUCH_PUSHES";

/// The number of a body in messages; at least 0. An avatar has the number of its pose_t.
using BodyNumber = std::int32_t;
inline constexpr BodyNumber kNoBody = -1;

enum class BodyMessageKind : std::int8_t { Rigid = 0, Avatar = 1 };

/// What a body is, and what carries it since when.
struct BodyMessage {
  BodyNumber body = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t utimeUs = 0;  ///< The state is that of this instant.
  std::int64_t sendUtimeUs = 0;
  BodyMessageKind kind = BodyMessageKind::Rigid;
  bool isPresent = true;       ///< False: it is not there from `sinceUs` on.
  std::string shape;           ///< The name of a body of the world file.
  std::int64_t shapeHash = 0;  ///< shapeHash() of it; 0: the sender does not know.
  BodyNumber carrier = kNoBody;
  std::int32_t carrierLink = 0;  ///< 0 without a carrier.
  bool movesInFrame = false;     ///< Carrier::movesInFrame; false without a carrier.
  RigidPose pose;                ///< At `sinceUs`, in the frame of that link, or in W.
  std::int64_t sinceUs = 0;
};

/// One rigid body at the instant of its message.
struct BodyPose {
  BodyNumber body = 0;
  std::uint8_t flags = 0;  ///< JointFlag.
  RigidPose pose;          ///< The identity unless kJointValid.

  /// Valid, and tracked or inferred.
  [[nodiscard]] bool isKnown() const {
    return (flags & kJointValid) != 0 && (flags & (kJointTracked | kJointInferred)) != 0;
  }
};

struct RigidPoseMessage {
  std::int64_t session = 0, sequence = 0;
  std::int64_t utimeUs = 0;  ///< Capture.
  std::int64_t sendUtimeUs = 0;
  std::vector<BodyPose> bodies;  ///< Each at most once.
};

/// A body that is there where a window ends.
struct ToldBody {
  BodyNumber body = 0;
  std::int64_t knownUntilUs = -1;  ///< Its last pose, or state that was due; -1: none.
  bool isWaitedFor = false;        ///< The watermark waits for it.
};

/// Part of a window in which a body is not known: nothing is claimed of it, nor of what it carries.
struct UnknownPart {
  BodyNumber body = 0;
  LinkId link = kEveryLink;
  UndecidedReason reason = UndecidedReason::Gap;
  std::int64_t fromUs = 0, toUs = 0;
};

/// Why a contact ends, as messages report it: there, LeaveCause::Moved is an Apart that says so
/// besides. Only streams know one of the causes.
enum class ToldCause : std::uint8_t { Apart = 0, NotAsked = 1, BodyGone = 2 };
inline constexpr std::uint8_t kNumToldCauses = 3;

/// As WorldEvent, with the numbers that messages give to bodies: kStillScene and kEveryBody stay.
struct ToldEvent {
  WorldEvent event;                    ///< `isAssumed`: rests on something that is not known.
  ToldCause cause = ToldCause::Apart;  ///< For Apart, WorldEvent::cause says whether it is Moved.
};

/// Limits of an events_t, so that its lists fit into kMaxListed, and all into kMaxMessageBytes.
inline constexpr std::size_t kMaxToldEvents = 1024, kMaxToldBodies = 4096, kMaxToldUnknown = 4096;

struct EventsMessage {
  std::int64_t timeline = 0, sequence = 0;
  std::int64_t fromUs = 0, toUs = 0;
  bool hasMore = false;  ///< The next message has more events of the same window.
  double tolerance = 0.0;
  std::vector<ToldBody> bodies;  ///< By number.
  std::vector<UnknownPart> unknown;
  std::vector<ToldEvent> events;
  std::int64_t receiveUtimeUs = 0, sendUtimeUs = 0;
  double worldUs = 0.0;
};

/// A moving body that holds or pushes a solid one: as in its tick, with the number that messages
/// give to that body.
struct ToldPush {
  SolidBodyContact contact;
  std::string linkName;
};
struct ToldCrush {
  SolidCrush crush;
  std::string linkName;
};

/// Limits of a pushes_t: of contacts and of crushes.
inline constexpr std::size_t kMaxToldPushes = 256, kMaxToldCrushes = 256;

/// What presses against a solid body at one tick and moves. Its SolidMessage says the rest.
struct PushesMessage {
  std::int32_t avatar = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t utimeUs = 0, stepUs = 0;
  std::int64_t timeline = 0;
  bool isAssumed = false;
  std::vector<ToldPush> contacts;
  std::int32_t contactsLeftOut = 0;  ///< Beyond kMaxToldPushes.
  std::vector<ToldCrush> crushes;
  std::int32_t crushesLeftOut = 0;  ///< Beyond kMaxToldCrushes.
  std::int64_t receiveUtimeUs = 0, sendUtimeUs = 0;
  double tickUs = 0.0;
};

}  // namespace foretouch
