// bindings/python/contact.cpp: foretouch.Contact and Verdict.
#include "middleware/contact.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <variant>

#include "bindings/python/answers.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/int_enum.h"
#include "middleware/events/told_depth.h"
#include "middleware/exact/feature.h"

namespace foretouch::python {
namespace {

using Eigen::Vector3d;

PyObject* verdictType = nullptr;  // borrowed from the module

const foretouch::PairContact& pairOf(const PairContact& contact) {
  return contact.answers->pairs[contact.place];
}

py::str linkNameOf(const Contact& contact) {
  return nameOf(*contact.answers->avatar, contactOf(contact).link);
}

/// What the link touches: an object of the scene, or another link.
const std::string& metBy(const Contact& contact, const LinkContact& c) {
  if (contact.isOfPair()) {
    const LinkId other = contact.answers->pairs[contact.place].other;
    return contact.answers->avatar->skeleton().name(other);
  }
  const Scene& scene = *contact.answers->scene;
  return scene.objectNames()[std::size_t(scene.object(c.triangle))];
}

/// None for another link.
py::object objectOf(const Contact& contact) {
  const LinkContact& c = contactOf(contact);
  if (!isTouching(c) || contact.isOfPair()) return py::none();
  return readable(metBy(contact, c));
}

py::object objectIdOf(const Contact& contact) {
  const LinkContact& c = contactOf(contact);
  if (!isTouching(c) || contact.isOfPair()) return py::none();
  return py::int_(contact.answers->scene->object(c.triangle));
}

/// Triangles have no inside.
bool startsAtUnknownDepth(const LinkContact& contact) {
  return std::isnan(toldDepth(contact));
}

py::object penetrationOf(const Contact& contact) {
  const LinkContact& c = contactOf(contact);
  if (!isTouching(c) || startsAtUnknownDepth(c)) return py::none();
  return py::float_(c.penetration);
}

// The value of a member whose type alone says its meaning; None for what only a contact has where
// the link is clear or undecided.

py::object valueOf(const LinkContact& c, std::int32_t LinkContact::*member) {
  if (!isTouching(c) || c.*member < 0) return py::none();
  return py::int_(c.*member);
}

py::object valueOf(const LinkContact& c, double LinkContact::*member) {
  if (member != &LinkContact::freeUntil && !isTouching(c)) return py::none();
  return py::float_(c.*member);
}

py::object valueOf(const LinkContact& c, Vector3d LinkContact::*member) {
  if (!isTouching(c)) return py::none();
  return Numbers(3, (c.*member).data());
}

py::object valueOf(const LinkContact& c, Verdict LinkContact::*member) {
  return memberOf(verdictType, c.*member);
}

py::object valueOf(const LinkContact& c, UndecidedReason LinkContact::*member) {
  if (c.*member == UndecidedReason::None) return py::none();
  return py::str(toString(c.*member));
}

py::object valueOf(const LinkContact& c, FeatureKind LinkContact::*member) {
  if (c.linkTriangle < 0) return py::none();
  return py::str(toString(c.*member));
}

/// A property of foretouch.Contact.
py::cpp_function readerOf(const ContactField& field) {
  const std::string_view name = field.name;
  if (name == "link") return &linkNameOf;
  if (name == "object") return &objectOf;
  if (name == "penetration") return &penetrationOf;
  return std::visit(
      [](auto member) -> py::cpp_function {
        return [member](const Contact& contact) { return valueOf(contactOf(contact), member); };
      },
      field.member);
}

/// Both links, where they are named.
std::string subjectOf(const Contact& contact, const LinkContact& c) {
  const std::string& link = contact.answers->avatar->skeleton().name(c.link);
  if (!contact.isOfPair()) return "<foretouch.Contact: " + link;
  const bool isTold = isTouching(c);
  return "<foretouch.PairContact: " + link + (isTold ? "" : " with " + metBy(contact, c));
}

/// ", triangle 7>" of the scene.
std::string endOf(const Contact& contact, const LinkContact& c) {
  return contact.isOfPair() ? ">" : ", triangle " + std::to_string(c.triangle) + ">";
}

}  // namespace

const LinkContact& contactOf(const Contact& contact) {
  switch (contact.list) {
    case ContactList::Pairs: return contact.answers->pairs[contact.place];
    case ContactList::Objects: return contact.answers->perObject[contact.place];
    case ContactList::Links: break;
  }
  return contact.answers->contacts[contact.place];
}

bool isTouching(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

std::string textOf(const Contact& contact) {
  const LinkContact& c = contactOf(contact);
  const std::string subject = subjectOf(contact, c);
  std::array<char, 96> numbers{};
  if (isTouching(c)) {
    const bool begins = c.verdict == Verdict::StartsInContact;
    if (startsAtUnknownDepth(c)) {
      std::snprintf(numbers.data(), numbers.size(), " at t=%.6g", c.toi);
    } else {
      std::snprintf(numbers.data(), numbers.size(), " at t=%.6g, %.3g mm %s", c.toi,
                    1e3 * (begins ? c.penetration : c.separation), begins ? "deep" : "apart");
    }
    return subject + (begins ? " starts in contact with " : " meets ") + metBy(contact, c) +
           numbers.data() + endOf(contact, c);
  }
  if (c.verdict == Verdict::Clear) return subject + " is clear>";
  std::snprintf(numbers.data(), numbers.size(), ", free until t=%.6g>", c.freeUntil);
  return subject + " is undecided (" + toString(c.reason) + ")" + numbers.data();
}

void bindContact(py::module_& module) {
  py::class_<Contact> type(
      module, "Contact",
      "What one link meets first in one step. What only a contact has is None\n"
      "where the link is clear or undecided. Metres, world frame.");
  for (const ContactField& field : kContactFields) {
    type.def_property_readonly(field.name, readerOf(field), field.meaning);
  }
  type.def_property_readonly("link_id", [](const Contact& c) { return contactOf(c).link; })
      .def_property_readonly("object_id", &objectIdOf)
      .def("details", &detailsOf,
           "ContactDetails: how fast the two sides approach, and where else they are near. It "
           "looks\n"
           "at the near pairs once more: not meant for every contact of every step.")
      .def("__repr__", &textOf);
}

void bindPairContact(py::module_& module) {
  py::class_<PairContact, Contact>(
      module, "PairContact",
      "What two own links do in one step: the other link takes the place of the scene. `point`\n"
      "is on it, `normal` points from it to `link`, `triangle` is of its mesh, and there is no\n"
      "object.")
      .def_property_readonly(
          "other",
          [](const PairContact& contact) {
            return nameOf(*contact.answers->avatar, pairOf(contact).other);
          },
          "The other link's name.")
      .def_property_readonly("other_id",
                             [](const PairContact& contact) { return pairOf(contact).other; })
      .def_property_readonly(
          "other_lss",
          [](const PairContact& contact) -> py::object {
            const foretouch::PairContact& pair = pairOf(contact);
            if (!isTouching(pair)) return py::none();
            return py::int_(pair.otherLss);
          },
          "Which of the other link's LSS.");
}

void bindVerdict(py::module_& module) {
  verdictType = addIntEnum(module, "Verdict", membersOf<Verdict>(4));
}

}  // namespace foretouch::python
