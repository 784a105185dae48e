// middleware/contact_fields.h: the fields of a contact, in one list. Code that writes contacts as
// JSON takes their names and order from here, and the Python class its properties. Tests compare
// the C struct, that class's stub, the wire message, the page's decoder and the tables in docs.
#pragma once

#include <array>
#include <cstdint>
#include <variant>

#include <Eigen/Core>

#include "middleware/contact.h"

namespace foretouch {

/// For which contacts a format writes the field.
enum class ContactFieldUse : std::uint8_t {
  Every,
  Undecided,
  Touching,  ///< Contact and StartsInContact.
  StartsInContact,
  Exact,  ///< Touching, with a triangle of the link (linkTriangle is not -1).
  Never,  ///< Not in JSON and not on the wire.
};

using ContactMember = std::variant<std::int32_t LinkContact::*, double LinkContact::*,
                                   Eigen::Vector3d LinkContact::*, Verdict LinkContact::*,
                                   UndecidedReason LinkContact::*, FeatureKind LinkContact::*>;

struct ContactField {
  const char* name;  ///< In JSON and in Python; in the page's code as camelCase.
  const char* inC;   ///< In ft_contact.
  /// In contacts_t. For vectors, the part before _x, _y and _z; empty if it has no such field.
  const char* onWire;
  ContactMember member;
  ContactFieldUse use;
  const char* unit;     ///< "1" if it has none.
  const char* meaning;  ///< A sentence, which Python shows.
};

/// In the order of JSON. `object` is the name of the triangle's object in the scene.
inline constexpr std::array<ContactField, 16> kContactFields{{
    {"link", "link", "links", &LinkContact::link, ContactFieldUse::Every, "1",
     "The link that is told of."},
    {"verdict", "verdict", "verdicts", &LinkContact::verdict, ContactFieldUse::Every, "1",
     "What is known of its motion."},
    {"free_until", "free_until", "free_until", &LinkContact::freeUntil, ContactFieldUse::Undecided,
     "1", "Nothing is touched before this t; 1 where the link is clear."},
    {"reason", "reason", "reasons", &LinkContact::reason, ContactFieldUse::Undecided, "1",
     "Why it is undecided: 'work-budget', 'resolution' or 'after-first'."},
    {"toi", "toi", "", &LinkContact::toi, ContactFieldUse::Touching, "1",
     "Time of impact in [0, 1], never late."},
    {"separation", "separation", "separation", &LinkContact::separation, ContactFieldUse::Touching,
     "m", "At toi, at most the tolerance."},
    {"penetration", "penetration", "penetration", &LinkContact::penetration,
     ContactFieldUse::StartsInContact, "m", "How deep it starts; not known of triangles."},
    {"point", "point_scene", "point", &LinkContact::p_WScene, ContactFieldUse::Touching, "m",
     "Witness point on the scene, in the world."},
    {"on_link", "point_link", "on_link", &LinkContact::p_WLink, ContactFieldUse::Touching, "m",
     "Witness point on the link's surface, in the world."},
    {"normal", "normal", "normal", &LinkContact::nhat_SL_W, ContactFieldUse::Touching, "1",
     "Unit, from the scene to the link, in the world."},
    {"triangle", "triangle", "triangles", &LinkContact::triangle, ContactFieldUse::Touching, "1",
     "Of the scene."},
    {"object", "object", "objects", &LinkContact::triangle, ContactFieldUse::Touching, "1",
     "The triangle's object."},
    {"lss", "lss", "", &LinkContact::lss, ContactFieldUse::Never, "1", "Which of the link's LSS."},
    {"link_triangle", "link_triangle", "link_triangles", &LinkContact::linkTriangle,
     ContactFieldUse::Exact, "1", "At exact fidelity: which of the link's triangles."},
    {"link_feature", "link_feature", "link_features", &LinkContact::linkFeature,
     ContactFieldUse::Exact, "1", "At exact fidelity: 'vertex', 'edge' or 'face'."},
    {"scene_feature", "scene_feature", "scene_features", &LinkContact::sceneFeature,
     ContactFieldUse::Exact, "1", "The same of the scene's triangle."},
}};

/// Whether a format writes a field of this use for `contact`.
[[nodiscard]] constexpr bool isTold(ContactFieldUse use, const LinkContact& contact) {
  const bool isUndecided = contact.verdict == Verdict::Undecided;
  const bool isTouching = !isUndecided && contact.verdict != Verdict::Clear;
  switch (use) {
    case ContactFieldUse::Every: return true;
    case ContactFieldUse::Undecided: return isUndecided;
    case ContactFieldUse::Touching: return isTouching;
    case ContactFieldUse::StartsInContact: return contact.verdict == Verdict::StartsInContact;
    case ContactFieldUse::Exact: return isTouching && contact.linkTriangle >= 0;
    case ContactFieldUse::Never: return false;
  }
  return false;
}

}  // namespace foretouch
