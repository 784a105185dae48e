#include "bench/moving_load.h"

#include <cmath>

#include <fmt/format.h>

#include "articulated/try.h"
#include "lss/index.h"
#include "network/wire/codec.h"

namespace foretouch::tools {
namespace {

constexpr char kShape[] = "ball";
constexpr double kBallRadius = 0.07;
/// People per row, and between two of them (m).
constexpr std::size_t kPerRow = 4;
constexpr double kSpacing = 1.5;
/// A hall with a floor and four walls (m): people who stand in furniture would measure that.
constexpr char kHall[] =
    "o floor\nv -12 0 -12\nv -12 0 12\nv 12 0 12\nv 12 0 -12\nf 1 2 3\nf 1 3 4\n"
    "o walls\nv -12 4 -12\nv -12 4 12\nv 12 4 12\nv 12 4 -12\n"
    "f 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
/// The circles on which balls go (m), and how fast (rad/s). Heights are from the shin to the
/// head.
constexpr double kCircle = 0.45, kTurn = 2.0, kLowest = 0.4, kHighest = 1.7;
constexpr double kUsPerS = 1e6;

}  // namespace

Result<std::string> writeLoadWorld(const BenchFolder& folder, const BenchFiles& files,
                                   std::size_t avatars, bool isFurnished) {
  std::string scene = files.scenePath;
  if (!isFurnished) {
    FORETOUCH_TRY(scene, folder.write("hall.obj", kHall));
  }
  std::string text =
      fmt::format("format = \"foretouch-world\"\nversion = 1\n\n[scene]\nfile = \"{}\"\n", scene);
  for (std::size_t i = 1; i <= avatars; ++i) {
    text += fmt::format("\n[[body]]\nname = \"dancer {}\"\navatar = \"{}\"\n", i, files.avatarPath);
  }
  text += fmt::format("\n[[body]]\nname = \"{}\"\nsphere = {}\nmass = 0.4\n", kShape, kBallRadius);
  return folder.write("load.world.toml", text);
}

Eigen::Vector3d placeInCrowd(std::size_t index) {
  return {kSpacing * static_cast<double>(index % kPerRow), 0.0,
          kSpacing * static_cast<double>(index / kPerRow)};
}

MovingProps::MovingProps(const MovingRequest& request, std::int64_t session, BodyNumber firstBody)
    : startUs_(session) {
  body_.session = pose_.session = session;
  body_.shape = kShape;
  pose_.bodies.resize(countOf(request.props));
  for (BodyPose& ball : pose_.bodies) {
    ball.body = firstBody++;
    ball.flags = kJointValid | kJointTracked;
  }
}

void MovingProps::tell(Publisher& publisher, std::int64_t utimeUs) {
  body_.utimeUs = body_.sendUtimeUs = utimeUs;
  body_.sinceUs = startUs_;
  for (std::size_t ball = 0; ball < pose_.bodies.size(); ++ball) {
    body_.body = pose_.bodies[ball].body;
    body_.sequence = told_++;
    body_.pose = poseAt(ball, 0.0);
    encode(body_, payload_);
    publisher.publish(kBodyChannel, payload_);
  }
}

bool MovingProps::move(Publisher& publisher, std::int64_t captureUs, std::int64_t sendUs) {
  const double seconds = static_cast<double>(captureUs - startUs_) / kUsPerS;
  for (std::size_t ball = 0; ball < pose_.bodies.size(); ++ball) {
    pose_.bodies[ball].pose = poseAt(ball, seconds);
  }
  pose_.utimeUs = captureUs;
  pose_.sendUtimeUs = sendUs;
  encode(pose_, payload_);
  ++pose_.sequence;
  return publisher.publish(kRigidPoseChannel, payload_);
}

/// A ball's place around the people, each at its own height and from its own angle on, spinning.
RigidPose MovingProps::poseAt(std::size_t ball, double seconds) const {
  const double share = static_cast<double>(ball) / static_cast<double>(pose_.bodies.size());
  const double angle = kTurn * seconds + 17.0 * share;
  RigidPose pose;
  pose.translation = placeInCrowd(ball) + Eigen::Vector3d(kCircle * std::cos(angle),
                                                          kLowest + (kHighest - kLowest) * share,
                                                          kCircle * std::sin(angle));
  pose.rotation = Quaternion(std::cos(angle), 0.0, std::sin(angle), 0.0);
  return pose;
}

void MovingAnswers::take(ByteView payload) {
  if (decode(payload, message_) != Reject::None) return;
  if (message_.timeline != timeline_) {
    timeline_ = message_.timeline;
    ++timelines;
  }
  if (next_ >= 0 && message_.sequence > next_) missed += message_.sequence - next_;
  next_ = message_.sequence + 1;
  for (const ToldEvent& event : message_.events) {
    ++events;
    marked += event.event.isAssumed ? 1 : 0;
  }
  if (message_.hasMore) return;
  ++advances;
  advanceUs.push_back(static_cast<float>(message_.sendUtimeUs - message_.receiveUtimeUs));
}

}  // namespace foretouch::tools
