#include "tools/commands/demo_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/audit/audits.h"
#include "tools/commands/replay_command.h"
#include "tools/inputs/example_folder.h"

namespace foretouch::tools {
namespace {

constexpr double kDemoRateHz = 10.0;

std::string inWords(const ReplaySummary& summary) {
  const ReplayInputs& inputs = summary.inputs();
  std::string text = fmt::format(
      "\nIn plain words: the dancer is known only {:g} times a second. Foretouch followed the "
      "motion\n"
      "in between and found {} first contacts; looking at the poses alone would have missed {}.\n",
      kDemoRateHz, summary.total().contacts, summary.total().missedByPoses);
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

/// Beside the results, if they go to a file.
std::string defaultReport(const std::string& output) {
  namespace fs = std::filesystem;
  std::error_code absent;
  const bool isFile = !fs::is_other(fs::status(output, absent));
  return (isFile ? fs::path(output) : fs::path("foretouch-demo"))
      .replace_extension(".html")
      .string();
}

ExitCode runDemo(const std::string& output, const std::string& report) {
  FORETOUCH_TRY_OR(failed, const auto folder, exampleFolder());
  ReplayJob job;
  job.request.scenePath = folder + "/room.obj";
  job.request.avatarPath = folder + "/dancer.avatar.json";
  job.request.motionPath = folder + "/dancer.bvh";
  job.request.rateHz = kDemoRateHz;
  job.outputPath = output;
  job.report.path = report.empty() ? defaultReport(output) : report;
  job.options.compareRigid = true;
  job.options.rays = true;
  const auto done = runReplay(job, [&](const ReplaySummary& summary) {
    const ReplayInputs& inputs = summary.inputs();
    const AvatarAudit avatar = auditAvatar(inputs.avatar, restPose(inputs.avatar.skeleton()));
    printOut(job.request.scenePath + "\n" + describe(inputs.scene.audit()) + "\n" +
             job.request.avatarPath + "\n" + describe(avatar, "rest pose") + "\n" +
             summary.text(job.options.threads) + inWords(summary) + "\nresults: " + output +
             "\nreport:  " + job.report.path + "\n");
  });
  return done.ok() ? ExitCode::Done : failed(done.error());
}

}  // namespace

Command demoCommand() {
  const auto output = std::make_shared<std::string>("foretouch-demo.jsonl");
  const auto report = std::make_shared<std::string>();
  Settings settings;
  settings.path("-o,--output", "FILE", *output, "Results, as lines of JSON");
  settings.path("--report", "FILE", *report,
                "The report, a page for a browser; beside the results if not given");
  Command command{"demo", "Replay the bundled dancer in the bundled room and say what was found",
                  "Example:\n  foretouch demo", std::move(settings)};
  command.run = [output, report](const Settings&) { return runDemo(*output, *report); };
  return command;
}

}  // namespace foretouch::tools
