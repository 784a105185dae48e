#include "tests/fuzz/certificate_inputs.h"

#include <cstdlib>
#include <string_view>
#include <vector>

#include "verify/certificate.h"
#include "verify/proof.h"

namespace foretouch::fuzz {
namespace {

void mustHold(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

bool feedCertificate(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<verify::StepClaim> claims;
  if (!verify::readCertificate(text, claims).what.empty()) return false;
  // Link 0 passes through the wall, link 1 does not.
  const std::vector<verify::Triangle> wall{
      {{verify::Vector{0.5, -5, -5}, verify::Vector{0.5, 5, -5}, verify::Vector{0.5, 0, 9}}}};
  std::vector<verify::Link> links(2);
  links[0].capsules.push_back({{0, 0, 0}, {0, 0.1, 0}, 0.1});
  links[1].capsules.push_back({{0, 0, 0}, {0, 0, 0}, 0.1});
  verify::Step step;
  step.from = {{{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
  step.to = {{{1, 0, 0}, {1, 0, 0, 0}}, {{0, 0.2, 0}, {1, 0, 0, 0}}};
  const verify::SceneProof scene(wall);
  bool isProven = false;
  for (const verify::StepClaim& claim : claims) {
    verify::Motion motion(links, step);
    verify::Tally tally;
    if (!scene.prove(links, claim, motion, tally).what.empty()) continue;
    isProven = true;
    for (const verify::LinkClaim& link : claim.links) mustHold(link.link == 1);
  }
  return isProven;
}

}  // namespace foretouch::fuzz
