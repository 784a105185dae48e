#include "tests/network/simulated_sender.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace foretouch::test {
namespace {

constexpr std::int64_t kEpochUs = 1'700'000'000'000'000;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr int kExtra = -1;  // a joint that drives nothing

std::int64_t below(Random& random, std::int64_t n) {
  return static_cast<std::int64_t>(random.uniform(0.0, static_cast<double>(n)));
}

/// What is known of a joint at the moment.
enum class Tracking { Tracked, Inferred, Invalid, Stale, Missing };

class Script {
 public:
  Script(Random& random, const SimulatedBody& body, const SenderSetup& setup,
         const SenderFaults& faults)
      : random_(random), body_(body.avatar.skeleton()), setup_(setup), faults_(faults) {
    sender_.avatar = setup.avatar;
    sender_.hasSessions = !(setup.mayLackSessions && random.chance(faults.noSessions));
    rateHz_ = random.uniform(20.0, 120.0);
    clockOffsetUs_ = below(random, 2 * kSecondUs);
    timeUs_ = below(random, kSecondUs / 5);
    resendUs_ = kSecondUs / 10 + below(random, kSecondUs / 2);
    chooseJoints();
  }

  SimulatedSender run() {
    const int poses = 20 + random_.below(41);
    const int stopsAfter = random_.chance(faults_.stops) ? random_.below(poses) : poses;
    start();
    if (random_.chance(faults_.lateSkeleton)) nextSkeletonUs_ = timeUs_ + below(random_, kSecondUs);
    for (int n = 0; n < stopsAfter; ++n) {
      if (n > 0 && random_.chance(faults_.restart)) start();
      if (n > 0 && random_.chance(faults_.changedSkeleton)) changeSkeleton();
      if (random_.chance(faults_.clockJump)) jumpClock();
      if (timeUs_ >= nextSkeletonUs_) sendSkeleton();
      pose();
      timeUs_ += static_cast<std::int64_t>(1e6 / rateHz_ * random_.uniform(0.9, 1.1));
      if (random_.chance(faults_.pause)) timeUs_ += below(random_, 14 * kSecondUs);
    }
    return std::move(sender_);
  }

 private:
  [[nodiscard]] std::int64_t clockUs() const { return kEpochUs + timeUs_ + clockOffsetUs_; }

  void chooseJoints() {
    const auto n = static_cast<std::size_t>(body_.numJoints());
    std::vector<int> placeOf(n, kExtra);
    moves_.assign(n, true);
    drifts_.assign(n, false);
    for (std::size_t j = 0; j < n; ++j) {
      const bool isLast = j + 1 == n && avatarJointOf_.empty();
      const bool isLacking = !isLast && random_.chance(faults_.unmatched);
      const bool isRoot = body_.parents()[j] == kNoParent;
      drifts_[j] = isRoot || random_.chance(0.2);
      if (isLacking && setup_.unmatchedAtRest) moves_[j] = drifts_[j] = false;
      if (!said_.joints.empty() && random_.chance(0.15)) addJoint("Extra" + std::to_string(j), 0);
      if (isLacking) continue;
      JointId above = body_.parents()[j];
      while (above != kNoParent && placeOf[static_cast<std::size_t>(above)] == kExtra) {
        above = body_.parents()[static_cast<std::size_t>(above)];
      }
      placeOf[j] = static_cast<int>(said_.joints.size());
      addJoint(body_.name(static_cast<JointId>(j)),
               above == kNoParent ? kNoParent : placeOf[static_cast<std::size_t>(above)]);
      avatarJointOf_.back() = static_cast<int>(j);
    }
  }

  void addJoint(const std::string& name, JointId parent) {
    said_.joints.push_back({name, parent, random_.inBox(0.3), random_.rotation()});
    avatarJointOf_.push_back(kExtra);
  }

  void start() {
    sender_.lives.emplace_back();
    motion_.emplace(random_, body_, moves_, drifts_);
    session_ = sender_.hasSessions ? clockUs() / 16 * 16 + setup_.sender : 0;
    generation_ = 0;
    sequence_ = random_.chance(0.5) ? 0 : below(random_, 1'000'000);
    if (random_.chance(0.3 * faults_.changedSkeleton)) said_.joints[0].offset += random_.inBox(0.1);
    tracking_.assign(said_.joints.size(), {});
    for (Joint& joint : tracking_) {
      if (random_.chance(faults_.fewJoints)) joint = {Tracking::Missing, kForEver};
    }
    nextSkeletonUs_ = timeUs_;
  }

  void changeSkeleton() {
    said_.joints[static_cast<std::size_t>(random_.below(static_cast<int>(said_.joints.size())))]
        .offset += random_.inBox(0.1);
    ++generation_;
    nextSkeletonUs_ = timeUs_;
  }

  void jumpClock() {
    const double jump = random_.magnitude(1e3, 2e10) * (random_.chance(0.5) ? 1.0 : -1.0);
    clockOffsetUs_ += static_cast<std::int64_t>(jump);
  }

