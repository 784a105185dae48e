#include <algorithm>
#include <cmath>
#include <string>

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
  FORETOUCH_CHECK(checkedWay(question));
  FORETOUCH_CHECK(internal::checkedTime(world, question.time, "time"));
  for (const AskInstant& instant : question.instants) {
    FORETOUCH_CHECK(internal::checkedTime(world, instant.time, "instants"));
    FORETOUCH_CHECK(internal::checkedBody(world, instant.body, "instants"));
  }
  return checkedParts(world, question);
}

internal::AskedShape shapeOf(const WorldQuestion& question) {
  internal::AskedShape shape;
  shape.lss = question.shape;
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

}  // namespace

Result<Done> askWorld(const World& world, const WorldQuestion& question, Scratch& scratch,
                      WorldAnswer& answer) {
  const WorldParts& parts = world.parts();
  answer.hits.clear();
  answer.unknown.clear();
  FORETOUCH_CHECK(checked(parts, question));
  AskMemory& memory = scratch.of<AskMemory>();
  const AskFilter filter(question);
  const internal::AskedShape shape = shapeOf(question);
  internal::HitList hits(shape.reach, question.which, answer);
  internal::BodyAsker asker(parts, filter, shape, memory, hits);
  if (parts.still && filter.mayTake(parts, kStillScene)) asker.askStill(*parts.still);
  memory.bodies.bring(parts, question);
  asker.askBodies();
  hits.finish();
  for (const BodyId body : memory.bodies.others()) {
    if (!filter.mayTake(parts, body)) continue;
    answer.unknown.push_back({body, unknownOf(memory.bodies.known(body))});
  }
  return Done{};
}

}  // namespace foretouch
