#include "bench/solid/board_trial.h"

#include <algorithm>
#include <cmath>

#include "bench/solid/figure.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

constexpr double kThickness = 4e-3, kMostSlant = 0.5235987755982988;
/// Just before the board, whichever way the hand is turned (m): the air in front proves nothing.
constexpr double kStart = 0.1;
constexpr int kTicksAfter = 12;

struct BoardTrack {
  RigidPose start;
  Eigen::Vector3d velocity;
  double seconds = 0.0;  ///< Until it stays.
};

BoardTrack drawTrack(const BoardCell& cell, PortableRandom& random) {
  BoardTrack track;
  track.start.pivot = random.inBox(0.3);
  track.start.pivot.z() = kStart + random.uniform(0.0, cell.speedMps / kTrialRateHz);
  Eigen::Vector4d q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                    random.uniform(-1, 1));
  if (!(q.norm() > 0.1)) q = {1, 0, 0, 0};
  q.normalize();
  track.start.rotation = Quaternion(q[0], q[1], q[2], q[3]);
  const double slant = random.uniform(0.0, kMostSlant), around = random.uniform(-3.15, 3.15);
  const Eigen::Vector3d direction(std::sin(slant) * std::cos(around),
                                  std::sin(slant) * std::sin(around), -std::cos(slant));
  track.velocity = cell.speedMps * direction;
  track.seconds = (track.start.pivot.z() + cell.beyondM) / -track.velocity.z();
  return track;
}

}  // namespace

RawScene board() {
  RawScene raw;
  addBox(raw, {-4, -4, -kThickness}, {4, 4, 0});
  return raw;
}

std::vector<BoardCell> boardCells() {
  std::vector<BoardCell> cells;
  for (const double speed : {1.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    for (const double beyond : {0.1, 0.5, 2.0}) cells.push_back({speed, beyond});
  }
  return cells;
}

BoardTally tryBoard(HandFollower& hand, const BoardCell& cell, std::uint64_t trials,
                    std::uint64_t seed) {
  PortableRandom random(seed);
  BoardTally tally;
  for (; tally.trials < trials; ++tally.trials) {
    const BoardTrack track = drawTrack(cell, random);
    hand.begin(track.start);
    const int last = static_cast<int>(std::ceil(track.seconds * kTrialRateHz)) + kTicksAfter;
    double at = 0.0;
    for (int i = 1; i <= last; ++i, ++tally.ticks) {
      RigidPose tracked = track.start;
      tracked.pivot += std::min(i / kTrialRateHz, track.seconds) * track.velocity;
      at = hand.follow(tracked, 1.0 / kTrialRateHz).pivot.z();
    }
    tally.through += at < -kThickness ? 1 : 0;
  }
  return tally;
}

}  // namespace foretouch::tools
