// bindings/python/answers.h: the answers of queries, as Python sees them. Arrays are views of the
// library's own contacts, which they keep alive; nothing is copied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "bindings/python/arguments.h"
#include "bindings/python/motion.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::python {

/// The contacts of one step or of many, immutable.
struct Answers {
  std::shared_ptr<const Avatar> avatar;  ///< For names.
  std::shared_ptr<const Scene> scene;
  foretouch::Query question;
  AnsweredMotions motions;
  std::vector<LinkContact> contacts = {};          ///< Step after step, every link of it in order.
  std::vector<QueryCounters> counters = {};        ///< One per step.
  std::vector<foretouch::PairContact> pairs = {};  ///< Pairs of own links, step after step.
  std::vector<std::size_t> pairsEnd = {};          ///< One per step: where its pairs end.
  std::vector<LinkContact> perObject = {};         ///< By object, step after step.
  std::vector<std::size_t> perObjectEnd = {};

  /// Appends the answer to one step.
  void add(StepContacts&& step);

  [[nodiscard]] std::size_t links() const { return countOf(avatar->numLinks()); }
  /// Own links were asked, too.
  [[nodiscard]] bool asksSelf() const { return question.options().self.has_value(); }
  [[nodiscard]] bool asksObjects() const { return question.options().scope == Scope::EveryObject; }
};
using SharedAnswers = std::shared_ptr<const Answers>;

/// One step's part of the answers.
struct Step {
  SharedAnswers answers;
  std::size_t step = 0;
};

/// All of the answers.
struct Steps {
  SharedAnswers answers;
};

/// Which of the answers' lists a contact is in.
enum class ContactList : std::uint8_t { Links, Pairs, Objects };

/// One link's part of a step.
struct Contact {
  SharedAnswers answers;
  std::size_t place = 0;  ///< In the list.
  ContactList list = ContactList::Links;

  [[nodiscard]] bool isOfPair() const { return list == ContactList::Pairs; }
};
/// Two own links' part of a step.
struct PairContact : Contact {};
[[nodiscard]] const LinkContact& contactOf(const Contact& contact);
/// It touches something.
[[nodiscard]] bool isTouching(const LinkContact& contact);
/// Query::details() of the contact as Python sees it; None where nothing is touched.
[[nodiscard]] py::object detailsOf(const Contact& contact);
/// Readable text, in angle brackets.
[[nodiscard]] std::string textOf(const Contact& contact);

}  // namespace foretouch::python
