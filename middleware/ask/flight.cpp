#include "middleware/ask/ask.h"

namespace foretouch {

AskVerdict FlightAnswer::verdict() const {
  if (first) return AskVerdict::Hit;
  for (const UnknownBody& body : unknown) {
    if (body.why != AskUnknown::Assumed) return AskVerdict::Unknown;
  }
  return AskVerdict::Clear;
}

}  // namespace foretouch
