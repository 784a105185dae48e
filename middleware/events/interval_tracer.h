// middleware/events/interval_tracer.h: cuts a step into the parts in which two sides are free, in
// contact, or unresolved. Proof: events.md 1. Not installed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "middleware/events/moving_sides.h"
#include "middleware/events/world_event.h"

namespace foretouch::internal {

/// What is known of the two where tracing begins.
enum class TraceStart : std::uint8_t {
  Free,     ///< They were free before.
  Contact,  ///< They were in contact before.
  Unknown,  ///< Nothing.
};

/// A part of a step in which the two are not free.
struct StepPart {
  PartKind kind = PartKind::Contact;
  double from = 0.0, to = 1.0;
  bool goesOn =
      false;  ///< To the step's end; else they are free, or it is known again, from `to` on.
  UndecidedReason reason = UndecidedReason::None;  ///< For Unresolved.
};

/// The distances that decide (m). The motion's own error is taken off (world.md 2).
struct IntervalTolerance {
  double enter, leave, limit, floor;

  /// `off`: no point is farther from its true place.
  [[nodiscard]] static IntervalTolerance of(double tolerance, double off);
};

/// For one thread; keeps its memory.
class IntervalTracer {
 public:
  /// Appends the parts of [from, 1] in which the two are not free, in order.
  /// - Contact: they stay within `limit`, and are within `enter` at its begin, unless that is
  ///   `from` and they were in contact before.
  /// - Unresolved: doubles cannot tell, or the sides' work is spent; goes on to the step's end.
  /// - Elsewhere they stay `floor` apart.
  /// `witness`: the pair that held the two together last, if one did; it is tried first.
  void trace(MovingSides& sides, const IntervalTolerance& tolerance, double from, TraceStart start,
             SidesPair& witness, std::vector<StepPart>& parts, EventCounters& counters);

  /// Where a search ends.
  enum class Found : std::uint8_t { Nothing, Contact, Unresolved };
  struct Search {
    Found found = Found::Nothing;
    double t = 1.0;
  };
  /// In [from, to]: the first instant at which a pair is within `enter`. Before it, or to the end,
  /// all are proven more than `floor` apart. `witness` becomes the pair. It looks at `firstSpan` of
  /// the motion first, and at ever more of it.
  [[nodiscard]] Search search(MovingSides& sides, const IntervalTolerance& tolerance, double from,
                              double to, double firstSpan, SidesPair& witness,
                              EventCounters& counters);

 private:
  void leaveUnresolved(double from, std::vector<StepPart>& parts) const;
  void traceParts(double from, TraceStart start, std::vector<StepPart>& parts,
                  EventCounters& counters);
  /// What holds the two together at an instant.
  struct Hold {
    bool isContact = false;  // they are within what was asked
    double step = 0.0;       // for how long they are proven to stay within the limit
  };

  [[nodiscard]] bool isWithin(double t, double within);
  [[nodiscard]] Hold holdAt(double t, double within);
  [[nodiscard]] bool tryHold(const SidesPair& pair, double t, double within, Hold& best);
  /// Goes from an instant of contact to where it ends; false: from there on that is not resolved.
  [[nodiscard]] bool followContact(double& t, EventCounters& counters);
  [[nodiscard]] Search searchContact(double from, double to, double firstSpan,
                                     EventCounters& counters);
  [[nodiscard]] double cutPiece(double begin, double end);
  [[nodiscard]] Search searchPiece(double from, double to, EventCounters& counters);

  MovingSides* sides_ = nullptr;
  IntervalTolerance tolerance_{};
  SidesPair last_;  // the pair that held longest
  std::vector<SidesPair> near_, fewer_;
  struct Candidate {
    double freeUntil;
    SidesPair pair;
  };
  std::vector<Candidate> heap_;
};

}  // namespace foretouch::internal
