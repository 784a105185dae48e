#include "tests/network/stream/stream_attack.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "network/stream/bound_stream.h"
#include "tests/network/faulty_network.h"
#include "tests/network/recorded_stream.h"
#include "tests/network/simulated_sender.h"
#include "tests/network/simulated_world.h"

namespace foretouch::test {
namespace {

constexpr std::int64_t kEpochUs = 1'700'000'000'000'000, kDayUs = 86'400'000'000;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr UdpmSender kTrue{0x0100000a, 7000};
constexpr std::int32_t kAvatar = 5;
/// Poses that a sender needs until nobody can interrupt it; the stream's confirmations.
constexpr int kConfirmations = 3;
/// Forged datagrams of the true sender's own address are no closer than so many true poses.
constexpr int kPosesApart = 8;

/// A datagram of either side.
struct Datagram {
  std::int64_t timeUs = 0;
  bool isSkeleton = false, isHostile = false;
  UdpmSender sender;
  Bytes payload;
};

/// Makes the adversary's datagrams out of what it has read.
class Adversary {
 public:
  explicit Adversary(Random& random) : random_(random) {}

  void read(const Datagram& datagram) {
    if (datagram.isSkeleton) {
      static_cast<void>(decode(datagram.payload, skeleton_));
      hasSkeleton_ = true;
    } else {
      static_cast<void>(decode(datagram.payload, pose_));
      hasPose_ = true;
      if (old_.size() < 64) old_.push_back(datagram);
    }
  }

  Datagram next(std::int64_t nowUs) {
    Datagram datagram;
    datagram.isHostile = true;
    datagram.timeUs = nowUs;
    datagram.sender = {static_cast<std::uint32_t>(0x0200000a + random_.below(3)),
                       static_cast<std::uint16_t>(7000 + random_.below(4))};
    const int kind = random_.below(10);
    if (kind == 0 && !old_.empty()) {
      const Datagram& replayed =
          old_[static_cast<std::size_t>(random_.below(static_cast<int>(old_.size())))];
      datagram.isSkeleton = replayed.isSkeleton;
      datagram.payload = replayed.payload;
    } else if (hasSkeleton_ && (kind < 4 || !hasPose_)) {
      sayAnother(datagram);
    } else if (hasPose_) {
      poseAsTrue(datagram);
    } else {
      datagram.payload.assign(static_cast<std::size_t>(random_.below(100)), 0xa5);
    }
    return datagram;
  }

 private:
  [[nodiscard]] std::int64_t session(std::int64_t nowUs) {
    switch (random_.below(5)) {
      case 0: return (std::int64_t{1} << 62) - 1;
      case 1:
        return kEpochUs + nowUs +
               static_cast<std::int64_t>(random_.uniform(0.0, 1.0) * static_cast<double>(kDayUs));
      case 2: return lastSession_;
      case 3: return 0;
      default: return skeleton_.session;
    }
  }

  void sayAnother(Datagram& datagram) {
    SkeletonMessage message = skeleton_;
    message.session = lastSession_ = session(datagram.timeUs);
    message.generation += random_.below(3);
    message.sendUtimeUs = kEpochUs + datagram.timeUs;
    if (random_.chance(0.8)) message.skeleton.joints[0].offset.x() += 0.25 * random_.below(3);
    message.hash = skeletonHash(message.skeleton);
    lastHash_ = message.hash;
    datagram.isSkeleton = true;
    encode(message, datagram.payload);
  }

  void poseAsTrue(Datagram& datagram) {
    PoseMessage message = pose_;
    message.session = random_.chance(0.5) ? lastSession_ : session(datagram.timeUs);
    if (random_.chance(0.4) && lastHash_ != 0) message.skeletonHash = lastHash_;
    switch (random_.below(4)) {
      case 0: message.sequence = (std::int64_t{1} << 62) - 1; break;
      case 1: message.sequence += random_.below(100) - 50; break;
      default: message.sequence = std::max<std::int64_t>(0, sequence_++); break;
    }
    message.sequence = std::max<std::int64_t>(0, message.sequence);
    switch (random_.below(4)) {
      case 0: message.utimeUs += static_cast<std::int64_t>(random_.uniform(-1e9, 1e9)); break;
      case 1: message.utimeUs += random_.below(20'000) - 10'000; break;
      default: message.utimeUs = kEpochUs + datagram.timeUs; break;
    }
    message.utimeUs = std::max<std::int64_t>(0, message.utimeUs);
    encode(message, datagram.payload);
  }

  Random& random_;
  SkeletonMessage skeleton_;
  PoseMessage pose_;
  bool hasSkeleton_ = false, hasPose_ = false;
  std::vector<Datagram> old_;
  std::int64_t lastSession_ = 0, lastHash_ = 0, sequence_ = 0;
};

/// One true sender without faults; its network loses nothing.
std::vector<Datagram> trueStream(Random& random, const SimulatedBody& body) {
  SenderSetup setup;
  setup.avatar = kAvatar;
  setup.mayLackSessions = false;
  const SimulatedSender sender = randomSender(random, body, setup, {});
  std::vector<Datagram> stream;
  bool isSaid = false;
  const bool saysItOnce = random.chance(0.5);
  for (const SentMessage& message : sender.sent) {
    if (message.isSkeleton && saysItOnce && std::exchange(isSaid, true)) continue;
    stream.push_back({message.timeUs, message.isSkeleton, false, kTrue, message.payload});
  }
  return stream;
}

class Attack {
 public:
  Attack(std::uint64_t seed, bool isBound)
      : random_(seed),
        body_(randomBody(random_)),
        scene_(randomScene(random_)),
        isBound_(isBound),
        stream_(newSolver(), {SpeakerPolicy().takeoverUs, kConfirmations}),
        adversary_(random_) {
    run_.standpoint = static_cast<Standpoint>(random_.below(3));
    run_.tally.seeds = 1;
  }

