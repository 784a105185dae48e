#include "tests/network/stream/stream_simulation.h"

#include <map>
#include <memory>
#include <utility>

#include "network/stream/stream_solver.h"
#include "tests/network/answer_judge.h"
#include "tests/network/broken_rule.h"
#include "tests/network/faulty_network.h"

namespace foretouch::test {
namespace {

struct Faults {
  SenderFaults senders;
  NetworkFaults network;
  double shared = 0.0;   ///< A sender that sends for another's avatar.
  double unknown = 0.0;  ///< A sender of an avatar that nobody told the receiver of.
};

/// Each kind of fault is there in half of the seeds, as often as the draw says.
Faults randomFaults(Random& random) {
  const auto draw = [&](double least, double most) {
    return random.chance(0.5) ? random.magnitude(least, most) : 0.0;
  };
  Faults faults;
  faults.senders.unmatched = draw(0.05, 0.5);
  faults.senders.trackingLost = draw(0.002, 0.1);
  faults.senders.fewJoints = draw(0.05, 0.7);
  faults.senders.badContent = draw(0.005, 0.1);
  faults.senders.restart = draw(0.01, 0.1);
  faults.senders.noSessions = draw(0.2, 1.0);
  faults.senders.clockJump = draw(0.005, 0.1);
  faults.senders.oddStamp = draw(0.005, 0.1);
  faults.senders.pause = draw(0.005, 0.05);
  faults.senders.lateSkeleton = draw(0.2, 1.0);
  faults.senders.changedSkeleton = draw(0.005, 0.1);
  faults.senders.stops = draw(0.1, 0.5);
  faults.network.burst = draw(0.002, 0.02);
  faults.network.duplicate = draw(0.005, 0.3);
  faults.network.delay = draw(0.005, 0.5);
  faults.network.longestDelayUs = static_cast<std::int64_t>(random.magnitude(1e4, 5e6));
  faults.network.corrupt = draw(0.002, 0.1);
  faults.network.truncate = draw(0.002, 0.05);
  faults.network.foreign = draw(0.002, 0.1);
  faults.shared = draw(0.1, 0.5);
  faults.unknown = draw(0.05, 0.2);
  return faults;
}

StreamPolicy randomPolicy(Random& random) {
  StreamPolicy policy;
  policy.maxStepUs = random.chance(0.5) ? 10'000'000 : 1'000'000;
  policy.confirmations = 1 + random.below(5);
  policy.unmatchedAtRest = random.chance(0.3);
  return policy;
}

QueryOptions randomOptions(Random& random) {
  QueryOptions options;
  options.tolerance = random.magnitude(1e-5, 1e-2);
  const bool isLimited = random.chance(0.15);
  const int most = 1 + random.below(1500);
  if (isLimited) options.workBudget = static_cast<std::uint64_t>(most);
  return options;
}

class Simulation {
 public:
  Simulation(std::uint64_t seed, const SimulationOptions& options)
      : random_(seed), mutation_(options.mutation), scene_(randomScene(random_)) {
    const double drawn = kLosses[static_cast<std::size_t>(random_.below(kLosses.size()))];
    run_.loss = options.loss.value_or(drawn);
    run_.isLossAlone = random_.chance(0.5);
    const Faults faults = randomFaults(random_);
    if (!run_.isLossAlone) faults_ = faults;
    faults_.network.loss = run_.loss;
    policy_ = randomPolicy(random_);
    run_.tally.seeds = 1;
  }

  SimulationRun run() {
    addSenders();
    for (auto& [avatar, receiver] : receivers_) receiver.answers.emplace(receiver.judge(*this));
    for (const Delivery& delivery : deliveries(random_, senders_, faults_.network)) {
      delivery.isSkeleton ? takeSkeleton(delivery) : takePose(delivery);
    }
    for (auto& [avatar, receiver] : receivers_) close(receiver);
    return std::move(run_);
  }

 private:
  struct Receiver {
    SimulatedBody body;
    StreamSolver solver;
    BrokenRule rule;
    std::int32_t numJoints = 0;  // of the skeleton in use
    std::uint64_t poses = 0, answered = 0, refusedPoses = 0, refusedSkeletons = 0;
    std::optional<AnswerJudge> answers;
    ContactsMessage answer;

    [[nodiscard]] AnswerJudge judge(Simulation& simulation) const {
      return {body, simulation.scene_, simulation.senders_, simulation.run_};
    }
  };

  void addSenders() {
    const int count = 1 + random_.below(4);
    std::vector<bool> isShared(static_cast<std::size_t>(count) + 1, false);
    for (int i = 1; i < count; ++i) {
      isShared[static_cast<std::size_t>(i)] = random_.chance(faults_.shared);
    }
    std::int32_t avatar = random_.below(100);
    SimulatedBody body = randomBody(random_);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (i > 0 && !isShared[at]) {
        ++avatar;
        body = randomBody(random_);
      }
      const bool isUnknown = random_.chance(faults_.unknown);
      if (!isUnknown && receivers_.count(avatar) == 0) addReceiver(avatar, body);
      SenderSetup setup;
      setup.sender = i;
      setup.avatar = avatar;
      // Two that send for one avatar and say no session are one sender, as far as anyone can tell.
      setup.mayLackSessions = !isShared[at] && !isShared[at + 1];
      setup.unmatchedAtRest = policy_.unmatchedAtRest;
      senders_.push_back(randomSender(random_, body, setup, faults_.senders));
      for (const SentMessage& message : senders_.back().sent) {
        if (!message.isSkeleton) ++run_.tally.posesSent;
      }
    }
  }

