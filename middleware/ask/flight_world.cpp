#include <string>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/ask/ask.h"
#include "middleware/ask/ask_checks.h"
#include "middleware/ask/body_asker.h"
#include "middleware/ask/flight_asker.h"

namespace foretouch {
namespace {

using internal::WorldParts;

Result<Done> checked(const WorldParts& world, const FlightQuestion& question) {
  FORETOUCH_CHECK(internal::checkedShape(question.shape));
  FORETOUCH_CHECK(internal::checkedHull(question.hull, question.shape));
  if (!question.way.allFinite()) {
    return Error::in("way", ErrorCode::NonFinite, "expected finite numbers");
  }
  Lss there = question.shape;
  there.a += question.way;
  there.b += question.way;
  FORETOUCH_CHECK(inFile(internal::checkedShape(there), "way"));
  FORETOUCH_CHECK(internal::checkedHull(question.hull, there));
  FORETOUCH_CHECK(internal::checkedTime(world, {question.fromUs, 0.0}, "from_us"));
  FORETOUCH_CHECK(internal::checkedTime(world, {question.toUs, 0.0}, "to_us"));
  if (question.fromUs < question.toUs) return internal::checkedParts(world, question);
  return Error::in("to_us", ErrorCode::OutOfRange, "expected an end after the begin");
}

}  // namespace

Result<Done> askFlight(const World& world, const FlightQuestion& question, Scratch& scratch,
                       FlightAnswer& answer) {
  const WorldParts& parts = world.parts();
  answer.first.reset();
  answer.unknown.clear();
  FORETOUCH_CHECK(checked(parts, question));
  internal::AskMemory& memory = scratch.of<internal::AskMemory>();
  const internal::AskFilter filter(question);
  memory.bodies.useWorld(parts);
  internal::FlightAsker asker(parts, question, filter, memory, answer);
  if (parts.still && filter.mayTake(parts, kStillScene)) asker.askStill(*parts.still);
  for (BodyId body = 0; slotOf(body) < parts.bodies.size(); ++body) {
    if (filter.mayTake(parts, body)) asker.askBody(body);
  }
  return Done{};
}

}  // namespace foretouch
