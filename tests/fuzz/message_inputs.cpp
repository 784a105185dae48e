#include "tests/fuzz/message_inputs.h"

#include <algorithm>
#include <cmath>
#include <foretouch/skeleton_t.hpp>
#include <set>
#include <string>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/payload_check.h"
#include "network/wire/world_messages.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

bool sameBytes(ByteView a, const Bytes& b) {
  return a.size == b.size() && std::equal(b.begin(), b.end(), a.data);
}

void checkContent(const SkeletonMessage& message) {
  require(Skeleton::build(message.skeleton).ok(), "an accepted skeleton can be built");
  require(std::isfinite(message.rateHz), "the rate is finite");
}

void checkContent(const PoseMessage& message) {
  std::set<std::int32_t> joints, translated;
  for (const PoseJoint& joint : message.joints) {
    require(joint.joint >= 0 && joint.joint < kMaxJoints, "a skeleton may have the joint");
    require(joints.insert(joint.joint).second, "a joint is there once");
    require(unitQuaternion(joint.rotation).has_value(), "rotations are unit");
  }
  for (const PoseTranslation& joint : message.translations) {
    require(joints.count(joint.joint) == 1, "translated joints are listed");
    require(translated.insert(joint.joint).second, "a joint is translated once");
    require(joint.translation.cwiseAbs().maxCoeff() <= kMaxCoordinate, "translations are bounded");
  }
}

void checkContent(const ContactsMessage& message) {
  std::set<LinkId> listed;
  for (const AnsweredContact& answered : message.contacts) {
    const LinkContact& contact = answered.contact;
    require(contact.link >= 0 && static_cast<std::size_t>(contact.link) < message.verdicts.size(),
            "a contact's link exists");
    require(listed.insert(contact.link).second, "a link is there once");
    require(contact.verdict == message.verdicts[static_cast<std::size_t>(contact.link)] &&
                contact.verdict != Verdict::Clear,
            "contacts have the verdicts");
    require((contact.reason != UndecidedReason::None) == (contact.verdict == Verdict::Undecided),
            "what is undecided has a reason");
    require(contact.freeUntil >= 0.0 && contact.freeUntil <= 1.0, "times are normalised");
  }
  const auto clear = std::count(message.verdicts.begin(), message.verdicts.end(), Verdict::Clear);
  require(message.verdicts.size() - static_cast<std::size_t>(clear) == listed.size(),
          "every link that is not clear is listed");
}

void checkContent(const PersonMessage& message) {
  const std::size_t links = message.verdicts.size();
  require(message.notBeforeUs.size() == links, "every link has its instant");
  require(message.brackets.size() <= kMaxPersonBrackets, "brackets are bounded");
  for (const ToldBracket& told : message.brackets) {
    const LinkBracket& bracket = told.bracket;
    require(static_cast<std::size_t>(bracket.link) < links, "a bracket's link exists");
    require(bracket.other == kNoParent || static_cast<std::size_t>(bracket.other) < links,
            "so does the other one");
    require(
        bracket.verdict == BracketVerdict::Possible || bracket.verdict == BracketVerdict::Certain,
        "what is told is possible or certain");
    for (const double t :
         {bracket.possibleFrom, bracket.possibleUntil, bracket.certainFrom, bracket.certainUntil}) {
      require(t >= 0.0 && t <= 1.0, "times are normalised");
    }
  }
  for (const BrokenBound& broken : message.broken) {
    require(static_cast<std::size_t>(broken.link) < links && broken.beyond >= 0.0,
            "a broken bound is a link's");
  }
}

void checkContent(const SolidMessage& message) {
  const std::size_t joints = message.joints.size();
  require(joints >= 1 && joints <= kMaxSolidJoints && message.linkDeviation.size() == joints,
          "every joint has its state");
  require(!message.way.empty() && message.way.size() <= kMaxSolidPoses &&
              message.times.size() == message.way.size(),
          "every pose of a way has its time");
  double last = -1.0;
  for (const double time : message.times) {
    require(time > last && time >= 0.0 && time <= 1.0, "times go on and are normalised");
    last = time;
  }
  for (const Pose& pose : message.way) {
    require(pose.rotations.size() == joints && pose.translations.size() == joints,
            "a pose has a joint per link");
    for (const Quaternion& rotation : pose.rotations) {
      require(unitQuaternion(rotation).has_value(), "rotations are unit");
    }
    for (const Eigen::Vector3d& translation : pose.translations) {
      require(translation.cwiseAbs().maxCoeff() <= kMaxCoordinate, "translations are bounded");
    }
  }
  for (const ShownContact& shown : message.contacts) {
    const SolidContact& contact = shown.contact;
    require(contact.link >= 0 && slotOf(contact.link) < joints, "a contact's link exists");
    require(contact.other == kNoParent || slotOf(contact.other) < joints, "so does the other");
    require(std::isfinite(contact.push) && contact.push >= 0.0, "a push is some");
  }
}

void checkContent(const SpeakerMessage& message) {
  require(message.avatar >= 0 && message.utimeUs >= 0, "a speaker speaks for an avatar");
}

void checkContent(const StatusMessage& message) {
  require(std::isfinite(message.latencyMaxUs), "latencies are finite");
}

void checkContent(const BodyMessage& message) {
  require(message.body >= 0, "a body has a number");
  require(!message.shape.empty(), "a body has a shape");
  require(message.carrier != message.body, "a body does not carry itself");
  require(message.carrier != kNoBody || !message.movesInFrame, "nobody moves in no frame");
  require(unitQuaternion(message.pose.rotation).has_value(), "its rotation is unit");
  require(message.pose.translation.cwiseAbs().maxCoeff() <= kMaxCoordinate, "it is near enough");
}

