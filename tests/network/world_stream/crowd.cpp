#include "tests/network/world_stream/crowd.h"

#include <algorithm>
#include <string>
#include <utility>

#include "articulated/raw_skeleton.h"
#include "tests/network/world_stream/small_world.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using oracle::OracleBody;
using oracle::OracleEpisode;
using oracle::OraclePlace;

/// Of all bodies, and what they may be.
enum Shape : std::size_t { kBall, kRod, kBoard, kFirstAvatar };

OraclePlace placeOf(const RigidPose& pose) {
  return {plain(pose.rotation), plain(pose.translation)};
}

OracleBody judged(const Avatar& avatar) {
  OracleBody body;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    body.parents.push_back(avatar.skeleton().parent(link));
    for (const Lss& lss : avatar.lss(link)) {
      body.parts.push_back({link, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius});
    }
  }
  return body;
}

OracleBody judged(const Scene& mesh) {
  OracleBody body;
  body.parents = {-1};
  for (std::size_t i = 0; i < mesh.numTriangles(); ++i) {
    body.parts.push_back({0, 3, plain(mesh.triangle(static_cast<TriangleId>(i))), 0.0});
  }
  return body;
}

Scene board(double size) {
  RawScene raw;
  raw.objectNames = {"board"};
  const Vector3d a(-size, -size, 0.0), b(size, -size, 0.0), c(size, size, 0.0), d(-size, size, 0.0);
  raw.triangles = {{{a, b, c}}, {{a, c, d}}};
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

Avatar rigid(const Lss& lss) {
  RawSkeleton raw;
  raw.joints.push_back({"prop", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
}

/// Two to five links, each with one or two LSS.
Avatar smallBody(Random& random) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  const int joints = 2 + random.below(4);
  for (int j = 0; j < joints; ++j) {
    const Vector3d offset = j == 0 ? Vector3d::Zero() : random.arrow(0.1, 0.35);
    const Quaternion rotation = random.rotation();
    const int parent = j == 0 ? kNoParent : random.below(j);
    raw.joints.push_back({"joint" + std::to_string(j), parent, offset, rotation});
    auto& own = lss.emplace_back();
    for (int count = 1 + random.below(2); count > 0; --count) {
      const Vector3d a = random.inBox(0.05), b = random.inBox(0.25);
      own.push_back({a, b, random.uniform(0.01, 0.06)});
    }
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

/// Draws one crowd, body by body.
class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : random_(seed) {
    crowd_.isFaulty = random_.chance(0.8);
    if (crowd_.isFaulty) faults_ = {random_.uniform(0.0, 0.2), 0.05, 0.1};
    makeSetup();
    const int avatars = random_.below(3), props = (avatars == 0 ? 3 : 1) + random_.below(3);
    for (int i = 0; i < avatars; ++i) addAvatar();
    for (int i = 0; i < props; ++i) addProp();
    std::stable_sort(
        crowd_.arrivals.begin(), crowd_.arrivals.end(),
        [](const CrowdArrival& x, const CrowdArrival& y) { return x.timeUs < y.timeUs; });
  }
  Crowd take() { return std::move(crowd_); }

 private:
  /// What happens to one sender, on its own clock.
  struct Sender {
    std::int64_t periodUs = 0, skewUs = 0, silentUs = kNever, backUs = kNever, restartUs = kNever;
    std::int64_t session = 0, sequence = 0, stateSequence = 0;

    [[nodiscard]] bool isSilent(std::int64_t us) const { return us > silentUs && us < backUs; }
    /// True once.
    bool restarts(std::int64_t us) {
      if (us <= restartUs) return false;
      restartUs = kNever;
      ++session;
      sequence = stateSequence = 0;
      return true;
    }
  };

  void makeSetup();
  Sender sender();
  [[nodiscard]] BodyNumber nextNumber() const {
    return static_cast<BodyNumber>(crowd_.truth.world.bodies.size());
  }
  void addBody(OracleBody body, std::vector<CrowdState> states, std::optional<PairRules> self);
  template <typename Message>
  void send(const Sender& from, std::int64_t us, const Message& message);

  void addAvatar();
  void loseJoints(PoseMessage& message);

  void addProp();
  std::vector<CrowdState> drawStates();
  [[nodiscard]] RigidPose poseWhere(const CrowdState& state, BodyNumber body);
  void tellStates(BodyNumber body, std::size_t shape, Sender& sender);
  void moveProp(BodyNumber body, Sender& sender);
  void sayPose(BodyNumber body, Sender& sender, std::int64_t us, const RigidPose& pose);

  Random random_;
  Crowd crowd_;
  CrowdFaults faults_;
  std::vector<RigidPose> told_;  // per state of the prop that is drawn: its pose at its begin
  int badJoint_ = -1;            // of the avatar that is drawn
};

void Drawing::makeSetup() {
  WorldSetup& setup = crowd_.setup;
  const double half = random_.uniform(0.02, 0.15);
  const Lss rod{{0.0, 0.0, 0.0}, {0.0, 0.0, half}, random_.uniform(0.01, 0.05)};
  const Scene plate = board(random_.uniform(0.05, 0.25));
  setup.shapes.push_back({"ball", ball(), std::nullopt, 0, std::nullopt});
  setup.shapes.push_back({"rod", rigid(rod), std::nullopt, 0, std::nullopt});
  setup.shapes.push_back({"board", std::nullopt, plate, 0, std::nullopt});
  if (random_.chance(0.3)) {
    setup.still = board(0.4);
    crowd_.truth.still = judged(*setup.still);
    crowd_.truth.still->episodes = {{0, -1, 0, {0}, {{OraclePlace()}}}};
  }
  setup.options.tolerance = random_.magnitude(1e-4, 3e-3);
}

Drawing::Sender Drawing::sender() {
  Sender sender;
  sender.periodUs = 8000 + random_.below(25'000);
  sender.session = 10 * nextNumber() + 1;
  const auto sometime = [this] { return kCrowdBeginUs + random_.below(kCrowdLengthUs); };
  if (random_.chance(0.3)) sender.skewUs = random_.below(80'000) - 40'000;
  if (random_.chance(0.3)) sender.silentUs = sometime();
  if (sender.silentUs != kNever && random_.chance(0.5)) sender.backUs = sender.silentUs + 400'000;
  if (random_.chance(0.3)) sender.restartUs = sometime();
  if (!crowd_.isFaulty) {
    sender.skewUs = 0;
    sender.silentUs = sender.restartUs = kNever;
  }
  return sender;
}

void Drawing::addBody(OracleBody body, std::vector<CrowdState> states,
                      std::optional<PairRules> self) {
  crowd_.truth.world.bodies.push_back(std::move(body));
  crowd_.truth.states.push_back(std::move(states));
  crowd_.truth.self.push_back(std::move(self));
}

/// `us` is by the sender's clock, which stamps.
template <typename Message>
void Drawing::send(const Sender& from, std::int64_t us, const Message& message) {
  if (from.isSilent(us)) return;
  const auto arrive = [&] {
    const int late = random_.chance(faults_.delay) ? random_.below(60'000) : random_.below(1000);
    crowd_.arrivals.push_back({us - from.skewUs + 100 + late, message});
  };
  if (!random_.chance(faults_.loss)) arrive();
  if (random_.chance(faults_.repeat)) arrive();
}

// Avatars.

void Drawing::addAvatar() {
  const BodyNumber number = nextNumber();
  Sender from = sender();
  const Avatar avatar = smallBody(random_);
  const auto derived = PairRules::derive(avatar);
  std::optional<PairRules> self;
  if (derived.ok() && random_.chance(0.5)) self = derived.value();
  crowd_.setup.avatars.push_back({number, crowd_.setup.shapes.size()});
  crowd_.setup.shapes.push_back({"avatar" + std::to_string(number), avatar, std::nullopt, 0, self});
  const RawSkeleton skeleton = rawSkeleton(avatar.skeleton());
  Pose pose = restPose(avatar.skeleton());
  pose.translations[0] = random_.inBox(0.3);
  std::vector<Quaternion> turns;
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    turns.push_back(random_.turn(random_.uniform(0.0, 0.4)));
  }
  Vector3d velocity = random_.inBox(2.0);
  badJoint_ = -1;
  OracleEpisode episode;
  const std::int64_t beginUs = kCrowdBeginUs + from.skewUs + random_.below(20'000);
  SkeletonMessage described = skeletonMessage(skeleton, from.session);
  described.avatar = number;
  std::int64_t describedUs = 0;
  for (std::int64_t us = beginUs; us < beginUs + kCrowdLengthUs; us += from.periodUs) {
    if (from.restarts(us) || us > describedUs + 200'000) {
      described.session = from.session;
      describedUs = us;
      send(from, us - 100, described);
    }
    std::vector<OraclePlace> places;
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      places.push_back({plain(pose.rotations[j]), plain(pose.translations[j])});
    }
    episode.times.push_back(us);
    episode.poses.push_back(places);
    PoseMessage message = poseMessage(skeleton, from.sequence++, us, from.session);
    message.avatar = number;
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      message.joints[j].rotation = pose.rotations[j];
    }
    message.translations[0].translation = pose.translations[0];
    loseJoints(message);
    send(from, us, message);
    for (std::size_t j = 0; j < turns.size(); ++j) {
      pose.rotations[j] = (pose.rotations[j] * turns[j]).normalized();
      if (random_.chance(0.1)) turns[j] = random_.turn(random_.uniform(0.0, 0.6));
    }
    const Vector3d& place = pose.translations[0];
    if (random_.chance(0.2) || place.norm() > 0.4) velocity = -2.0 * place + random_.inBox(2.0);
    pose.translations[0] += 1e-6 * static_cast<double>(from.periodUs) * velocity;
  }
  episode.beginUs = beginUs;
  OracleBody body = judged(avatar);
  body.episodes.push_back(std::move(episode));
  addBody(std::move(body), {{beginUs}}, std::move(self));
}

/// A joint that is not known has any value, or is not listed.
void Drawing::loseJoints(PoseMessage& message) {
  if (!crowd_.isFaulty) return;
  const auto joints = static_cast<int>(message.joints.size());
  if (badJoint_ < 0 && random_.chance(0.03)) badJoint_ = random_.below(joints);
  if (badJoint_ < 0) return;
  const auto bad = static_cast<std::size_t>(badJoint_);
  if (random_.chance(0.4)) badJoint_ = -1;
  message.joints[bad].rotation = random_.rotation();
  switch (random_.below(3)) {
    case 0: message.joints[bad].flags = 0; break;
    case 1: message.joints[bad].flags = kJointValid; break;
    default:
      message.joints.erase(message.joints.begin() + static_cast<std::ptrdiff_t>(bad));
      if (bad == 0) message.translations.clear();
  }
}

// Props.

/// Free, carried for a while, free again, gone.
std::vector<CrowdState> Drawing::drawStates() {
  std::vector<CrowdState> states(1);
  std::int64_t us = kCrowdBeginUs + 20'000 + random_.below(30'000);
  states[0].sinceUs = us;
  const auto avatars = static_cast<int>(crowd_.setup.avatars.size());
  const int carries = avatars == 0 ? 0 : random_.below(3);
  for (int i = 0; i < carries; ++i) {
    const WorldSetup::ServedAvatar& by =
        crowd_.setup.avatars[static_cast<std::size_t>(random_.below(avatars))];
    const int links = crowd_.setup.shapes[by.shape].avatar->numLinks();
    us += 100'000 + random_.below(250'000);
    states.push_back({us, true, by.number, random_.below(links), random_.chance(0.4)});
    us += 20'000 + random_.below(200'000);
    if (random_.chance(0.8)) states.push_back({us});
  }
  us += 100'000 + random_.below(400'000);
  if (random_.chance(0.3)) states.push_back({us, false});
  return states;
}

