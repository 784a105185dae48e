// verify/certificate.h: the format "foretouch-certificate" version 1, as text and as what it says.
#pragma once

#include <cstdint>
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
  std::size_t capsule = 0;  ///< Of its link.
  std::vector<Span> spans;
  long long line = 0;
};

/// The link is clear of the whole scene at every instant of the step.
struct LinkClaim {
  std::size_t link = 0;
  std::vector<CapsuleClaim> capsules;
  long long line = 0;
};

struct StepClaim {
  long long step = 0;
  std::vector<LinkClaim> links;
  long long line = 0;
};

inline constexpr int kDeepestLevel = 40;

[[nodiscard]] Fault readCertificate(std::string_view text, std::vector<StepClaim>& claims);

}  // namespace verify
