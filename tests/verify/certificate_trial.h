// tests/verify/certificate_trial.h: random edges of an arm among triangles; the clear ones are
// certified and verified, and lies about them told to the verifier.
#pragma once

#include <cstdint>
#include <string>

namespace foretouch::test {

struct CertificateTally {
  std::int64_t edges = 0;  ///< Random ones, of which `clear` are.
  std::int64_t clear = 0, unproven = 0, verified = 0;
  std::int64_t lies = 0, believed = 0;
  std::int64_t ofKind[8] = {};  ///< Lies, by kindOfLie().
  std::int64_t spans = 0, planes = 0, bytes = 0;
  double answerS = 0.0, writeS = 0.0, verifyS = 0.0;
};

[[nodiscard]] const char* kindOfLie(int kind);

/// The edge of this seed; `lies`: told about it where it is clear. Empty, or what was broken: a
/// certificate that is not proven, or a lie that is.
[[nodiscard]] std::string runCertificateTrial(std::uint64_t seed, int lies,
                                              CertificateTally& tally);

}  // namespace foretouch::test
