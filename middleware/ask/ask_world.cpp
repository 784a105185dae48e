#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/ask/ask.h"
#include "middleware/ask/ask_checks.h"
#include "middleware/ask/body_asker.h"

namespace foretouch {
namespace {

using internal::AskFilter;
using internal::AskMemory;
using internal::WorldParts;

Result<Done> checkedWay(const WorldQuestion& question) {
  if (!question.direction.allFinite()) {
    return Error::in("direction", ErrorCode::NonFinite, "expected finite numbers");
  }
  if (question.what == AskWhat::Cast && question.direction.isZero(0.0)) {
    return Error::in("direction", ErrorCode::OutOfRange,
                     "expected a direction to cast along, found zero");
  }
  if (question.what == AskWhat::Overlap) return Done{};
  if (!std::isfinite(question.reach)) {
    return Error::in("reach", ErrorCode::NonFinite, "expected a finite reach, up to 1e8 m");
  }
  const bool isLong = question.what == AskWhat::Cast ? question.reach > 0.0 : question.reach >= 0.0;
  if (isLong && question.reach <= kMostAskReach) return Done{};
  return Error::in("reach", ErrorCode::OutOfRange,
                   question.what == AskWhat::Cast ? "expected a reach above 0, up to 1e8 m"
                                                  : "expected a reach from 0 to 1e8 m");
}

Result<Done> checked(const WorldParts& world, const WorldQuestion& question) {
  FORETOUCH_CHECK(internal::checkedShape(question.shape));
  FORETOUCH_CHECK(internal::checkedHull(question.hull, question.shape));
  FORETOUCH_CHECK(checkedWay(question));
  FORETOUCH_CHECK(internal::checkedTime(world, question.time, "time"));
  for (const AskInstant& instant : question.instants) {
    FORETOUCH_CHECK(internal::checkedTime(world, instant.time, "instants"));
    FORETOUCH_CHECK(internal::checkedBody(world, instant.body, "instants"));
  }
  return checkedParts(world, question);
}

internal::AskedShape shapeOf(const WorldQuestion& question, AskMemory& memory) {
  internal::AskedShape shape;
  shape.lss = question.shape;
  shape.takeHull(question.hull, memory.hull);
  if (question.what != AskWhat::Overlap) shape.reach = question.reach;
  if (question.what != AskWhat::Cast) return shape;
  // By its largest part first, so that no square leaves the range of doubles.
  shape.way = question.direction / question.direction.cwiseAbs().maxCoeff();
  shape.way.normalize();
  return shape;
}

AskUnknown unknownOf(internal::PlaceKnown known) {
  if (known == internal::PlaceKnown::Assumed) return AskUnknown::Assumed;
  return known == internal::PlaceKnown::Silent ? AskUnknown::Silent : AskUnknown::NotThere;
}

/// Those at the same instants one after the other.
std::vector<std::size_t> inOrderOfInstants(const std::vector<WorldQuestion>& questions) {
  std::vector<std::size_t> order(questions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto isBefore = [](const AskInstant& x, const AskInstant& y) {
    return x.body != y.body ? x.body < y.body : x.time < y.time;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const WorldQuestion &x = questions[i], &y = questions[j];
    if (x.time < y.time || y.time < x.time) return x.time < y.time;
    return std::lexicographical_compare(x.instants.begin(), x.instants.end(), y.instants.begin(),
                                        y.instants.end(), isBefore);
  });
  return order;
}

/// Several links of a body, or it and one of its objects, may be unknown.
void sortUnique(std::vector<UnknownBody>& unknown) {
  const auto key = [](const UnknownBody& x) { return std::make_tuple(x.body, x.why, x.object); };
  std::sort(unknown.begin(), unknown.end(),
            [&](const UnknownBody& x, const UnknownBody& y) { return key(x) < key(y); });
  const auto isSame = [&](const UnknownBody& x, const UnknownBody& y) { return key(x) == key(y); };
  unknown.erase(std::unique(unknown.begin(), unknown.end(), isSame), unknown.end());
}

}  // namespace

Result<Done> askWorld(const World& world, const WorldQuestion& question, Scratch& scratch,
                      WorldAnswer& answer) {
  const WorldParts& parts = world.parts();
  answer.hits.clear();
  answer.unknown.clear();
  FORETOUCH_CHECK(checked(parts, question));
  AskMemory& memory = scratch.of<AskMemory>();
  const AskFilter filter(question);
  const internal::AskedShape shape = shapeOf(question, memory);
  internal::HitList hits(shape.reach, question.which, answer);
  std::vector<UnknownBody>& unknown = answer.unknown;
  internal::BodyAsker asker(parts, filter, shape, memory, hits,
                            question.solids ? &unknown : nullptr);
  if (parts.still && filter.mayTake(parts, kStillScene)) asker.askStill(*parts.still);
  memory.bodies.bring(parts, question);
  asker.askBodies();
  hits.finish();
  for (const BodyId body : memory.bodies.others()) {
    if (!filter.mayTake(parts, body)) continue;
    unknown.push_back({body, unknownOf(memory.bodies.known(body)), kEveryObject});
  }
  if (question.solids) sortUnique(unknown);
  return Done{};
}

Result<Done> askWorld(const World& world, const std::vector<WorldQuestion>& questions,
                      Scratch& scratch, std::vector<WorldAnswer>& answers) {
  const std::vector<std::size_t> order = inOrderOfInstants(questions);
  answers.resize(questions.size());
  for (const std::size_t i : order) {
    const auto done = askWorld(world, questions[i], scratch, answers[i]);
    if (done.ok()) continue;
    Error error = done.error();
    error.message = "question " + std::to_string(i) + ": " + error.message;
    error.index = static_cast<std::int64_t>(i);
    return error;
  }
  return Done{};
}

}  // namespace foretouch
