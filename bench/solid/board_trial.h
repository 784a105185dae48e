// bench/solid/board_trial.h: hands that are led through a board: which come out behind it, and how
// do the others rest in front of it? Metres.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/hand_follower.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

inline constexpr double kThinBoard = 4e-3;

/// A board of 8 m by 8 m, its front at z = 0, so that no hand slides around it.
[[nodiscard]] RawScene board(double thickness = kThinBoard);

/// How hands are led: from 0.3 m in front, straight, up to 30 degrees aslant and turned anyhow, at
/// one speed, until the tracked hand is `beyond` the board; there it stays for 20 ticks.
struct BoardCell {
  double speedMps = 1.0, beyondM = 0.1;
  double thickness = kThinBoard;
};
/// The cells: 1 to 100 m/s, 0.1 to 2 m.
[[nodiscard]] std::vector<BoardCell> boardCells();

struct BoardTally {
  std::uint64_t trials = 0, ticks = 0;
  std::uint64_t through = 0;  ///< The hand's middle is behind the board's back in the end.
  // For the others, in the end, while the tracked hand rests.
  std::vector<double> sunk;      ///< How deep it is in the board.
  std::vector<double> trembles;  ///< The most that its middle moves in one of the last ticks.
  double us = 0.0;               ///< Of all ticks.

  void add(const BoardTally& other);
};

/// The same seed gives the same trials, whatever the hand is.
[[nodiscard]] BoardTally tryBoard(HandFollower& hand, const BoardCell& cell, std::uint64_t trials,
                                  std::uint64_t seed);

}  // namespace foretouch::tools
