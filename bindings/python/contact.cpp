// bindings/python/contact.cpp: foretouch.Contact and Verdict.
#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

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

py::object verdictOf(const LinkContact& contact) {
  return memberOf(verdictType, contact.verdict);
}

const foretouch::PairContact& pairOf(const PairContact& contact) {
  return contact.answers->pairs[contact.place];
}

/// A property that only a contact has; None for clear or undecided links.
template <typename Read>
auto ofTouch(const Read& read) {
  return [read](const Contact& contact) -> py::object {
    const LinkContact& c = contactOf(contact);
    if (!isTouching(c)) return py::none();
    auto value = read(contact, c);
    if constexpr (std::is_base_of_v<py::object, decltype(value)>) {
      return value;
    } else {
      return py::cast(value);
    }
  };
}

auto pointOf(Vector3d LinkContact::*field) {
  return ofTouch(
      [field](const Contact&, const LinkContact& c) { return Numbers(3, (c.*field).data()); });
}

py::object featureOf(const Contact& contact, FeatureKind LinkContact::*field) {
  const LinkContact& c = contactOf(contact);
  if (c.linkTriangle < 0) return py::none();
  return py::str(toString(c.*field));
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
py::object objectOf(const Contact& contact, const LinkContact& c) {
  if (contact.isOfPair()) return py::none();
  return readable(metBy(contact, c));
}

py::object objectIdOf(const Contact& contact, const LinkContact& c) {
  if (contact.isOfPair()) return py::none();
  return py::int_(contact.answers->scene->object(c.triangle));
}

py::object triangleOf(const Contact&, const LinkContact& c) {
  if (c.triangle < 0) return py::none();  // of a link's LSS
  return py::int_(c.triangle);
}

/// Triangles have no inside.
bool startsAtUnknownDepth(const LinkContact& contact) {
  return std::isnan(toldDepth(contact));
}

py::object penetrationOf(const Contact&, const LinkContact& c) {
  if (startsAtUnknownDepth(c)) return py::none();
  return py::float_(c.penetration);
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

py::str linkNameOf(const Contact& contact) {
  return nameOf(*contact.answers->avatar, contactOf(contact).link);
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
  const auto field = [](auto member) {
    return [member](const Contact& contact) { return contactOf(contact).*member; };
  };
  py::class_<Contact>(module, "Contact",
                      "What one link meets first in one step. What only a contact has is None\n"
                      "where the link is clear or undecided. Metres, world frame.")
      .def_property_readonly("link", &linkNameOf, "The link's name.")
      .def_property_readonly("link_id", field(&LinkContact::link))
      .def_property_readonly("verdict", [](const Contact& c) { return verdictOf(contactOf(c)); })
      .def_property_readonly(
          "reason",
          [](const Contact& contact) -> py::object {
            const LinkContact& c = contactOf(contact);
            if (c.reason == UndecidedReason::None) return py::none();
            return py::str(toString(c.reason));
          },
          "Why it is undecided: 'work-budget', 'resolution' or 'after-first'.")
      .def_property_readonly("toi",
                             ofTouch([](const Contact&, const LinkContact& c) { return c.toi; }),
                             "Time of impact in [0, 1], never late.")
      .def_property_readonly("free_until", field(&LinkContact::freeUntil),
                             "Nothing is touched before; 1 where the link is clear.")
      .def_property_readonly(
          "separation", ofTouch([](const Contact&, const LinkContact& c) { return c.separation; }),
          "At toi, at most the tolerance.")
      .def_property_readonly("penetration", ofTouch(&penetrationOf),
                             "How deep it starts; None if that is not known, as of triangles.")
      .def_property_readonly("point", pointOf(&LinkContact::p_WScene), "(3,), on the scene.")
      .def_property_readonly("on_link", pointOf(&LinkContact::p_WLink), "(3,), on the link.")
      .def_property_readonly("normal", pointOf(&LinkContact::nhat_SL_W),
                             "(3,), unit, from the scene to the link.")
      .def_property_readonly("triangle", ofTouch(&triangleOf))
      .def_property_readonly("object", ofTouch(&objectOf), "The name of the triangle's object.")
      .def_property_readonly("object_id", ofTouch(&objectIdOf))
      .def_property_readonly("lss",
                             ofTouch([](const Contact&, const LinkContact& c) { return c.lss; }),
                             "Which of the link's LSS.")
      .def_property_readonly(
          "link_triangle",
          [](const Contact& contact) -> py::object {
            const LinkContact& c = contactOf(contact);
            if (c.linkTriangle < 0) return py::none();
            return py::int_(c.linkTriangle);
          },
          "At exact fidelity: which of the link's triangles.")
      .def_property_readonly(
          "link_feature",
          [](const Contact& contact) { return featureOf(contact, &LinkContact::linkFeature); },
          "At exact fidelity: 'vertex', 'edge' or 'face'.")
      .def_property_readonly(
          "scene_feature",
          [](const Contact& contact) { return featureOf(contact, &LinkContact::sceneFeature); },
          "The same of the scene's triangle.")
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
