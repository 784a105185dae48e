#include "bench/solid/board_trial.h"

#include <algorithm>
#include <cmath>

#include "bench/machine.h"
#include "bench/solid/figure.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

constexpr double kMostSlant = 0.5235987755982988;
/// Just before the board, whichever way the hand is turned (m): the air in front proves nothing.
constexpr double kStart = 0.1;
constexpr int kTicksAfter = 12, kTicksAtRest = 6;

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

double lowestOf(const RigidPose& hand) {
  const Lss lss = handLss();
  return hand.pivot.z() - lss.radius +
         std::min((hand.rotation * lss.a).z(), (hand.rotation * lss.b).z());
}

}  // namespace

RawScene board(double thickness) {
  RawScene raw;
  addBox(raw, {-4, -4, -thickness}, {4, 4, 0});
  return raw;
}

std::vector<BoardCell> boardCells() {
  std::vector<BoardCell> cells;
  for (const double speed : {1.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    for (const double beyond : {0.1, 0.5, 2.0}) cells.push_back({speed, beyond});
  }
  return cells;
}

void BoardTally::add(const BoardTally& other) {
  trials += other.trials;
  ticks += other.ticks;
  through += other.through;
  sunk.insert(sunk.end(), other.sunk.begin(), other.sunk.end());
  trembles.insert(trembles.end(), other.trembles.begin(), other.trembles.end());
  us += other.us;
}

BoardTally tryBoard(HandFollower& hand, const BoardCell& cell, std::uint64_t trials,
                    std::uint64_t seed) {
  PortableRandom random(seed);
  BoardTally tally;
  for (; tally.trials < trials; ++tally.trials) {
    const BoardTrack track = drawTrack(cell, random);
    hand.begin(track.start);
    const int last = static_cast<int>(std::ceil(track.seconds * kTrialRateHz)) + kTicksAfter;
    RigidPose shown = track.start;
    double trembles = 0.0;
    for (int i = 1; i <= last; ++i, ++tally.ticks) {
      RigidPose tracked = track.start;
      tracked.pivot += std::min(i / kTrialRateHz, track.seconds) * track.velocity;
      const Eigen::Vector3d before = shown.pivot;
      const ThreadStopwatch watch;
      shown = hand.follow(tracked, 1.0 / kTrialRateHz);
      tally.us += watch.us();
      hand.look();
      if (i > last - kTicksAtRest) trembles = std::max(trembles, (shown.pivot - before).norm());
    }
    if (shown.pivot.z() < -cell.thickness) {
      ++tally.through;
      continue;
    }
    tally.sunk.push_back(std::max(0.0, -lowestOf(shown)));
    tally.trembles.push_back(trembles);
  }
  return tally;
}

}  // namespace foretouch::tools
