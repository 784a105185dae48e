// middleware/solid/near_rows.h: rows from what is near, how far to look for it, and what each must
// keep. Where the constants come from: solid.md 7. Metres. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "middleware/near/near_features.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::internal {

/// How far a step may go, and what it is made of.
inline constexpr double kLeastTrust = 0.01, kMostTrust = 0.05, kTrustOfStep = 1.5;
/// Below this a step is not worth a motion: the avatar rests.
inline constexpr double kSettled = 2e-5;
/// A cost falls if it is below this share.
inline constexpr double kFalls = 1.0 - 1e-9;
/// How far to look beyond the skin: the free step, and what it may be off.
inline constexpr double kReachOfStep = 1.2, kReachMore = 3e-3, kReachMargin = 2e-3;
/// In the rest zone, from this share of the skin to the skin, rows forbid to approach, and push
/// nothing. Below it, they push back towards the second share.
inline constexpr double kRest = 0.3, kBackTo = 0.6, kBackShare = 0.5, kMostBack = 5e-3;
/// What a correction aims at (shares of the skin): at the bound itself, rounding would decide.
inline constexpr double kAimed = 0.35;
/// A step must leave rows that push this share of their gap, unless they stay in the rest zone.
inline constexpr double kKeptGap = 0.9;
/// Halves of a step that are tried.
inline constexpr int kHalvings = 4;
/// Work of an iteration without its features, of one feature, and of one step that is tried, in
/// evaluations in lanes.
inline constexpr std::uint64_t kIterationWork = 1000, kRowWork = 80, kTryWork = 1000;
/// So many cubes of the rows that a solution takes up are one evaluation: its factors.
inline constexpr std::uint64_t kCubesPerWork = 20;

/// How far to look around a link that a free step moves by `far`.
[[nodiscard]] inline double reachFor(double far, double trust, double skin) {
  return skin + std::min(trust, kReachOfStep * far + kReachMore) + kReachMargin;
}

/// Appends a row per feature that has a normal, without its bound.
inline void appendRows(const NearFeatures& near, std::vector<ContactRow>& rows) {
  for (const NearFeature& feature : near.features) {
    if (feature.nhat_SL_W.squaredNorm() == 0.0) continue;
    ContactRow row;
    row.link = feature.link;
    row.lss = feature.lss;
    row.triangle = feature.triangle;
    row.x = feature.p_WLink;
    row.y = feature.p_WScene;
    row.n = feature.nhat_SL_W;
    row.gap = feature.gap;
    row.isFace = feature.feature == FeatureKind::Face;
    row.along = feature.along;
    rows.push_back(row);
  }
}

/// What is reported of a row that pushes, but for how fast it slips.
[[nodiscard]] inline SolidContact contactOf(const ContactRow& row) {
  SolidContact contact;
  contact.link = row.link;
  contact.lss = row.lss;
  contact.triangle = row.triangle;
  contact.other = row.other;
  contact.p_W = row.y;
  contact.nhat_W = row.n;
  contact.gap = row.gap;
  contact.push = row.push;
  return contact;
}

/// What a step must keep of a row's gap to what rests.
[[nodiscard]] inline double boundOf(const ContactRow& row, double skin, bool mayPushBack) {
  if (row.isTurn) return -std::max(0.0, row.gap);
  const double gap = row.gap + row.slack;
  if (gap >= skin) return skin - gap;
  if (gap >= kRest * skin || !mayPushBack) return 0.0;
  return std::min(kBackShare * (kBackTo * skin - gap), kMostBack);
}

}  // namespace foretouch::internal
