// middleware/events/world_event.h: what happens between bodies of a world: which enters and leaves
// which, when, where and how hard; and the parts of world time in which two are in contact. Metres,
// seconds, kilograms, in W. The promise: docs/guarantees.md 17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "middleware/contact.h"
#include "middleware/scene/scene.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// In an event about a whole body, in place of the other one: all that it is asked about.
inline constexpr BodyId kEveryBody = -2;

/// In the order of events of one instant: what ends comes before what begins.
enum class EventKind : std::uint8_t {
  Leave,           ///< A contact ends: the two are free from here on.
  UnresolvedTo,    ///< It is known again what the two do.
  StartsInside,    ///< They are in contact where they are known first: no touch was seen.
  Enter,           ///< They were free, and are in contact from here on.
  UnresolvedFrom,  ///< Nothing is claimed of the two from here on; a contact of theirs ends,
                   ///< too.
};
inline constexpr std::size_t kNumEventKinds = 5;
/// "leave", "unresolved_to", "starts_inside", "enter", "unresolved_from".
[[nodiscard]] const char* toString(EventKind kind);

/// Why a contact ends.
enum class LeaveCause : std::uint8_t {
  Apart,     ///< They are apart: proven.
  NotAsked,  ///< They are not asked any more: one carries the other, or World::ask() says so.
  Moved,     ///< One of them, or what carries it, is put elsewhere there, with a jump.
};

/// Two points, one of each side, that are near at an event's instant.
struct EventPoint {
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero(), p_WB = Eigen::Vector3d::Zero();
  double separation = 0.0;  ///< As computed; below zero where the two overlap.
};

/// One thing that happens to two links, or to a link and an object of a mesh or of the static
/// scene.
struct WorldEvent {
  static constexpr std::size_t kMostPoints = 4;

  EventKind kind = EventKind::Enter;
  LeaveCause cause = LeaveCause::Apart;  ///< For Leave. Unless Apart: the places, speeds and
                                         ///< points are the last ones, of the motion before.
  /// For UnresolvedFrom and UnresolvedTo. Gap: a body is silent.
  UndecidedReason reason = UndecidedReason::None;
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
  WorldTime time;
  /// For Leave and UnresolvedTo: when what ends here began. Else the event's own time.
  WorldTime since;
  /// As in WorldContact. For UnresolvedFrom and UnresolvedTo the points are zero; the links may be
  /// kEveryLink, and b may be kEveryBody: a body that is silent, and taken to be Undecided.
  ContactSide a, b;
  /// An object of the mesh, or of the static scene, each by itself. -1 if there is none.
  ObjectId object = -1;
  double separation = 0.0;   ///< As WorldContact::separation.
  double penetration = 0.0;  ///< As WorldContact::penetration.
  /// Unit, from b to a; zero if there is none.
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::Zero();
  /// The velocity of a's material point at its witness point less that of b's: m/s.
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();
  /// Along the normal, above zero while the two approach: m/s.
  double approachSpeed = 0.0;
  /// If these two points touch, in the rest of the motion that is known between two poses, they do
  /// so at a speed between these along this normal. A lower one below zero: a graze, perhaps.
  double approachLower = 0.0, approachUpper = 0.0;
  /// The mass that meets the other along the normal (kg), of bodies whose mass the follower knows;
  /// infinite if neither has one.
  double effectiveMass = 0.0;
  /// Among the pairs of these two sides within the tolerance (for Leave: twice that): the nearest
  /// first, then as ContactDetails::points. In an order that does not depend on how triangles are
  /// numbered.
  std::array<EventPoint, kMostPoints> points;
  std::size_t numPoints = 0;
};

/// Earlier events first; at equal times by kind, then by a's body and link, by b's, and by object.
[[nodiscard]] bool comesBefore(const WorldEvent& x, const WorldEvent& y);

enum class PartKind : std::uint8_t { Contact, Unresolved };

/// What two do in a part of the time that was asked. Everything else, between the parts of one
/// pair, is free: their separation is above zero throughout, rounding included.
/// Contact: their separation is at most twice the tolerance throughout, and at most the tolerance
/// at its begin unless it began before. Every touch of the two is in a part.
struct WorldPart {
  PartKind kind = PartKind::Contact;
  UndecidedReason reason = UndecidedReason::None;  ///< For Unresolved.
  bool isAssumed = false;    ///< Some of it, since it began, rests on a motion that is assumed.
  bool beganBefore = false;  ///< It goes on from before the time that was asked.
  bool goesOn = false;       ///< Its end is that of the time that was asked.
  ContactSide a, b;          ///< As where it began.
  ObjectId object = -1;      ///< As WorldEvent::object.
  WorldTime from, to;        ///< Closed: both belong to it.
  WorldTime since;           ///< When it began: at `from` or before.
};

/// A contact, or something unresolved, that has not ended.
struct OpenPart {
  PartKind kind = PartKind::Contact;
  UndecidedReason reason = UndecidedReason::None;  ///< For Unresolved.
  bool isAssumed = false;                          ///< As WorldPart::isAssumed, until now.
  ContactSide a, b;                                ///< As where it began.
  ObjectId object = -1;                            ///< As WorldEvent::object.
  WorldTime since;
};

struct EventCounters {
  std::uint64_t windows = 0;       ///< Windows asked of World::contacts().
  std::uint64_t contacts = 0;      ///< Intervals of contact that began.
  std::uint64_t stretches = 0;     ///< Parts of contacts: each in a span between poses of the two.
  std::uint64_t contactLooks = 0;  ///< Instants at which a contact was followed on.
  std::uint64_t freeLooks = 0;  ///< Instants at which two that had touched were looked for again.
  std::uint64_t pairs = 0;      ///< Distances of an LSS and another, or a triangle, for all these.

  void add(const EventCounters& more);
};

/// What happened from one call of WorldFollower::follow() to the next.
struct WorldEvents {
  std::int64_t fromUs = 0, toUs = 0;  ///< Followed in this call.
  std::vector<WorldEvent> events;     ///< By comesBefore().
  std::vector<WorldPart> parts;       ///< By pair, then by time.
  std::vector<SilentBody> silent;     ///< As WorldContacts::silent, at the end of the time.
  WorldCounters world;                ///< What the questions for first contacts took.
  EventCounters counters;             ///< What events took on top.
};

}  // namespace foretouch
