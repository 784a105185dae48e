// bindings/python/contact_details.cpp: Contact.details().
#include <algorithm>

#include "bindings/python/answers.h"
#include "bindings/python/arguments.h"
#include "bindings/python/poses.h"
#include "middleware/query/query.h"

namespace foretouch::python {
namespace {

py::object noneBelowZero(std::int32_t index) {
  if (index < 0) return py::none();
  return py::int_(index);
}

py::object toPython(const ContactPoint& point) {
  return pythonType("ContactPoint")(
      Numbers(3, point.p_WOther.data()), Numbers(3, point.p_WLink.data()), point.separation,
      noneBelowZero(point.triangle), noneBelowZero(point.lss), noneBelowZero(point.linkTriangle));
}

py::object toPython(const ContactDetails& details) {
  py::list points;
  for (std::size_t i = 0; i < details.numPoints; ++i) points.append(toPython(details.points[i]));
  return pythonType("ContactDetails")(Numbers(3, details.v_WOther.data()),
                                      Numbers(3, details.v_WLink.data()), details.approachSpeed,
                                      details.approachLower, details.approachUpper, points);
}

std::size_t stepOf(const Contact& contact) {
  const Answers& answers = *contact.answers;
  if (contact.list == ContactList::Links) return contact.place / answers.links();
  const auto& end = contact.isOfPair() ? answers.pairsEnd : answers.perObjectEnd;
  return countOf(std::upper_bound(end.begin(), end.end(), contact.place) - end.begin());
}

/// Releases the GIL while it works.
ContactDetails askedAgain(const Contact& contact) {
  const py::gil_scoped_release free;
  const Answers& answers = *contact.answers;
  const std::size_t step = stepOf(contact);
  const ChainMotion motion(answers.avatar->skeleton(), answers.motions.start(step),
                           answers.motions.end(step));
  Scratch scratch;
  if (contact.isOfPair()) {
    return answers.question.details(motion, answers.pairs[contact.place], scratch);
  }
  return answers.question.details(motion, contactOf(contact), scratch);
}

}  // namespace

py::object detailsOf(const Contact& contact) {
  if (!isTouching(contactOf(contact))) return py::none();
  return toPython(askedAgain(contact));
}

}  // namespace foretouch::python
