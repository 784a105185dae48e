// tests/support/asked.h: questions asked once, with scratch memory that goes from one to the next.
#pragma once

#include "middleware/query/query.h"
#include "tests/reference/reference_query.h"

namespace foretouch::test {

/// Precondition: options that Query::build() takes.
inline StepContacts answerOf(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
                             const QueryOptions& options, Scratch& scratch) {
  return Query::build(avatar, scene, options).value().answer(motion, scratch);
}
/// The same in other ways. Precondition: options that buildReference() takes.
inline StepContacts answerOf(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
                             const QueryOptions& options, const ReferenceOptions& reference,
                             Scratch& scratch) {
  return buildReference(avatar, scene, options, reference).value().answer(motion, scratch);
}
inline bool touchesAt(const Avatar& avatar, const ChainMotion& motion, LinkId link, double t,
                      const Scene& scene, const QueryOptions& options, Scratch& scratch) {
  return Query::build(avatar, scene, options).value().touchesAt(motion, link, t, scratch);
}

}  // namespace foretouch::test
