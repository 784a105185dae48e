// foretouch-verify SCENE AVATAR STEPS CERTIFICATE [--whole]: proves by interval arithmetic that the
// links which a certificate names touch nothing of a scene on the steps that it names. With a file
// of a robot's EDGES in place of STEPS: that the robot keeps its clearance on the edges that it
// claims. It shares no code with the program that wrote it (docs/certificates.md). --whole: every
// link with LSS on every one of the steps has to be named, or every edge claimed. Exit code 0: all
// is proven; 1: not, and the first span that is not is named; 2: a file could not be read.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "verify/certificate.h"
#include "verify/edge_proof.h"
#include "verify/edges.h"
#include "verify/proof.h"

namespace {

using namespace verify;

int badFile(const char* path, const Fault& fault) {
  std::fprintf(stderr, "foretouch-verify: %s:%lld: %s\n", path, fault.line, fault.what.c_str());
  return 2;
}

bool readText(const char* path, std::string& text) {
  // A pipe, or a device, has no end.
  if (!std::filesystem::is_regular_file(path)) {
    std::fprintf(stderr, "foretouch-verify: %s: expected a file\n", path);
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream all;
  if (!file || !(all << file.rdbuf())) {
    std::fprintf(stderr, "foretouch-verify: %s: cannot be read\n", path);
    return false;
  }
  text = all.str();
  return true;
}

int refuse(const char* path, long long line, long long step, const std::string& why,
           const char* kind = "step") {
  std::printf("NOT PROVEN: %s:%lld: %s %lld: %s\n", path, line, kind, step, why.c_str());
  return 1;
}

int refuseEmpty(const char* path) {
  std::printf("NOT PROVEN: %s:0: it claims nothing\n", path);
  return 1;
}

/// Honest claims take some ten halvings of rotations per byte.
constexpr std::size_t kWorkPerByte = 64;

/// Whether every link with LSS has a claim about this step.
bool isWhole(const std::vector<Link>& links, const StepClaim& claim) {
  std::set<std::size_t> named;
  for (const LinkClaim& link : claim.links) named.insert(link.link);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].capsules.empty() && named.count(i) == 0) return false;
  }
  return true;
}

/// Precondition: scene and avatar are read.
int runSteps(const char* const* paths, const std::string* texts, const std::vector<Link>& links,
             const SceneProof& scene, bool asksWhole) {
  std::vector<Step> steps;
  std::vector<StepClaim> claims;
  if (Fault fault = readSteps(texts[2], links.size(), steps); !fault.what.empty()) {
    return badFile(paths[2], fault);
  }
  if (Fault fault = readCertificate(texts[3], claims); !fault.what.empty())
    return badFile(paths[3], fault);

  std::map<long long, const Step*> byNumber;
  for (const Step& step : steps) {
    if (!byNumber.emplace(step.number, &step).second) {
      return badFile(paths[2], {0, "step " + std::to_string(step.number) + " is there twice"});
    }
  }
  Tally tally;
  std::size_t work = Motion::kMostWork + kWorkPerByte * texts[3].size();
  std::set<long long> wholly;
  for (const StepClaim& claim : claims) {
    const auto step = byNumber.find(claim.step);
    if (step == byNumber.end()) {
      return refuse(paths[3], claim.line, claim.step, "is none of the steps");
    }
    Motion motion(links, *step->second, work);
    const Fault fault = scene.prove(links, claim, motion, tally);
    if (!fault.what.empty()) return refuse(paths[3], fault.line, claim.step, fault.what);
    if (isWhole(links, claim)) wholly.insert(claim.step);
    work -= motion.work();
  }
  if (asksWhole && wholly.size() != steps.size()) {
    return refuse(paths[3], 0, steps.front().number,
                  "only " + std::to_string(wholly.size()) + " of " + std::to_string(steps.size()) +
                      " steps are claimed with every link");
  }
  if (tally.links == 0) return refuseEmpty(paths[3]);
  std::printf(
      "proven: %lld links on %lld steps touch nothing: %lld LSS, %lld spans, %lld planes; %lld "
      "triangles apart by boxes, %lld by planes\n",
      static_cast<long long>(tally.links), static_cast<long long>(tally.steps),
      static_cast<long long>(tally.capsules), static_cast<long long>(tally.spans),
      static_cast<long long>(tally.planes), static_cast<long long>(tally.byBoxes),
      static_cast<long long>(tally.byPlanes));
  return 0;
}

