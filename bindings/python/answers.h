// bindings/python/answers.h: the answers of queries, as Python sees them. Arrays are views of the
// library's own contacts, which they keep alive; nothing is copied.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::python {

/// The contacts of one step or of many, immutable.
struct Answers {
  std::shared_ptr<const Avatar> avatar;  ///< For names.
  std::shared_ptr<const Scene> scene;
  std::vector<LinkContact> contacts;               ///< Step after step, every link of it in order.
  std::vector<QueryCounters> counters;             ///< One per step.
  bool asksSelf = false;                           ///< Own links were asked, too.
  std::vector<foretouch::PairContact> pairs = {};  ///< Of own links, step after step.
  std::vector<std::size_t> pairsEnd = {};          ///< One per step: where its pairs end.

  /// Appends the answer to one step.
  void add(StepContacts&& step);

  [[nodiscard]] std::size_t links() const { return countOf(avatar->numLinks()); }
};
using SharedAnswers = std::shared_ptr<const Answers>;

/// One step's part of them.
struct Step {
  SharedAnswers answers;
  std::size_t step = 0;
};

/// All of them.
struct Steps {
  SharedAnswers answers;
};

/// One link's part of a step.
struct Contact {
  SharedAnswers answers;
  std::size_t place = 0;  ///< In Answers::contacts, or in Answers::pairs.
  bool isOfPair = false;
};
/// Two own links' part of a step.
struct PairContact : Contact {};
/// Readable text, in angle brackets.
[[nodiscard]] std::string textOf(const Contact& contact);

}  // namespace foretouch::python
