// bench/moving_load.h: rigid bodies beside the avatars of a load: what a service with a world gets
// to know about them, the file of that world, and what comes back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/bench_folder.h"
#include "bench/inputs.h"
#include "network/wire/wire.h"
#include "network/wire/world_messages.h"

namespace foretouch::tools {

struct MovingRequest {
  int props = 0;             ///< Balls, each on a circle of its own; 0: there is no world.
  double rateHz = 60.0;      ///< The rate of the message that has all of them.
  bool isFurnished = false;  ///< They move in the scene of the files, and not in an empty hall.
};

/// The world file of a load: a hall, or the scene of the files, `avatars` of the same body, and the
/// shape that all balls have.
[[nodiscard]] Result<std::string> writeLoadWorld(const BenchFolder& folder, const BenchFiles& files,
                                                 std::size_t avatars, bool isFurnished);

/// Where the avatar of this index stands, beside the first one (m): people in rows.
[[nodiscard]] Eigen::Vector3d placeInCrowd(std::size_t index);

/// Announces the balls, and moves them. For the thread that sends.
class MovingProps {
 public:
  /// `session`: when they begin to move. `firstBody`: the number of the first ball, above those of
  /// all avatars.
  MovingProps(const MovingRequest& request, std::int64_t session, BodyNumber firstBody);

  /// Sends what each of them is; also every second, so that a late receiver knows.
  void tell(Publisher& publisher, std::int64_t utimeUs);
  /// Sends all of them at one instant. False if the system did not take it.
  bool move(Publisher& publisher, std::int64_t captureUs, std::int64_t sendUs);

 private:
  [[nodiscard]] RigidPose poseAt(std::size_t ball, double seconds) const;

  BodyMessage body_;
  RigidPoseMessage pose_;
  std::int64_t startUs_, told_ = 0;
  Bytes payload_;
};

/// What the service says about the world, message by message. For the thread that receives.
struct MovingAnswers {
  void take(ByteView payload);

  std::int64_t advances = 0;  ///< Windows.
  std::int64_t missed = 0;    ///< Messages that never came here.
  std::int64_t events = 0, marked = 0;
  std::int64_t timelines = 0;
  /// Per window: from the receipt that let the watermark advance to the sending.
  std::vector<float> advanceUs;

 private:
  std::int64_t next_ = -1, timeline_ = -1;
  EventsMessage message_;
};

}  // namespace foretouch::tools
