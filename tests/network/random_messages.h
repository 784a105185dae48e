// tests/network/random_messages.h: random messages that every decoder must accept, with a fair
// share of awkward ones: empty lists, the largest numbers, denormals, -0.0, names of any UTF-8.
#pragma once

#include "network/wire/messages.h"
#include "network/wire/world_messages.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

[[nodiscard]] SkeletonMessage randomSkeletonMessage(Random& random, int numJoints);
/// Joints below `numJoints` in a random order, some missing. Values of invalid joints are those
/// that decoding gives: the identity, zero.
[[nodiscard]] PoseMessage randomPoseMessage(Random& random, int numJoints);
[[nodiscard]] ContactsMessage randomContactsMessage(Random& random, int numLinks);
/// Rotations are unit up to rounding: decoding keeps them.
[[nodiscard]] SolidMessage randomSolidMessage(Random& random, int numJoints, int numPoses,
                                              int numContacts);
/// Brackets only where there are links.
[[nodiscard]] PersonMessage randomPersonMessage(Random& random, int numLinks, int numBrackets);
[[nodiscard]] StatusMessage randomStatusMessage(Random& random, int numReasons);
[[nodiscard]] SpeakerMessage randomSpeakerMessage(Random& random);
/// `longest`: of the name of its shape, in characters, and at least one.
[[nodiscard]] BodyMessage randomBodyMessage(Random& random, int longest);
/// Poses of bodies that are not valid are those that decoding gives: the identity.
[[nodiscard]] RigidPoseMessage randomRigidPoseMessage(Random& random, int numBodies);
/// So many of each of its lists.
[[nodiscard]] EventsMessage randomEventsMessage(Random& random, int numEvents);
/// So many contacts, and crushes.
[[nodiscard]] PushesMessage randomPushesMessage(Random& random, int numContacts);

}  // namespace foretouch::test
