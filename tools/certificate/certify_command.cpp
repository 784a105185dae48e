#include "tools/certificate/certify_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/certificate/certificate_texts.h"
#include "assets/certificate/certificate_writer.h"
#include "assets/json_writer.h"
#include "middleware/query/query.h"
#include "tools/certificate/certify_edges.h"
#include "tools/console.h"
#include "tools/inputs/file_roles.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedCertificate {
  ReplayRequest request;
  AskedEdges edges;
  std::vector<std::string> files;
  std::string folder;
  bool asJson = false;
};

/// Texts of the four files, and what was found.
struct CertifiedClip {
  std::string scene, steps = "foretouch-steps 1\n", proof = "foretouch-certificate 1\n";
  std::int64_t numSteps = 0, clearSteps = 0;  ///< All, and those on which every link is clear.
  CertificateCounts counts;
};

Settings certifySettings(AskedCertificate& asked) {
  Settings settings;
  addSceneSettings(settings, asked.request);
  settings.of("--scene").required();
  addAvatarSetting(settings, asked.request).required();
  addMotionSetting(settings, asked.request, "--motion", "CLIP",
                   "BVH clip, animated model, or joint positions")
      .required();
  addRateSetting(settings, asked.request);
  addClipSettings(settings, asked.request);
  addSkipTPose(settings, asked.request);
  addEdgeSettings(settings, asked.edges, asked.request);
  settings
      .number("--tolerance", "M", asked.request.query.tolerance, kToleranceRange,
              "Largest separation (m) of a contact: links that come nearer have no proof")
      .in(kTouchGroup);
  settings
      .outputFolder("-o,--output", asked.folder,
                    "The folder for scene.obj, avatar.json, steps.txt (or edges.txt) and "
                    "certificate.txt")
      .required();
  settings.asJson(asked.asJson);
  addFilesSetting(settings, asked.files);
  return settings;
}

/// The links that touch nothing on the motion.
std::vector<LinkId> clearLinks(const Avatar& avatar, const StepContacts& answer) {
  std::vector<LinkId> clear;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (avatar.lss(link).empty()) continue;
    if (answer.links[slotOf(link)].verdict == Verdict::Clear) clear.push_back(link);
  }
  return clear;
}

Result<CertifiedClip> certify(const ReplayInputs& inputs, const InterruptGuard& guard) {
  FORETOUCH_TRY(const auto query, Query::build(inputs.avatar, inputs.scene, inputs.query));
  CertifiedClip found;
  CertificateWriter writer(inputs.avatar, inputs.scene);
  ProgressBar progress("certify", inputs.steps.count);
  Scratch scratch;
  ChainMotion motion;
  std::size_t withLss = 0;
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    withLss += inputs.avatar.lss(link).empty() ? 0 : 1;
  }
  FORETOUCH_TRY(auto from, poseAtFrame(inputs, inputs.steps.frameOf(0)));
  for (std::int64_t step = 0; step < inputs.steps.count && !guard.requested(); ++step) {
    FORETOUCH_TRY(auto to, poseAtFrame(inputs, inputs.steps.frameOf(step + 1)));
    motion.assign(inputs.avatar.skeleton(), from, to);
    const std::vector<LinkId> clear = clearLinks(inputs.avatar, query.answer(motion, scratch));
    found.clearSteps += clear.size() == withLss ? 1 : 0;
    found.steps += stepText(step, from, to);
    found.proof += writer.step(step, motion, clear);
    ++found.numSteps;
    from = std::move(to);
    progress.advanceTo(step + 1);
  }
  found.proof += "end\n";
  found.scene = sceneAsObj(inputs.scene);
  found.counts = writer.counts();
  return found;
}

Result<Done> writeCertified(const std::string& folder, const Avatar& avatar,
                            const CertifiedClip& found) {
  return writeTexts(folder, {{"scene.obj", found.scene},
                             {"avatar.json", formatAvatar(avatar)},
                             {"steps.txt", found.steps},
                             {"certificate.txt", found.proof}});
}

std::string certifiedLine(const CertifiedClip& found) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("steps", found.numSteps);
  out.field("clear_steps", found.clearSteps);
  out.field("links", found.counts.links);
  out.field("unproven", found.counts.unproven);
  out.field("lss", found.counts.capsules);
  out.field("spans", found.counts.spans);
  out.field("planes", found.counts.planes);
  out.field("bytes", found.proof.size());
  out.endObject();
  return text + "\n";
}

ExitCode run(const Settings& settings, const AskedCertificate& asked) {
  if (!asked.edges.path.empty()) {
    return certifyEdgesOf(settings, asked.edges, asked.request, asked.folder, asked.asJson);
  }
  FORETOUCH_TRY_OR(failed, const auto inputs, loadReplayInputs(asked.request));
  for (const std::string& remark : remarksOn(inputs)) printNote(remark);
  {
    const InterruptGuard guard;
    FORETOUCH_TRY_OR(failed, const auto found, certify(inputs, guard));
    if (guard.requested()) return ExitCode::BadInput;
    FORETOUCH_CHECK_OR(failed, writeCertified(asked.folder, inputs.avatar, found));
    const std::string& folder = asked.folder;
    printOut(asked.asJson
                 ? certifiedLine(found)
                 : fmt::format("{} clear links on {} steps, {} spans, {} planes, {} bytes\n"
                               "{} clear links have no proof\n\nfor a stranger:\n"
                               "  foretouch-verify {}/scene.obj {}/avatar.json {}/steps.txt "
                               "{}/certificate.txt\n",
                               found.counts.links, found.numSteps, found.counts.spans,
                               found.counts.planes, found.proof.size(), found.counts.unproven,
                               folder, folder, folder, folder));
    return found.counts.unproven == 0 ? ExitCode::Done : ExitCode::CheckSaysNo;
  }
}

constexpr char kCertifyExamples[] = R"(Example:
  foretouch certify --scene room.obj --avatar dancer.avatar.json --motion dancer.bvh --rate 30 \
      --output proof
  foretouch-verify proof/scene.obj proof/avatar.json proof/steps.txt proof/certificate.txt
  foretouch certify --scene cell.obj --scene-up z --robot arm.urdf --edges roadmap.csv \
      --clearance 0.005 --self --ignore base:table --output proof
  foretouch-verify proof/scene.obj proof/avatar.json proof/edges.txt proof/certificate.txt

Only links that touch nothing have something to prove, at link fidelity. Exit code 1: a link is clear,
and no proof of it was found: it comes too near.)";

}  // namespace

Command certifyCommand() {
  const auto asked = std::make_shared<AskedCertificate>();
  Command command{"certify",
                  "Write down why links touch nothing, for anybody to check without this program",
                  kCertifyExamples, certifySettings(*asked)};
  command.run = [asked](const Settings& settings) { return run(settings, *asked); };
  return command;
}

}  // namespace foretouch::tools
