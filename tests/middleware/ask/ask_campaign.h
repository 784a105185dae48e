// tests/middleware/ask/ask_campaign.h: random questions to random worlds, now and then, of every
// kind, each answer held against the judge's own world, part by part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "judge/cast_oracle.h"
#include "middleware/ask/ask.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct AskTally {
  std::map<std::string, int> questions, hits;  ///< By kind; answers with a hit.
  int unknown = 0, ofTriangles = 0, ofLss = 0, starts = 0, ofCarried = 0, filtered = 0, inside = 0,
      open = 0, ofSkins = 0;
  std::int64_t parts = 0;   ///< Looked at.
  oracle::Real widest = 0;  ///< Gap at a reported distance (m).
  std::vector<std::string> problems;

  void add(const AskTally& more);
  /// Says of the problems from that one on whose they are.
  void name(std::size_t from, const std::string& whose);
};

/// One part of a body in W, and whose it is.
struct JudgedPart {
  ContactSide side;
  ObjectId object = kEveryObject;
  oracle::OraclePart part;
  bool isOfSkin = false;  ///< Which has no inside, even if its triangles close.
};

/// Changes what is asked, or what was answered, before it is judged.
struct AskTamper {
  std::function<void(WorldQuestion&)> question;
  std::function<void(WorldAnswer&)> answer;
};

/// So many kinds of questions are there: summaryOf() has their names.
inline constexpr int kAskedKinds = 10;
/// A random world by its seed, and `count` questions of the kinds from `firstKind` on.
[[nodiscard]] AskTally judgeQuestions(std::uint64_t seed, int count, const AskTamper& tamper = {},
                                      int firstKind = 0);

/// The same of flights through a time.
[[nodiscard]] AskTally judgeFlights(std::uint64_t seed, int count,
                                    const std::function<void(FlightQuestion&)>& tamper = {});

/// One line per kind.
[[nodiscard]] std::string summaryOf(const AskTally& tally);

}  // namespace foretouch::test
