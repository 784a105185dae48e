#include "tests/fuzz/certificate_inputs.h"

#include <cstdlib>
#include <string_view>
#include <vector>

#include "verify/certificate.h"
#include "verify/edge_proof.h"
#include "verify/edges.h"
#include "verify/proof.h"

namespace foretouch::fuzz {
namespace {

void mustHold(bool condition) {
  if (!condition) std::abort();
}

/// Link 0 runs through the wall and away from link 1: nothing of it is proven, unless it may touch
/// the wall.
bool feedEdgeClaims(const std::vector<verify::StepClaim>& claims, const verify::SceneProof& scene,
                    const std::vector<verify::Link>& links) {
  verify::EdgeStatement statement;
  statement.coordinates = 1;
  statement.joints.resize(2);
  statement.ignored.resize(2);
  statement.joints[0].shifts.push_back({{1, 0, 0}, 0, 1.0, 0.0});
  statement.pairs.emplace_back(0, 1);
  statement.edges.push_back({0, {0.3}, {1.0}});
  const auto isProven = [&](const verify::StepClaim& claim) {
    verify::Motion motion(links, statement, statement.edges.front());
    verify::Tally tally;
    return verify::EdgeProof(scene, links, statement).prove(claim, motion, tally).what.empty();
  };
  bool isAny = false;
  for (const verify::StepClaim& claim : claims) {
    if (!claim.verdict.empty()) continue;
    mustHold(!isProven(claim));
    statement.ignored[0].push_back({0, 1});
    isAny = isProven(claim) || isAny;
    statement.ignored[0].clear();
  }
  return isAny;
}

/// What is read says nothing beyond the format.
bool feedEdges(std::string_view text) {
  std::vector<verify::Link> links(3);
  for (verify::Link& link : links) link.hasRest = true;
  links[0].capsules.push_back({{0, 0, 0}, {0, 0, 0}, 0.1});
  links[2].capsules = links[0].capsules;
  verify::EdgeStatement statement;
  if (!verify::readEdges(text, links, 7, statement).what.empty()) return false;
  mustHold(statement.joints.size() == links.size() && statement.clearance >= 0.0);
  mustHold(statement.ignored.size() == links.size());
  for (const auto& ofLink : statement.ignored) {
    std::size_t before = 0;
    for (const verify::Ignored& ignored : ofLink) {
      mustHold(ignored.first >= before && ignored.first < ignored.end && ignored.end <= 7);
      before = ignored.end + 1;
    }
  }
  for (const auto& [a, b] : statement.pairs) mustHold(a == 0 && b == 2);
  for (const verify::Edge& edge : statement.edges) {
    mustHold(edge.from.size() == statement.coordinates && edge.to.size() == edge.from.size());
    verify::Motion motion(links, statement, edge);
    static_cast<void>(motion.at(3, 5, 2));
  }
  return true;
}

}  // namespace

bool feedCertificate(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (verify::isOfEdges(text)) return feedEdges(text);
  std::vector<verify::StepClaim> claims;
  const bool isOfEdges = !verify::readCertificate(text, claims).what.empty();
  if (isOfEdges) {
    claims.clear();
    if (!verify::readCertificate(text, claims, verify::kOfEdges).what.empty()) return false;
  }
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
  if (isOfEdges) return feedEdgeClaims(claims, scene, links);
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