void Drawing::addProp() {
  const BodyNumber number = nextNumber();
  Sender from = sender();
  const auto shape = static_cast<std::size_t>(random_.below(kFirstAvatar));
  const WorldShape& made = crowd_.setup.shapes[shape];
  addBody(made.avatar ? judged(*made.avatar) : judged(*made.mesh), drawStates(), std::nullopt);
  told_.clear();
  moveProp(number, from);
  tellStates(number, shape, from);
}

/// In the frame of its carrier, or in W near where it was before.
RigidPose Drawing::poseWhere(const CrowdState& state, BodyNumber body) {
  const bool isFirst = told_.empty();
  const Quaternion rotation = random_.rotation();
  if (state.carrier != kNoBody) return {rotation, random_.inBox(0.15)};
  if (isFirst) return {rotation, random_.inBox(0.3)};
  const auto parts = crowd_.truth.world.partsAt(body, 0, state.sinceUs, 0);
  return {rotation, tools::rich(parts[0].corners[0]).cwiseMax(-0.5).cwiseMin(0.5)};
}

/// Draws its way, and says all of it.
void Drawing::moveProp(BodyNumber body, Sender& from) {
  const std::vector<CrowdState> states = crowd_.truth.states[static_cast<std::size_t>(body)];
  const std::int64_t endUs = kCrowdBeginUs + from.skewUs + kCrowdLengthUs;
  for (std::size_t i = 0; i < states.size() && states[i].isPresent; ++i) {
    const CrowdState& state = states[i];
    RigidPose pose = poseWhere(state, body);
    told_.push_back(pose);
    auto& episodes = crowd_.truth.world.bodies[static_cast<std::size_t>(body)].episodes;
    episodes.push_back(
        {state.sinceUs, state.carrier, state.link, {state.sinceUs}, {{placeOf(pose)}}});
    if (!state.hasPoses()) continue;
    const std::int64_t toUs = i + 1 < states.size() ? states[i + 1].sinceUs : endUs;
    const double reach = state.carrier == kNoBody ? 0.4 : 0.15;
    const double speed = state.carrier == kNoBody ? 2.0 : 0.5;
    Vector3d velocity = random_.inBox(speed);
    const Quaternion turn = random_.turn(random_.uniform(0.0, 0.8));
    const bool isClosed = random_.chance(0.5);  // its last pose is that of the change
    if (i == 0 && random_.chance(0.5)) sayPose(body, from, state.sinceUs, pose);
    for (std::int64_t us = state.sinceUs; us < toUs;) {
      std::int64_t stepUs = from.periodUs;
      if (us + stepUs >= toUs && isClosed) stepUs = toUs - us;
      us += stepUs;
      if (us > toUs || us > endUs) break;
      if (random_.chance(0.2) || pose.translation.norm() > reach) {
        velocity = -2.0 * pose.translation + random_.inBox(speed);
      }
      pose.translation += 1e-6 * static_cast<double>(stepUs) * velocity;
      pose.rotation = (pose.rotation * turn).normalized();
      episodes.back().times.push_back(us);
      episodes.back().poses.push_back({placeOf(pose)});
      sayPose(body, from, us, pose);
    }
  }
}

