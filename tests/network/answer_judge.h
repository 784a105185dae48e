// tests/network/answer_judge.h: compares the answers to one avatar's stream with the truth. Shares
// no rule with the stream: it knows the true pose behind each message.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "judge/judge.h"
#include "network/wire/messages.h"
#include "tests/network/simulated_sender.h"
#include "tests/network/simulated_world.h"
#include "tests/network/stream/stream_simulation.h"

namespace foretouch::test {

/// An accepted pose: as the solver got it, and its origin.
struct HandedPose {
  PoseId id;
  bool isAltered = false;
  std::int64_t sequence = 0, utimeUs = 0;
};

/// Its arguments must outlive it.
class AnswerJudge {
 public:
  AnswerJudge(const SimulatedBody& body, const SimulatedScene& scene,
              const std::vector<SimulatedSender>& senders, SimulationRun& run)
      : body_(body), scene_(scene), senders_(senders), run_(run) {}

  /// Call for each accepted pose, in order.
  void judge(const HandedPose& pose, const ContactsMessage& answer);

 private:
  void checkForm(const HandedPose& pose, const ContactsMessage& answer);
  void checkPlace(const HandedPose& pose, const ContactsMessage& answer);
  [[nodiscard]] bool canJudge(const HandedPose& pose, const ContactsMessage& answer);
  void judgeLinks(const HandedPose& pose, const ContactsMessage& answer);
  void judgeLink(const LinkContact& contact, const ContactsMessage& answer,
                 const oracle::Motion& motion);
  void judgeClear(LinkId link, const ContactsMessage& answer,
                  const std::vector<oracle::Motion>& truth);
  [[nodiscard]] oracle::Judgement judgement(const LinkContact& contact, double tolerance,
                                            const oracle::Motion& motion) const;
  void record(const oracle::Judgement& judgement, LinkId link, const ContactsMessage& answer);
  void violation(const ContactsMessage& answer, const std::string& what);
  [[nodiscard]] const Pose& truth(const PoseId& id) const;

  const SimulatedBody& body_;
  const SimulatedScene& scene_;
  const std::vector<SimulatedSender>& senders_;
  SimulationRun& run_;
  std::set<PoseId> answered_;
  bool hasLast_ = false;
  HandedPose last_;
};

}  // namespace foretouch::test
