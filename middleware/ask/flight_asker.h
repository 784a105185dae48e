// middleware/ask/flight_asker.h: when a shape that flies first touches a piece that moves. Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/ask/ask.h"
#include "middleware/ask/ask_filter.h"
#include "middleware/ask/asked_shape.h"
#include "middleware/ask/body_asker.h"
#include "middleware/ask/moving_body.h"

namespace foretouch::internal {

struct FlightMeeting;

/// One flight, body by body. Refers to all that it is given.
class FlightAsker {
 public:
  FlightAsker(const WorldParts& world, const FlightQuestion& question, const AskFilter& filter,
              AskMemory& memory, FlightAnswer& answer);

  void askStill(const Scene& scene);
  void askBody(BodyId body);

 private:
  enum class Outcome : std::uint8_t { Free, Touch, Unresolved };
  /// Asks about the span that `moving_` is at; false: not all of it could be resolved.
  [[nodiscard]] bool askSpan(BodyId body);
  [[nodiscard]] bool askTriangles(const ContactSide& side, const LinkSurface& surface);
  [[nodiscard]] bool askPiece(const ContactSide& side, const Hull& hull_L, double radius);
  /// Looks from `us` after the span's begin on; `us` becomes when they touch.
  [[nodiscard]] Outcome touches(LinkId link, const Hull& hull_L, double radius, double& us,
                                FlightMeeting& meeting);
  [[nodiscard]] AskedShape shapeAt(double us) const;
  [[nodiscard]] double limitUs() const;
  [[nodiscard]] bool mayReach(const Aabb& box) const;

  const WorldParts& world_;
  const FlightQuestion& question_;
  const AskFilter& filter_;
  AskMemory& memory_;
  InstantBodies& boxes_;
  MovingBody& moving_;
  FlightAnswer& answer_;
  AskedShape begin_;
  double durationUs_;
  double bestUs_;                           // after the flight's begin
  double spanFromUs_ = 0.0, spanUs_ = 0.0;  // after the flight's begin; of its length
  bool isAssumed_ = false;
};

}  // namespace foretouch::internal
