// verify/certificate.h: the format "foretouch-certificate", as text and as what it says: version 1
// for steps, version 2 for a robot's edges.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verify/statement.h"

namespace verify {

/// The points x with normal . x <= offset are on the scene's side; its length does not matter.
struct Plane {
  Point normal;
  double offset;
};

/// t in [index, index + 1] / 2^level.
struct Span {
  int level = 0;
  std::int64_t index = 0;
  std::vector<Plane> planes;
  long long line = 0;
};

struct CapsuleClaim {
  std::size_t capsule = 0;  ///< Among its link's.
  std::vector<Span> spans;
  long long line = 0;
};

/// The link is clear of the whole scene at every instant of the step.
struct LinkClaim {
  std::size_t link = 0;
  std::vector<CapsuleClaim> capsules;
  long long line = 0;
};

/// Two own links keep apart at every instant of the edge. Each span's planes stand between the two:
/// `a` in front of them, `b` behind, in the frame of the nearest link that carries both.
struct PairClaim {
  std::size_t a = 0, b = 0;
  std::vector<Span> spans;
  long long line = 0;
};

/// The claims about a step, or about an edge.
struct StepClaim {
  long long step = 0;
  std::string verdict;  ///< For an edge without claims: why not.
  std::vector<LinkClaim> links;
  std::vector<PairClaim> pairs;  ///< For an edge.
  long long line = 0;
};

inline constexpr int kDeepestLevel = 40;

/// The format's versions: a reader of one refuses the other.
inline constexpr int kOfSteps = 1, kOfEdges = 2;

[[nodiscard]] Fault readCertificate(std::string_view text, std::vector<StepClaim>& claims,
                                    int version = kOfSteps);

}  // namespace verify