  void addReceiver(std::int32_t avatar, const SimulatedBody& body) {
    StreamPolicy policy = policy_;
    if (mutation_ == Mutation::LackingIsAtRest) policy.unmatchedAtRest = true;
    auto solver =
        StreamSolver::make(avatar, body.avatar, scene_.scene, randomOptions(random_), policy);
    receivers_.emplace(avatar, Receiver{body,
                                        std::move(solver).value(),
                                        BrokenRule(mutation_),
                                        0,
                                        0,
                                        0,
                                        0,
                                        0,
                                        std::nullopt,
                                        {}});
  }

  [[nodiscard]] Receiver* receiverOf(std::int32_t avatar) {
    const auto found = receivers_.find(avatar);
    return found == receivers_.end() ? nullptr : &found->second;
  }

  void count(Reject reject) { ++run_.tally.rejects[static_cast<std::size_t>(reject)]; }

  void takeSkeleton(const Delivery& delivery) {
    SkeletonMessage message;
    Reject reject = decode(delivery.payload, message);
    if (reject == Reject::None) {
      Receiver* const receiver = receiverOf(message.avatar);
      reject = receiver == nullptr ? Reject::UnknownAvatar : receiver->solver.take(message);
      if (receiver != nullptr && reject != Reject::None) ++receiver->refusedSkeletons;
      if (receiver != nullptr && reject == Reject::None) {
        receiver->numJoints = static_cast<std::int32_t>(message.skeleton.joints.size());
      }
    }
    if (reject != Reject::None) count(reject);
  }

  void takePose(const Delivery& delivery) {
    if (delivery.id.sender >= 0) ++run_.tally.posesArrived;
    PoseMessage message;
    Reject reject = decode(delivery.payload, message);
    if (reject == Reject::None) {
      Receiver* const receiver = receiverOf(message.avatar);
      reject = receiver == nullptr ? Reject::UnknownAvatar : answer(*receiver, delivery, message);
    }
    if (reject != Reject::None) count(reject);
  }

  [[nodiscard]] Reject answer(Receiver& receiver, const Delivery& delivery, PoseMessage& message) {
    ++receiver.poses;
    const Reject reject = receiver.rule.take(receiver.solver, delivery.id, receiver.numJoints,
                                             message, receiver.answer);
    if (reject != Reject::None) {
      ++receiver.refusedPoses;
      return reject;
    }
    ++receiver.answered;
    receiver.answers->judge({delivery.id, delivery.isAltered, message.sequence, message.utimeUs},
                            receiver.answer);
    return Reject::None;
  }

  /// The counts add up.
  void close(const Receiver& receiver) {
    const StreamCounts& counts = receiver.solver.counts();
    std::uint64_t rejects = 0;
    for (const std::uint64_t count : counts.rejects) rejects += count;
    if (counts.poses != receiver.poses || counts.accepted != receiver.answered ||
        counts.poses != counts.accepted + receiver.refusedPoses ||
        rejects != receiver.refusedPoses + receiver.refusedSkeletons) {
      run_.violations.push_back("avatar " + std::to_string(receiver.solver.id()) +
                                ": the counts do not add up");
    }
  }

  Random random_;
  Mutation mutation_;
  SimulatedScene scene_;
  Faults faults_;
  StreamPolicy policy_;
  SimulationRun run_;
  std::vector<SimulatedSender> senders_;
  std::map<std::int32_t, Receiver> receivers_;
};

}  // namespace

const char* toString(Mutation mutation) {
  switch (mutation) {
    case Mutation::None: return "none";
    case Mutation::GapsAreSteps: return "gaps-are-steps";
    case Mutation::InvalidIsValid: return "invalid-is-valid";
    case Mutation::StaleIsTracked: return "stale-is-tracked";
    case Mutation::MissingIsAtRest: return "missing-is-at-rest";
    case Mutation::LackingIsAtRest: return "lacking-is-at-rest";
    case Mutation::RestartsAreSteps: return "restarts-are-steps";
    case Mutation::CopiesAreNew: return "copies-are-new";
    case Mutation::ContactsAreLate: return "contacts-are-late";
    case Mutation::LastIsForgotten: return "last-is-forgotten";
  }
  return "none";
}

void SimulationTally::add(const SimulationTally& other) {
  seeds += other.seeds;
  posesSent += other.posesSent;
  posesArrived += other.posesArrived;
  answered += other.answered;
  gaps += other.gaps;
  timelines += other.timelines;
  alteredAnswered += other.alteredAnswered;
  unknowable += other.unknowable;
  judged += other.judged;
  unproved += other.unproved;
  for (std::size_t i = 0; i < rejects.size(); ++i) rejects[i] += other.rejects[i];
  for (std::size_t i = 0; i < verdicts.size(); ++i) verdicts[i] += other.verdicts[i];
  for (std::size_t i = 0; i < reasons.size(); ++i) reasons[i] += other.reasons[i];
}

std::uint64_t SimulationTally::linkSteps() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : verdicts) sum += count;
  return sum;
}

SimulationRun simulate(std::uint64_t seed, const SimulationOptions& options) {
  return Simulation(seed, options).run();
}

}  // namespace foretouch::test
