// middleware/events/bodies_tracer.h: follows two bodies through one window, from span to span, and
// reports what begins and ends. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "middleware/events/event_details.h"
#include "middleware/events/followed_bodies.h"
#include "middleware/events/interval_tracer.h"
#include "middleware/events/pair_key.h"
#include "middleware/events/span_sides.h"
#include "middleware/events/world_event.h"

namespace foretouch::internal {

struct TraceWindow {
  std::int64_t fromUs = 0, toUs = 0;
  bool isFirst = false;            ///< Nothing is known of what was before.
  GroupsAsked askedBefore;         ///< Of others nothing is known of what was before.
  std::vector<ListedPair> listed;  ///< By bodies, then by links.
  std::vector<BodyId> returned;    ///< Bodies that were unknown before: by number.
  /// Pairs given up before, and no longer now: in order. kStillScene stands for own links, too.
  std::vector<BodyPair> returnedPairs;
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
  /// Brings what is followed to the window's end, and appends what happens; where the work is
  /// spent, that nothing is known from there on. Errors: as
  /// SystemPlans::planOf().
  Result<Done> trace(const WorldParts& world, SystemPlans& plans, const BodyMasses& masses,
                     const TraceWindow& window, const TracedBodies& bodies, TraceAnswer& answer);
  /// Forgets what belongs to a world.
  void clear() {
    span_.system.motions.clear();
    spanBefore_.system.motions.clear();
  }

 private:
  struct Asked;
  /// The span that it is at: part of the window, and of a motion that may go beyond it.
  struct Part {
    std::int64_t beginUs = 0, endUs = 0;
    bool isFresh = false;    ///< What touches at its begin may have begun before it was looked at.
    bool isAssumed = false;  ///< A body is silent and taken to hold still.
    bool isChanged = false;  ///< At its begin a body changes its carrier, or appears.
  };

  Result<Done> traceSpans(const Asked& asked, SpanSides& span);
  void enterMotion(const Asked& asked, const SystemSpans& spans);
  Result<bool> traceSpan(const Asked& asked, SpanSides& span);
  [[nodiscard]] bool isNew(const Asked& asked, const ListedPair& listed) const;
  [[nodiscard]] bool isAnyNew(const Asked& asked) const;
  void addListed(const Asked& asked, SpanSides& span);
  void addObjects(const Asked& asked, SpanSides& span, const LinkPair& links,
                  const WorldTime& from);
  static void add(const Asked& asked, const LinkPair& links, ObjectId object,
                  const WorldTime& from);
  [[nodiscard]] bool set(const Asked& asked, SpanSides& span, const FollowedSides& side);
  void traceSides(const Asked& asked, SpanSides& span, FollowedSides& side);
  [[nodiscard]] bool isNear(double t, double within);
  [[nodiscard]] IntervalTolerance toleranceOf(const Asked& asked, const SpanSides& span) const;
  [[nodiscard]] bool isDue(const Asked& asked, const WorldTime& time, bool isEnd) const;
  [[nodiscard]] WorldTime beginAt(SpanSides& span, const StepPart& part) const;
  void tellParts(const Asked& asked, SpanSides& span, FollowedSides& side);
  [[nodiscard]] bool tellContact(const Asked& asked, SpanSides& span, FollowedSides& side);
  void tellDetails(const Asked& asked, SpanSides& span, const FollowedSides& side, double t,
                   double within);
  void tellLast(const Asked& asked, const FollowedSides& side, std::int64_t utimeUs);
  void endOpen(const Asked& asked, FollowedSides& side, std::int64_t utimeUs, LeaveCause cause);
  void endAll(const Asked& asked, std::int64_t utimeUs);
  void loseAll(const Asked& asked, std::int64_t utimeUs, UndecidedReason reason);
  void begin(const Asked& asked, EventKind kind, const WorldTime& time, UndecidedReason reason,
             FollowedSides& side);
  void end(const Asked& asked, EventKind kind, const WorldTime& time, FollowedSides& side);
  void tell(const Asked& asked, EventKind kind, const WorldTime& time, const FollowedSides& side);
  [[nodiscard]] static bool isFresh(const Asked& asked, const SystemSpans& spans);
  [[nodiscard]] static bool isChanged(const SystemSpans& spans);

  SpanScratch span_, spanBefore_;
  MovingSides sides_, sidesBefore_;
  IntervalTracer tracer_;
  EventDetails details_;
  std::vector<SidesPair> near_;
  Part part_;
};

}  // namespace foretouch::internal
