// middleware/events/event_details.h: what an event reports of its instant: where the two meet, how
// fast, and how much mass meets. Not installed.
#pragma once

#include <vector>

#include "middleware/events/body_masses.h"
#include "middleware/events/moving_sides.h"
#include "middleware/events/span_sides.h"
#include "middleware/events/world_event.h"
#include "middleware/query/manifold.h"

namespace foretouch::internal {

/// For one thread; keeps its memory.
class EventDetails {
 public:
  /// Fills all of the event that is about its instant `t`, of the span and of those pairs that are
  /// within `within` (m) of each other then; its bodies, links and object are there already.
  /// Nothing where no pair is so near.
  void fill(SpanSides& span, MovingSides& sides, double t, double within, const BodyMasses& masses,
            WorldEvent& event);

 private:
  [[nodiscard]] bool findNearest(MovingSides& sides, double t, double within, ObjectId object);
  void tellPlaces(WorldEvent& event) const;
  void tellPoints(MovingSides& sides, double t, double within, WorldEvent& event);
  void toWorld(SpanSides& span, double t, WorldEvent& event) const;
  void tellSpeeds(SpanSides& span, double t, WorldEvent& event) const;
  void tellMass(SpanSides& span, double t, const BodyMasses& masses, WorldEvent& event);

  struct Nearest {
    SidesPair pair;
    MovingPair at;
  };
  Nearest nearest_;
  std::vector<SidesPair> near_;
  Manifold manifold_;
  ContactDetails details_;
  std::vector<LinkState> states_;
};

}  // namespace foretouch::internal
