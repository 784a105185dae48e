// foretouch-verify SCENE AVATAR STEPS CERTIFICATE [--whole]: proves by interval arithmetic that the
// links which a certificate names touch nothing of a scene on the steps that it names. It shares no
// code with the program that wrote it (docs/certificates.md). --whole: every link with LSS on every
// one of the steps has to be named. Exit code 0: all is proven; 1: not, and the first span that is
// not is named; 2: a file could not be read.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "verify/certificate.h"
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

int refuse(const char* path, long long line, long long step, const std::string& why) {
  std::printf("NOT PROVEN: %s:%lld: step %lld: %s\n", path, line, step, why.c_str());
  return 1;
}

/// Of one step: whether every link with LSS has a claim.
bool isWhole(const std::vector<Link>& links, const StepClaim& claim) {
  std::set<std::size_t> named;
  for (const LinkClaim& link : claim.links) named.insert(link.link);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].capsules.empty() && named.count(i) == 0) return false;
  }
  return true;
}

int run(const char* const* paths, bool asksWhole) {
  std::string texts[4];
  for (int i = 0; i < 4; ++i) {
    if (!readText(paths[i], texts[i])) return 2;
  }
  std::vector<Triangle> triangles;
  std::vector<Link> links;
  std::vector<Step> steps;
  std::vector<StepClaim> claims;
  if (Fault fault = readScene(texts[0], triangles); !fault.what.empty())
    return badFile(paths[0], fault);
  if (Fault fault = readAvatar(texts[1], links); !fault.what.empty())
    return badFile(paths[1], fault);
  if (Fault fault = readSteps(texts[2], links.size(), steps); !fault.what.empty()) {
    return badFile(paths[2], fault);
  }
  if (Fault fault = readCertificate(texts[3], claims); !fault.what.empty())
    return badFile(paths[3], fault);

  const SceneProof scene(std::move(triangles));
  std::map<long long, const Step*> byNumber;
  for (const Step& step : steps) {
    if (!byNumber.emplace(step.number, &step).second) {
      return badFile(paths[2], {0, "step " + std::to_string(step.number) + " is there twice"});
    }
  }
  Tally tally;
  // Honest claims take some ten halvings of rotations per byte.
  constexpr std::size_t kWorkPerByte = 64;
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
  if (tally.links == 0) {
    std::printf("NOT PROVEN: %s:0: it claims nothing\n", paths[3]);
    return 1;
  }
  std::printf(
      "proven: %lld links on %lld steps touch nothing: %lld LSS, %lld spans, %lld planes; %lld "
      "triangles apart by boxes, %lld by planes\n",
      static_cast<long long>(tally.links), static_cast<long long>(tally.steps),
      static_cast<long long>(tally.capsules), static_cast<long long>(tally.spans),
      static_cast<long long>(tally.planes), static_cast<long long>(tally.byBoxes),
      static_cast<long long>(tally.byPlanes));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool asksWhole = argc == 6 && std::string(argv[5]) == "--whole";
  if (argc != 5 && !asksWhole) {
    std::fprintf(stderr, "foretouch-verify: expected SCENE AVATAR STEPS CERTIFICATE [--whole]\n");
    return 2;
  }
  try {
    return run(argv + 1, asksWhole);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "foretouch-verify: stopped: %s\n", e.what());
    return 2;
  }
}
