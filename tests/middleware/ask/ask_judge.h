// tests/middleware/ask/ask_judge.h: holds one answer against all parts of a world, one by one.
#pragma once

#include <string>
#include <vector>

#include "tests/middleware/ask/ask_campaign.h"

namespace foretouch::test {

/// Refers to both.
class AskJudge {
 public:
  AskJudge(const WorldQuestion& question, const std::vector<JudgedPart>& parts)
      : question_(question), parts_(parts) {}

  /// Appends what is wrong with the hits to the tally's problems.
  void judge(const WorldAnswer& answer, AskTally& tally) const;

 private:
  [[nodiscard]] bool isAsked(const JudgedPart& part) const;
  [[nodiscard]] const JudgedPart* partOf(const WorldHit& hit) const;
  [[nodiscard]] std::string problemOf(const WorldHit& hit, const JudgedPart& part) const;
  [[nodiscard]] std::string problemOfPlace(const WorldHit& hit, const JudgedPart& part) const;
  [[nodiscard]] std::string problemOfOrder(const WorldAnswer& answer) const;
  [[nodiscard]] oracle::CastShape shape() const;

  const WorldQuestion& question_;
  const std::vector<JudgedPart>& parts_;
};

}  // namespace foretouch::test
