#include "tools/commands/demo_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/audit/audits.h"
#include "tools/commands/open_page.h"
#include "tools/commands/play_clip.h"
#include "tools/commands/solid_replay.h"
#include "tools/inputs/example_folder.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

constexpr double kDemoRateHz = 10.0;

/// The values of all options.
struct AskedDemo {
  std::string output = "foretouch-demo.jsonl", report;
  bool details = false, isSolid = false;
};

/// What every user wants to know.
std::string inWords(const ReplaySummary& summary) {
  // Touches of the room, and of its ground; --details has the rest.
  const std::string headline = summary.headline();
  const std::size_t second = headline.find('\n', headline.find('\n') + 1);
  return fmt::format(
      "The bundled dancer moves through the bundled room, known only {:g} times a second.\n{}",
      kDemoRateHz, headline.substr(0, headline[second - 1] == '\n' ? second : second + 1));
}

/// The first of the contacts that a check of the poses misses.
std::string missedOnes(const ReplaySummary& summary) {
  const ReplayInputs& inputs = summary.inputs();
  std::string text = "\n";
  for (const ReportedContact& missed : summary.firstMissed()) {
    const LinkContact& contact = missed.contact;
    const auto object = static_cast<std::size_t>(inputs.scene.object(contact.triangle));
    text += fmt::format(
        "  at step {} {} met {} at t={:.3f} ({:.3f} s), {:.2f} mm apart; a discrete check at the "
        "two poses saw nothing\n",
        missed.step, inQuotes(inputs.avatar.skeleton().name(contact.link)),
        inQuotes(inputs.scene.objectNames()[object]), contact.toi, missed.timeS,
        1e3 * contact.separation);
  }
  return text;
}

/// What the replay read, and its whole summary.
std::string details(const ReplayJob& job, const ReplaySummary& summary) {
  const ReplayInputs& inputs = summary.inputs();
  const AvatarAudit avatar = auditAvatar(inputs.avatar, restPose(inputs.avatar.skeleton()));
  return "\n" + job.request.scenePath + "\n" + describe(inputs.scene.audit()) + "\n" +
         job.request.avatarPath + "\n" + describe(avatar, "rest pose") + "\n" +
         summary.text(job.threads) + missedOnes(summary);
}

/// The report's path beside the results, if they go to a file.
std::string defaultReport(const std::string& output) {
  namespace fs = std::filesystem;
  std::error_code absent;
  const bool isFile = output != kStandardOutput && !fs::is_other(fs::status(output, absent));
  return (isFile ? fs::path(output) : fs::path("foretouch-demo"))
      .replace_extension(".html")
      .string();
}

/// What every user wants to know about a solid dancer.
std::string inWords(const SolidSummary& summary) {
  constexpr double kMmPerM = 1e3;
  return fmt::format(
      "The bundled dancer moves through the bundled room and passes through nothing: {} of {} ways "
      "from pose to pose are proven to touch nothing (but for the string curtain and the plant, "
      "which "
      "give way).\nSurfaces keep the dancer from the tracked "
      "pose for {:.2g} s, a link by {:.2g} mm in the mean.\n",
      summary.certified(), summary.ticks(), summary.keptS(), kMmPerM * summary.ofAll().mean);
}

/// Every pose of the clip, as a tracker sends them.
ExitCode runSolidDemo(const AskedDemo& asked, const std::string& folder) {
  SolidReplayJob job;
  job.request.scenePath = folder + "/room.obj";
  job.request.avatarPath = folder + "/dancer.avatar.json";
  job.request.motionPath = folder + "/dancer.bvh";
  // People who enter a room push its string curtain and leaves aside.
  job.request.ignore = {"*:string_curtain,*:plant"};
  job.solid.isAsked = true;
  job.outputPath = asked.output;
  job.report.path = asked.report.empty() ? defaultReport(asked.output) : asked.report;
  const bool outIsTaken = isStandardOutput(job.outputPath) || isStandardOutput(job.report.path);
  const auto done = runSolidReplay(job, [&](const SolidSummary& summary) {
    const std::string text = inWords(summary) + "page:    " + job.report.path +
                             "   (open it in a browser)\nresults: " + job.outputPath + "\n" +
                             (asked.details ? "\n" + summary.text() : "");
    outIsTaken ? printAside(text) : printOut(text);
  });
  if (!done.ok()) return failed(done.error());
  offerToOpen(job.report.path);
  return ExitCode::Done;
}

ExitCode runDemo(const AskedDemo& asked) {
  FORETOUCH_TRY_OR(failed, const auto folder, exampleFolder());
  if (asked.isSolid) return runSolidDemo(asked, folder);
  ReplayJob job;
  job.request.scenePath = folder + "/room.obj";
  job.request.avatarPath = folder + "/dancer.avatar.json";
  job.request.motionPath = folder + "/dancer.bvh";
  job.request.rateHz = kDemoRateHz;
  job.outputPath = asked.output;
  job.report.path = asked.report.empty() ? defaultReport(asked.output) : asked.report;
  const bool outIsTaken = isStandardOutput(job.outputPath) || isStandardOutput(job.report.path);
  const auto done =
      runReplay(job, [&](const ReplaySummary& summary, const std::string& /*person*/) {
        const std::string text = inWords(summary) + "page:    " + job.report.path +
                                 "   (open it in a browser)\nresults: " + job.outputPath + "\n" +
                                 (asked.details ? details(job, summary) : "");
        outIsTaken ? printAside(text) : printOut(text);
      });
  if (!done.ok()) return failed(done.error());
  offerToOpen(job.report.path);
  return ExitCode::Done;
}

}  // namespace

Command demoCommand() {
  const auto asked = std::make_shared<AskedDemo>();
  Settings settings;
  settings.output("-o,--output", "FILE", asked->output, "Results, as lines of JSON");
  settings.output("--report", "FILE", asked->report,
                  "The report, a page for a browser; beside the results if not given");
  settings
      .flag("--details", asked->details,
            "Also say what was read, and what every link met, in how much time")
      .in(kOutputGroup);
  settings
      .flag("--solid", asked->isSolid,
            "The dancer passes through nothing: shown poses instead of contacts")
      .in(kOutputGroup);
  Command command{"demo", "Replay the bundled dancer in the bundled room and say what was found",
                  "Examples:\n  foretouch demo\n  foretouch demo --solid", std::move(settings)};
  command.run = [asked](const Settings&) { return runDemo(*asked); };
  return command;
}

}  // namespace foretouch::tools