  AttackRun run() {
    const std::vector<Datagram> truth = trueStream(random_, body_);
    if (run_.standpoint == Standpoint::Before) sayBefore(truth);
    const bool isOther = run_.standpoint == Standpoint::OtherSenders;
    const int flood = isOther ? 1 + random_.below(20) : 1;
    int sinceForged = 0;
    for (const Datagram& datagram : truth) {
      take(datagram);
      adversary_.read(datagram);
      ++sinceForged;
      if (run_.standpoint == Standpoint::Before || accepted_ < kConfirmations) continue;
      if (!isOther && (sinceForged < kPosesApart || random_.chance(0.5))) continue;
      sinceForged = 0;
      for (int i = random_.below(flood + 1); i >= 0; --i) {
        Datagram forged = adversary_.next(datagram.timeUs);
        if (!isOther) forged.sender = kTrue;
        take(forged);
        if (!isOther) break;
      }
    }
    close();
    return std::move(run_);
  }

 private:
  StreamSolver newSolver() {
    StreamPolicy policy;
    policy.confirmations = kConfirmations;
    return StreamSolver::make(kAvatar, body_.avatar, scene_.scene, {}, policy).value();
  }

  /// It has read the stream of another day, and says a little of its own before the true one.
  void sayBefore(const std::vector<Datagram>& truth) {
    for (const Datagram& datagram : truth) adversary_.read(datagram);
    const std::int64_t firstUs = truth.empty() ? 0 : truth.front().timeUs;
    for (int i = random_.below(kConfirmations - 1); i >= 0; --i) take(adversary_.next(firstUs));
  }

  void take(const Datagram& datagram) {
    const Heard heard{isBound_ ? datagram.sender : kTrue, kEpochUs + datagram.timeUs,
                      datagram.payload};
    Reject reject = Reject::Length;
    if (datagram.isSkeleton) {
      SkeletonMessage message;
      reject = decode(datagram.payload, message);
      if (reject == Reject::None) reject = stream_.take(heard, message, record_);
      hasSkeleton_ = hasSkeleton_ || !datagram.isHostile;
    } else {
      PoseMessage message;
      reject = decode(datagram.payload, message);
      if (reject == Reject::None) reject = stream_.take(heard, message, answer_, record_);
      if (reject == Reject::None) verdicts_.push_back(RecordedStream::verdictsOf(answer_));
    }
    datagram.isHostile ? countHostile(datagram, reject) : countTrue(datagram, reject);
  }

  void countHostile(const Datagram& datagram, Reject reject) {
    ++run_.tally.hostile;
    if (!datagram.isSkeleton && reject == Reject::None) ++run_.tally.hostileAnswered;
  }

  void countTrue(const Datagram& datagram, Reject reject) {
    if (datagram.isSkeleton || !hasSkeleton_) return;
    ++run_.tally.truePoses;
    if (reject == Reject::None) {
      ++accepted_;
      stopped_ = 0;
      return;
    }
    // A replayed pose has been answered already when the true one comes late, not before.
    ++run_.tally.unanswered;
    run_.tally.longestRun = std::max(run_.tally.longestRun, ++stopped_);
    if (stopped_ == mostStopped(run_.standpoint) + 1) {
      run_.violations.push_back("true poses are stopped, the last as " +
                                std::string(toString(reject)));
    }
  }

  void close() {
    for (const RecordedStream::Entry& entry : record_.entries) {
      if (entry.kind == RecordedStream::Kind::Speaker) ++run_.tally.takeovers;
    }
    if (record_.replayedBy(newSolver()) != verdicts_) {
      run_.violations.push_back("the record's replay answers otherwise");
    }
    const StreamCounts& counts = stream_.solver().counts();
    const std::uint64_t most = counts.gaps * static_cast<std::uint64_t>(kMostCountedLost);
    if (counts.lost > most) run_.violations.push_back("the lost poses are poisoned");
  }

  Random random_;
  SimulatedBody body_;
  SimulatedScene scene_;
  bool isBound_;
  BoundStream stream_;
  RecordedStream record_;
  ContactsMessage answer_;
  std::vector<Bytes> verdicts_;
  Adversary adversary_;
  AttackRun run_;
  bool hasSkeleton_ = false;
  int accepted_ = 0;
  std::uint64_t stopped_ = 0;
};

}  // namespace

void AttackTally::add(const AttackTally& other) {
  seeds += other.seeds;
  truePoses += other.truePoses;
  unanswered += other.unanswered;
  longestRun = std::max(longestRun, other.longestRun);
  hostile += other.hostile;
  hostileAnswered += other.hostileAnswered;
  takeovers += other.takeovers;
}

std::uint64_t mostStopped(Standpoint standpoint) {
  return standpoint == Standpoint::OtherSenders ? 0 : 3;
}

AttackRun attack(std::uint64_t seed, bool isBound) {
  return Attack(seed, isBound).run();
}

}  // namespace foretouch::test