  void sendSkeleton() {
    SkeletonMessage message;
    message.avatar = setup_.avatar;
    message.session = session_;
    message.generation = generation_;
    message.sendUtimeUs = clockUs();
    message.source = "simulated";
    message.skeleton = said_;
    message.hash = skeletonHash(said_);
    SentMessage sent{timeUs_, true, {}, {}};
    encode(message, sent.payload);
    sender_.sent.push_back(std::move(sent));
    nextSkeletonUs_ = timeUs_ + resendUs_;
  }

  void pose() {
    std::vector<Pose>& life = sender_.lives.back();
    life.push_back(motion_->next(1.0 / rateHz_));
    PoseMessage message;
    message.avatar = setup_.avatar;
    message.session = session_;
    message.sequence = sequence_++;
    message.utimeUs = message.sendUtimeUs = clockUs();
    if (random_.chance(faults_.oddStamp)) {
      const double odd = random_.magnitude(1.0, 1e11) * (random_.chance(0.5) ? 1.0 : -1.0);
      message.utimeUs += static_cast<std::int64_t>(odd);
    }
    message.skeletonHash = skeletonHash(said_);
    for (std::size_t s = 0; s < said_.joints.size(); ++s) addJointOf(life.back(), s, message);
    if (random_.chance(faults_.badContent) && !message.joints.empty()) spoil(message);
    const PoseId id{setup_.sender, static_cast<int>(sender_.lives.size()) - 1,
                    static_cast<int>(life.size()) - 1};
    SentMessage sent{timeUs_, false, {}, id};
    encode(message, sent.payload);
    sender_.sent.push_back(std::move(sent));
  }

  void addJointOf(const Pose& truth, std::size_t s, PoseMessage& message) {
    Joint& joint = tracking_[s];
    const int a = avatarJointOf_[s];
    const bool drives = a != kExtra;
    const auto place = static_cast<std::size_t>(drives ? a : 0);
    if (joint.poses > 0 && --joint.poses == 0) joint.tracking = Tracking::Tracked;
    if (joint.tracking == Tracking::Tracked && random_.chance(faults_.trackingLost)) {
      joint.tracking = static_cast<Tracking>(1 + random_.below(4));
      joint.poses = 1 + random_.below(10);
    }
    if (joint.tracking != Tracking::Stale) {
      joint.rotation = drives ? truth.rotations[place] : random_.rotation();
      joint.translation = drives ? truth.translations[place] : random_.inBox(1.0);
    }
    if (joint.tracking == Tracking::Missing) return;
    PoseJoint said{static_cast<std::int32_t>(s), flagsOf(joint.tracking), joint.rotation};
    PoseTranslation translation{said.joint, joint.translation};
    if (joint.tracking == Tracking::Invalid) {
      said.rotation = garbage();
      translation.translation =
          random_.chance(0.3) ? Eigen::Vector3d(kNaN, kNaN, kNaN) : random_.inBox(1.0);
    }
    message.joints.push_back(said);
    if (drives && drifts_[place]) message.translations.push_back(translation);
  }

  [[nodiscard]] std::uint8_t flagsOf(Tracking tracking) {
    switch (tracking) {
      case Tracking::Tracked: return kJointValid | kJointTracked;
      case Tracking::Inferred: return kJointValid | kJointInferred;
      case Tracking::Stale: return kJointValid;
      default: return random_.chance(0.3) ? kJointTracked : 0;
    }
  }

  [[nodiscard]] Quaternion garbage() {
    if (random_.chance(0.5)) return random_.rotation();
    const double number = random_.chance(0.5) ? kNaN : random_.uniform(-9.0, 9.0);
    return Quaternion(number, number, 0.0, 0.0);
  }

  void spoil(PoseMessage& message) {
    PoseJoint& joint = message.joints[static_cast<std::size_t>(
        random_.below(static_cast<int>(message.joints.size())))];
    joint.flags |= kJointValid;
    switch (random_.below(5)) {
      case 0: joint.rotation.x() = kNaN; break;
      case 1: joint.rotation = Quaternion(1.5, 0.0, 0.0, 0.0); break;
      case 2: joint.joint = static_cast<std::int32_t>(said_.joints.size()); break;
      case 3: joint.flags |= 16; break;
      default: message.translations.push_back({joint.joint, {2e7, 0.0, 0.0}}); break;
    }
  }

  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  static constexpr int kForEver = 0;  // never counted down
  struct Joint {
    Tracking tracking = Tracking::Tracked;
    int poses = 0;
    Quaternion rotation = Quaternion::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  };

  Random& random_;
  const Skeleton& body_;
  SenderSetup setup_;
  SenderFaults faults_;
  SimulatedSender sender_;
  double rateHz_ = 0.0;
  std::int64_t clockOffsetUs_ = 0, timeUs_ = 0, resendUs_ = 0, nextSkeletonUs_ = 0;
  RawSkeleton said_;
  std::vector<int> avatarJointOf_;  // per joint of said_
  std::vector<bool> moves_, drifts_;
  std::optional<TrueMotion> motion_;
  std::int64_t session_ = 0, sequence_ = 0;
  std::int32_t generation_ = 0;
  std::vector<Joint> tracking_;
};

}  // namespace

SimulatedSender randomSender(Random& random, const SimulatedBody& body, const SenderSetup& setup,
                             const SenderFaults& faults) {
  return Script(random, body, setup, faults).run();
}

}  // namespace foretouch::test