void checkContent(const RigidPoseMessage& message) {
  std::set<BodyNumber> bodies;
  for (const BodyPose& told : message.bodies) {
    require(told.body >= 0 && bodies.insert(told.body).second, "a body is there once");
    require(unitQuaternion(told.pose.rotation).has_value(), "rotations are unit");
    require(told.pose.translation.cwiseAbs().maxCoeff() <= kMaxCoordinate, "it is near enough");
  }
}

void checkContent(const EventsMessage& message) {
  require(message.fromUs <= message.toUs, "a window does not end before it begins");
  require(message.events.size() <= kMaxToldEvents, "events are not too many");
  for (const ToldEvent& told : message.events) {
    require(told.event.numPoints <= WorldEvent::kMostPoints, "points are not too many");
    require(told.event.time.fraction >= 0.0 && told.event.time.fraction < 1.0, "fractions are");
    require(told.event.separation == told.event.separation, "numbers are numbers");
  }
  for (const UnknownPart& part : message.unknown) {
    require(part.fromUs >= message.fromUs && part.toUs <= message.toUs, "parts are of the window");
  }
}

void checkContent(const PushesMessage& message) {
  require(message.avatar >= 0, "a solid body has a number");
  require(message.contacts.size() <= kMaxToldPushes, "contacts are not too many");
  require(message.crushes.size() <= kMaxToldCrushes, "crushes are not too many");
  for (const ToldPush& told : message.contacts) {
    const SolidBodyContact& contact = told.contact;
    require(contact.body >= 0 && contact.body != message.avatar, "somebody else presses");
    require(contact.link >= 0 && contact.link < kMaxJoints, "a body may have the link");
    require(std::isfinite(contact.push) && contact.push >= 0.0, "a push is some");
    require(std::isfinite(contact.slipSpeed) && contact.slipSpeed >= 0.0, "a speed is some");
    require(contact.nhat_W.allFinite() && contact.p_W.allFinite(), "places are places");
  }
  for (const ToldCrush& told : message.crushes) {
    require(told.crush.body >= 0 && told.crush.body != message.avatar, "somebody else crushes");
    require(std::isfinite(told.crush.depth) && told.crush.depth >= 0.0, "a depth is some");
    require(told.crush.sinceUs >= 0, "it began");
  }
}

/// `exactly`: as the same bytes.
template <typename Message>
bool feed(ByteView input, Message& message, bool (*exactly)(const Message&)) {
  if (decode(input, message) != Reject::None) return false;
  checkContent(message);
  Bytes written, again;
  encode(message, written);
  require(!exactly(message) || sameBytes(input, written), "a message is written as it was read");
  require(decode(written, message) == Reject::None, "a written message is read");
  encode(message, again);
  require(again == written, "a written message is read as it was");
  return true;
}

template <typename Message>
bool feedExact(const std::uint8_t* data, std::size_t size) {
  static Message message;  // reused, as a receiver does
  return feed<Message>({data, size}, message, [](const Message&) { return true; });
}

/// With the hash of what it says: a fuzzer cannot find it.
Bytes withHash(ByteView input) {
  Bytes bytes(input.data, input.data + input.size);
  if (checkPayload(PayloadType::Skeleton, bytes) != Reject::None) return bytes;
  skeleton_t wire;
  wire.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  RawSkeleton skeleton;
  for (std::size_t i = 0; i < wire.names.size(); ++i) {
    skeleton.joints.push_back(
        {wire.names[i],
         wire.parents[i],
         {wire.offset_x[i], wire.offset_y[i], wire.offset_z[i]},
         {wire.rotation_w[i], wire.rotation_x[i], wire.rotation_y[i], wire.rotation_z[i]}});
  }
  wire.hash = skeletonHash(skeleton);
  wire.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

bool feedSkeletonMessage(const std::uint8_t* data, std::size_t size) {
  const bool accepted = feedExact<SkeletonMessage>(data, size);
  if (accepted) return true;
  const Bytes hashed = withHash({data, size});
  return feedExact<SkeletonMessage>(hashed.data(), hashed.size());
}

bool feedPoseMessage(const std::uint8_t* data, std::size_t size) {
  static PoseMessage message;
  return feed<PoseMessage>({data, size}, message, [](const PoseMessage& pose) {
    return std::all_of(pose.joints.begin(), pose.joints.end(),
                       [](const PoseJoint& joint) { return (joint.flags & kJointValid) != 0; });
  });
}

bool feedContactsMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<ContactsMessage>(data, size);
}

bool feedSolidMessage(const std::uint8_t* data, std::size_t size) {
  static SolidMessage message;
  // Rotations that are nearly unit are read as unit ones.
  return feed<SolidMessage>({data, size}, message, [](const SolidMessage&) { return false; });
}

bool feedPersonMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<PersonMessage>(data, size);
}

bool feedSpeakerMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<SpeakerMessage>(data, size);
}

bool feedStatusMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<StatusMessage>(data, size);
}

bool feedBodyMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<BodyMessage>(data, size);
}

bool feedRigidPoseMessage(const std::uint8_t* data, std::size_t size) {
  static RigidPoseMessage message;
  return feed<RigidPoseMessage>({data, size}, message, [](const RigidPoseMessage& poses) {
    return std::all_of(poses.bodies.begin(), poses.bodies.end(),
                       [](const BodyPose& told) { return (told.flags & kJointValid) != 0; });
  });
}

bool feedEventsMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<EventsMessage>(data, size);
}

bool feedPushesMessage(const std::uint8_t* data, std::size_t size) {
  return feedExact<PushesMessage>(data, size);
}

}  // namespace foretouch::fuzz
