// middleware/events/bodies_tracer.h: follows pairs of links of two bodies through one window, from
// span to span, and tells what begins and ends. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "middleware/events/event_details.h"
#include "middleware/events/interval_tracer.h"
#include "middleware/events/pair_key.h"
#include "middleware/events/span_sides.h"
#include "middleware/events/world_event.h"

namespace foretouch::internal {

/// Two links that are not known to be free in the window.
struct TracedPair {
  LinkPair links;
  std::size_t firstOpen = 0, numOpen = 0;  ///< Of TraceWindow::open: those of the two.
  bool isListed = false;
  WorldTime listed;  ///< If they are: with whatever else they meet they are free before.
};
struct TracedBodies {
  BodyPair bodies;
  std::size_t first = 0, count = 0;  ///< Of TraceWindow::pairs.
};

struct TraceWindow {
  std::int64_t fromUs = 0, toUs = 0;
  bool isFirst = false;           ///< Nothing is known of what was before.
  std::vector<TracedPair> pairs;  ///< By body pair.
  std::vector<BodyId> returned;   ///< Were unknown before: by number.
  const std::vector<OpenPart>* open = nullptr;
};

/// A contact that goes on at the instant, after a motion that is assumed.
struct AssumedContact {
  PairKey pair;
  WorldTime time;
};

struct TraceAnswer {
  std::vector<WorldEvent> events;
  std::vector<AssumedContact> assumed;
  EventCounters counters;

  void clear() {
    events.clear();
    assumed.clear();
    counters = {};
  }
};

/// For one thread; keeps its memory.
class BodiesTracer {
 public:
  /// Appends what happens to the pairs. Errors: as SystemPlans::planOf().
  Result<Done> trace(const WorldParts& world, SystemPlans& plans, const BodyMasses& masses,
                     const TraceWindow& window, const TracedBodies& bodies, TraceAnswer& answer);
  /// Forgets what belongs to a world.
  void clear() { system_.motions.clear(); }

 private:
  /// Two that are followed.
  struct Following {
    std::size_t pair = 0;
    ObjectId object = kNoObject;
    WorldTime from;  ///< Free before it, if nothing is open.
    bool isOpen = false;
    PartKind kind = PartKind::Contact;
    UndecidedReason reason = UndecidedReason::None;
    WorldTime since;
  };
  struct Asked;

  Result<Done> traceSpans(const Asked& asked, SpanSides& span);
  void beginFollowing(const Asked& asked);
  void traceSpan(const Asked& asked, SpanSides& span);
  void tracePair(const Asked& asked, SpanSides& span, std::size_t pair);
  void addObjects(const Asked& asked, SpanSides& span, std::size_t pair);
  void traceOne(const Asked& asked, SpanSides& span, Following& followed);
  void takeParts(const Asked& asked, SpanSides& span, bool wasUnknown, Following& followed);
  void endOpen(const Asked& asked, std::size_t pair, const WorldTime& time, LeaveCause cause);
  void loseOpen(const Asked& asked, const WorldTime& time, UndecidedReason reason);
  void begin(const Asked& asked, EventKind kind, const WorldTime& time, UndecidedReason reason,
             Following& followed);
  void end(const Asked& asked, EventKind kind, const WorldTime& time, Following& followed);
  WorldEvent& tell(const Asked& asked, EventKind kind, const WorldTime& time,
                   const Following& followed);
  [[nodiscard]] static bool isFresh(const TraceWindow& window, const SystemSpans& spans);

  SystemScratch system_;
  MovingSides sides_;
  IntervalTracer tracer_;
  EventDetails details_;
  std::vector<Following> following_;
  std::vector<StepPart> parts_;
  std::vector<SidesPair> near_;
  bool isAssumed_ = false, isFresh_ = false;
};

}  // namespace foretouch::internal