void Drawing::sayPose(BodyNumber body, Sender& from, std::int64_t us, const RigidPose& pose) {
  from.restarts(us);
  send(from, us, rigidPoses(from.sequence++, us, {{body, kTrackedNow, pose}}, from.session));
}

/// When it changes, sometimes before, and again ten times a second.
void Drawing::tellStates(BodyNumber body, std::size_t shape, Sender& from) {
  const std::vector<CrowdState>& states = crowd_.truth.states[static_cast<std::size_t>(body)];
  const std::int64_t session = 10 * body + 1;  // what says states is not restarted
  std::vector<std::int64_t> saidUs;            // since when each is said
  for (const CrowdState& state : states) {
    const bool isEarly = !saidUs.empty() && random_.chance(0.3);
    saidUs.push_back(state.sinceUs - (isEarly ? random_.below(15'000) : 0));
  }
  saidUs.push_back(kCrowdBeginUs + kCrowdLengthUs);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const CrowdState& state = states[i];
    for (std::int64_t us = saidUs[i]; us < saidUs[i + 1]; us += 100'000) {
      BodyMessage message;
      message.body = body;
      message.session = session;
      message.sequence = from.stateSequence++;
      message.utimeUs = us;
      message.isPresent = state.isPresent;
      message.shape = crowd_.setup.shapes[shape].name;
      message.carrier = state.carrier;
      message.carrierLink = state.link;
      message.movesInFrame = state.movesInFrame;
      if (state.isPresent) message.pose = told_[i];
      message.sinceUs = state.sinceUs;
      send(from, us, message);
    }
  }
}

}  // namespace

const CrowdState* CrowdTruth::stateAt(BodyNumber body, std::int64_t us) const {
  const CrowdState* at = nullptr;
  for (const CrowdState& state : states[static_cast<std::size_t>(body)]) {
    if (state.sinceUs <= us) at = &state;
  }
  return at != nullptr && at->isPresent ? at : nullptr;
}

Crowd drawCrowd(std::uint64_t seed) {
  return Drawing(seed).take();
}

}  // namespace foretouch::test
