#include "middleware/world/body_sweeper.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/work_meter.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/world/work_shares.h"

namespace foretouch::internal {
namespace {

/// A piece is looked at as a whole if it is not longer than so many windows. What is known of it
/// then serves all of them; a longer one sweeps so much more than the window needs that more would
/// be near.
constexpr std::int64_t kMostWindowsOfPiece = 4;
/// In so short a time (us) a body sweeps little: a window that is a small part of it, as those of a
/// live world are, looks at as much of a piece. Longer, and more is near; shorter, and people who
/// are tracked 30 times per second are looked at more than once per pose.
constexpr std::int64_t kShortUs = 40'000;
/// What a body sweeps costs so much per LSS, beside its question; as kSpanWork.
constexpr std::uint64_t kLssWork = 100;

PieceShare shareFor(const Window& window) {
  const std::int64_t windowsUs = kMostWindowsOfPiece * (window.toUs - window.fromUs);
  return {std::max(windowsUs, kShortUs), windowsUs <= kShortUs ? kShortUs : 0};
}

}  // namespace

Result<Done> BodySweeper::sweep(BodyId body, BodySweep& sweep, std::vector<WorldContact>& found,
                                WorldCounters& counters) {
  const SystemQuestion question = questionOf(body);
  const std::size_t first = found.size();
  sweep.whole = BodyBox();
  sweep.parts.clear();
  SystemSpans& spans = scratch_.spans;
  spans.begin(world_, body, kStillScene, window_.fromUs, window_.toUs);
  while (spans.next()) {
    SpanPart part{spans.beginUs(), spans.endUs(), 0};
    const bool isWhole = spans.widen(shareFor(window_));
    // Part of a piece that was, before poses went, may have the same ends.
    const bool maybeKnown = isWhole && spans.endUs() >= world_.thinnedUs;
    const std::int64_t episodeUs = spans.members().front().episode->beginUs;
    const std::ptrdiff_t known =
        maybeKnown ? sweep.placeOf(episodeUs, spans.beginUs(), spans.endUs(), question) : -1;
    part.sweep = known >= 0 ? static_cast<std::size_t>(known) : sweep.freePlace(window_.number);
    SpanSweep& span = sweep.spans[part.sweep];
    if (known < 0) {
      span.makeRoom(world_.mostLss);
      span.isWhole = false;  // until it is filled
      FORETOUCH_CHECK(fill(body, question, span));
      counters.work +=
          kSpanWork + kLssWork * countOf(span.numLss) + WorkMeter::workOf(span.counters);
      span.isWhole = isWhole;
    }
    span.window = window_.number;
    sweep.parts.push_back(part);
    sweep.whole.add(span.box.movedBy(span.origin - window_.origin));
    FORETOUCH_CHECK(keepOwn(body, question, part, span, first, found, counters));
  }
  return Done{};
}

SystemQuestion BodySweeper::questionOf(BodyId body) const {
  if (world_.isStillAsked(body)) return SystemQuestion::Still;
  return world_.body(body).ownRules >= 0 ? SystemQuestion::Self : SystemQuestion::Boxes;
}

bool BodySweeper::sweepRoughly(BodyId body, BodySweep& sweep) {
  const BodyKind& kind = world_.kindOf(body);
  const SystemQuestion question = questionOf(body);
  if (kind.skeleton.numJoints() != 1 || question == SystemQuestion::Self) return false;
  sweep.whole = BodyBox();
  sweep.parts.clear();
  const double reach = kind.rho + 0.5 * world_.options.tolerance;
  SystemSpans& spans = scratch_.spans;
  spans.begin(world_, body, kStillScene, window_.fromUs, window_.toUs);
  while (spans.next()) {
    if (spans.members().size() != 1) return false;
    // Its origin goes straight from knot to knot, and no point of it is farther away than that.
    const TrackPiece& piece = spans.members().front().piece;
    if (question == SystemQuestion::Still && !isFarFromScene(piece, kind.rho)) return false;
    sweep.whole.add(boxAround(piece, reach));
  }
  return true;
}

/// Whether it stays farther than the tolerance from all that never moves.
bool BodySweeper::isFarFromScene(const TrackPiece& piece, double rho) const {
  Aabb box;
  box.add(piece.from->translations[0]);
  box.add(piece.to->translations[0]);
  // Between its ends its place is a sum of two products: it rounds by a few units of the largest.
  const double largest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  box.grow((rho + world_.options.tolerance + 8.0 * kUnitRoundoff * largest) * kInflation);
  std::uint64_t visited = 0;
  return !world_.still->parts().bvh.meetsLeaf(box, visited);
}

/// The box around both ends, relative to the window's origin, rounded outward.
BodyBox BodySweeper::boxAround(const TrackPiece& piece, double reach) const {
  const Eigen::Vector3d &from = piece.from->translations[0], &to = piece.to->translations[0];
  const double inflated = reach * kInflation;
  BodyBox box;
  for (int k = 0; k < 3; ++k) {
    const double least = std::min(from[k], to[k]), most = std::max(from[k], to[k]);
    const double origin = window_.origin[k];
    const double padded =
        inflated +
        8.0 * kUnitRoundoff * (std::max(std::abs(least), std::abs(most)) + std::abs(origin));
    box.lower[k] = -floatPaddedAbove(padded - (least - origin));
    box.upper[k] = floatPaddedAbove((most - origin) + padded);
  }
  return box;
}

/// Fills in the span that the scratch's spans are at.
Result<Done> BodySweeper::fill(BodyId body, SystemQuestion question, SpanSweep& span) {
  span.beginUs = scratch_.spans.beginUs();
  span.endUs = scratch_.spans.endUs();
  span.episodeUs = scratch_.spans.members().front().episode->beginUs;
  span.question = question;
  span.own.clear();
  span.counters = {};
  FORETOUCH_TRY(const SystemPlan* const plan, query_.prepare(question, body, kStillScene));
  QueryMemory& parts = scratch_.query.of<QueryMemory>();
  const bool isAsked = question != SystemQuestion::Boxes && query_.isResolved();
  if (isAsked) {
    query_.ask(*plan, body, kStillScene, 0, span.own, span.counters);
  } else {
    if (question != SystemQuestion::Boxes) query_.giveUp(body, kStillScene, span.own);
    parts.beginStep(scratch_.motion);
  }
  // What the question has found out of the motion serves here as well.
  LaneScratch& lanes = parts.lanes;
  const Eigen::Vector3d origin =
      question == SystemQuestion::Still ? world_.still->parts().origin : Eigen::Vector3d::Zero();
  lanes.evaluateNodes(scratch_.motion, 0.0, 1.0, origin, span.counters);
  SlabScratch& slab = lanes.slab();
  const bool hasEnds = isAsked && slab.areBoxesOfNodes && world_.body(body).ownRules >= 0;
  if (!hasEnds) {
    // Each side's share of the distance within which two meet (world.md 3).
    const double margin = 0.5 * world_.options.tolerance + scratch_.poses.rounding;
    sweptBoxes(plan->table, scratch_.motion, slab.nodes, margin, slab.boxes, &slab.ends);
  }
  span.fill(plan->table, scratch_.motion, slab, scratch_.origin, scratch_.poses.rounding);
  return Done{};
}

/// Keeps what the span's answers say of its part in the window. What met before that part begins is
/// asked again, from there on.
Result<Done> BodySweeper::keepOwn(BodyId body, SystemQuestion question, const SpanPart& part,
                                  const SpanSweep& span, std::size_t first,
                                  std::vector<WorldContact>& found, WorldCounters& counters) {
  if (question == SystemQuestion::Boxes) return Done{};
  const bool isGivenUp =
      found.size() > first && found.back().a.body == body && found.back().a.link == kEveryLink;
  if (isGivenUp) return Done{};
  ++counters.spans;
  addCounters(span.counters, counters.queries);
  if (!span.own.empty() && span.own.front().a.link == kEveryLink) {
    scratch_.spans.narrow();
    query_.giveUp(body, kStillScene, found);
    return Done{};
  }
  const WorldTime begin{part.beginUs, 0.0}, end{part.endUs, 0.0};
  bool haveMet = false;
  for (const WorldContact& contact : span.own) {
    if (end < contact.time) continue;
    const bool isEarlier = contact.time < begin;
    haveMet = haveMet || isEarlier;
    if (!isEarlier) {
      keep(contact, first, found);
    } else if (window_.isFollowed) {
      WorldContact again = contact;
      again.time = begin;
      keep(again, first, found);
    }
  }
  if (!haveMet || window_.isFollowed) return Done{};
  const std::uint64_t before = WorkMeter::workOf(counters.queries);
  FORETOUCH_CHECK(askAgain(body, question, part, span, first, found, counters));
  counters.work += kSpanWork + WorkMeter::workOf(counters.queries) - before;
  return Done{};
}

/// Asks again about what met before the part begins.
Result<Done> BodySweeper::askAgain(BodyId body, SystemQuestion question, const SpanPart& part,
                                   const SpanSweep& span, std::size_t first,
                                   std::vector<WorldContact>& found, WorldCounters& counters) {
  const WorldTime begin{part.beginUs, 0.0}, end{part.endUs, 0.0};
  std::vector<WorldContact>&met = scratch_.met, &again = scratch_.again;
  met.clear();
  again.clear();
  std::copy_if(span.own.begin(), span.own.end(), std::back_inserter(met),
               [&](const WorldContact& contact) { return contact.time < begin; });
  if (question == SystemQuestion::Self) {
    // Asks about the motion in which they met, from that instant on.
    FORETOUCH_TRY(const SystemPlan* const whole, query_.prepare(question, body, kStillScene));
    if (query_.isResolved() &&
        query_.askAgainFrom(part.beginUs, *whole, body, met, 0, again, counters.queries)) {
      ++counters.spans;
      for (const WorldContact& contact : again) {
        if (!(end < contact.time)) keep(contact, first, found);
      }
      return Done{};
    }
  }
  scratch_.spans.narrow();
  FORETOUCH_TRY(const SystemPlan* const plan, query_.prepare(question, body, kStillScene));
  if (!query_.isResolved()) {
    query_.giveUp(body, kStillScene, found);
    return Done{};
  }
  ++counters.spans;
  if (question == SystemQuestion::Self) {
    query_.askAgain(*plan, body, met, first, found, counters.queries);
    return Done{};
  }
  query_.ask(*plan, body, kStillScene, 0, again, counters.queries);
  for (const WorldContact& contact : again) {
    const bool hadMet = std::any_of(met.begin(), met.end(), [&](const WorldContact& known) {
      return areSameLinks(known, contact);
    });
    if (hadMet) keep(contact, first, found);
  }
  return Done{};
}

}  // namespace foretouch::internal
