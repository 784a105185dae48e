// middleware/world/body_sweep.h: where each body is in a window, span by span: float boxes around
// all that it sweeps, as a whole and per LSS, and the ends of its LSS at eight instants. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/pair/lane_scratch.h"
#include "middleware/world/box_sweep.h"
#include "middleware/world/system_plan.h"
#include "middleware/world/world_contacts.h"
#include "tessellation/lss_table.h"
#include "tessellation/node_ends.h"

namespace foretouch::internal {

/// What a body does in one span of world time, and what it meets there by itself. A window may use
/// only part of it. Keeps its memory.
struct SpanSweep {
  std::int64_t beginUs = 0, endUs = 0;
  std::int64_t episodeUs = 0;                        ///< When the body's episode began.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< In W: the boxes', and the ends' own.
  /// Around the whole body, and per LSS; grown by each side's share of the tolerance (world.md 3).
  BodyBox box;
  std::int32_t numLss = 0;
  std::array<std::vector<float>, 3> lower, upper;  ///< Empty boxes beyond the last LSS.
  NodeEnds ends;
  // Per LSS, rounded up. How its ends' paths bend in W (m per span squared), and what it takes away
  // from the distance of its axis: its radius, and all uncertainty (m).
  std::vector<float> bends, reaches;
  float turn = 0.0F;           ///< The most the first LSS' link turns in W (radians). No bound.
  float widestSagitta = 0.0F;  ///< h^2/8 of the longest time between two nodes. Rounded up.
  /// First contacts with the static scene and of own links, over the whole span.
  std::vector<WorldContact> own;
  QueryCounters counters;                           ///< What all of this took.
  SystemQuestion question = SystemQuestion::Boxes;  ///< The one that `own` answers.
  bool isWhole = false;      ///< A piece of the body's track, whatever the window.
  std::uint64_t window = 0;  ///< The one that used it last.

  /// Fills it with what a slab has of the motion's whole [0,1], relative to `from` in W; takes the
  /// slab's ends. No place is off by more than `cut` because the span is part of a piece (m).
  void fill(const LssTable& table, const ChainMotion& motion, SlabScratch& slab,
            const Eigen::Vector3d& from, double cut);
  /// For ends of any body of so many LSS: spans and slabs exchange their memory.
  void makeRoom(std::size_t mostLss);
};

/// The part of a span that lies in the window.
struct SpanPart {
  std::int64_t beginUs, endUs;
  std::size_t sweep;  ///< Place in BodySweep::spans.
};

/// The sweep of one body.
struct BodySweep {
  BodyBox whole;         ///< Around all parts, relative to the window's origin.
  bool isRough = false;  ///< There is nothing else: the body is far from all that it may meet.
  std::vector<SpanPart> parts;
  /// The spans of the window and earlier ones: most windows begin where the last one ended, often
  /// within a span.
  std::vector<SpanSweep> spans;

  /// The sweep of the part that holds [utimeUs, utimeUs + 1). Precondition: there is one, not
  /// rough.
  [[nodiscard]] const SpanSweep& at(std::int64_t utimeUs) const;
  /// Place of what is known of a whole piece of an episode, with answers to the question; -1 if
  /// nothing is.
  [[nodiscard]] std::ptrdiff_t placeOf(std::int64_t episodeUs, std::int64_t beginUs,
                                       std::int64_t endUs, SystemQuestion question) const;
  /// Some span that is not of this window, for another one; ends references to others.
  [[nodiscard]] std::size_t freePlace(std::uint64_t window);
};

}  // namespace foretouch::internal