/// Prints what is proven of the edges that are claimed, and for the others why they are not.
void printEdges(const EdgeStatement& statement, const std::vector<StepClaim>& claims,
                const Tally& tally) {
  std::printf(
      "proven: %lld of %zu edges keep more than %.17g m away from the scene%s: %lld links, %lld "
      "pairs of own links, %lld spans, %lld planes\n",
      static_cast<long long>(tally.steps), statement.edges.size(), statement.clearance,
      statement.pairs.empty() ? "" : ", and their asked pairs of own links from each other",
      static_cast<long long>(tally.links), static_cast<long long>(tally.pairs),
      static_cast<long long>(tally.spans), static_cast<long long>(tally.planes));
  for (const StepClaim& claim : claims) {
    if (!claim.verdict.empty()) {
      std::printf("not claimed: edge %lld: %s\n", claim.step, claim.verdict.c_str());
    }
  }
}

int runEdges(const char* const* paths, const std::string* texts, const std::vector<Link>& links,
             const SceneProof& scene, bool asksWhole) {
  EdgeStatement statement;
  std::vector<StepClaim> claims;
  if (Fault fault = readEdges(texts[2], links, scene.size(), statement); !fault.what.empty()) {
    return badFile(paths[2], fault);
  }
  if (Fault fault = readCertificate(texts[3], claims, kOfEdges); !fault.what.empty()) {
    return badFile(paths[3], fault);
  }
  std::map<long long, const Edge*> open;
  for (const Edge& edge : statement.edges) open.emplace(edge.number, &edge);
  const EdgeProof proof(scene, links, statement);
  Tally tally;
  std::size_t work = Motion::kMostWork + kWorkPerByte * texts[3].size();
  const auto no = [&](const StepClaim& claim, long long line, const std::string& why) {
    return refuse(paths[3], line, claim.step, why, "edge");
  };
  for (const StepClaim& claim : claims) {
    const auto edge = open.find(claim.step);
    if (edge == open.end()) return no(claim, claim.line, "is none of the edges, or there twice");
    if (claim.verdict.empty()) {
      Motion motion(links, statement, *edge->second, work);
      const Fault fault = proof.prove(claim, motion, tally);
      if (!fault.what.empty()) return no(claim, fault.line, fault.what);
      work -= motion.work();
    } else if (asksWhole) {
      return no(claim, claim.line, "is not claimed: " + claim.verdict);
    }
    open.erase(edge);
  }
  if (!open.empty()) {
    return refuse(paths[3], 0, open.begin()->first, "is neither claimed nor said not to be",
                  "edge");
  }
  if (tally.steps == 0) return refuseEmpty(paths[3]);
  printEdges(statement, claims, tally);
  return 0;
}

int run(const char* const* paths, bool asksWhole) {
  std::string texts[4];
  for (int i = 0; i < 4; ++i) {
    if (!readText(paths[i], texts[i])) return 2;
  }
  std::vector<Triangle> triangles;
  std::vector<Link> links;
  if (Fault fault = readScene(texts[0], triangles); !fault.what.empty()) {
    return badFile(paths[0], fault);
  }
  if (Fault fault = readAvatar(texts[1], links); !fault.what.empty()) {
    return badFile(paths[1], fault);
  }
  const SceneProof scene(std::move(triangles));
  return isOfEdges(texts[2]) ? runEdges(paths, texts, links, scene, asksWhole)
                             : runSteps(paths, texts, links, scene, asksWhole);
}

}  // namespace

int main(int argc, char** argv) {
  const bool asksWhole = argc == 6 && std::string(argv[5]) == "--whole";
  if (argc != 5 && !asksWhole) {
    std::fprintf(stderr,
                 "foretouch-verify: expected SCENE AVATAR STEPS|EDGES CERTIFICATE [--whole]\n");
    return 2;
  }
  try {
    return run(argv + 1, asksWhole);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "foretouch-verify: stopped: %s\n", e.what());
    return 2;
  }
}
