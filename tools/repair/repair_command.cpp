#include "tools/repair/repair_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/feet/feet_command.h"
#include "tools/inputs/file_roles.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/repair/repair.h"
#include "tools/repair/repair_text.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct RepairJob {
  RepairRequest request;
  std::vector<std::string> files;
  std::string output;
  bool asJson = false;
};

Result<ExitCode> runRepair(const RepairJob& job) {
  const RepairRequest& request = job.request;
  FORETOUCH_CHECK(
      checkOutput(job.output, {request.scenePath, request.avatarPath, request.motionPath,
                               request.robotPath, request.mapPath, request.pairsPath}));
  FORETOUCH_TRY(auto stage, RepairStage::load(request));
  for (const std::string& remark : remarksOn(stage.feet())) printNote(remark);
  std::string text;
  bool isWhole = false;
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    ProgressBar progress("repair", kMostTries * kMostRounds);
    FORETOUCH_TRY(const auto repair, repaired(stage, [&](std::int32_t round) {
                    progress.advanceTo(round);
                    return !guard.requested();
                  }));
    if (guard.requested()) return ExitCode::Done;
    FORETOUCH_TRY(auto file, PendingFile::create(job.output));
    file.write(repair.bytes);
    FORETOUCH_CHECK(file.commit());
    isWhole = repair.after.faulty == 0;
    text = job.asJson ? repairJson(stage, repair) : repairText(stage, repair);
  }
  isStandardOutput(job.output) ? printAside(text) : printOut(text);
  return isWhole ? ExitCode::Done : ExitCode::CheckSaysNo;
}

constexpr char kRepairExamples[] = R"(Examples:
  foretouch repair walk.bvh -o mended.bvh --clip-scale 0.01 --ground fit
  foretouch repair dance.bvh dancer.avatar.json room.obj --place 1.5,0,-2,90 --self -o mended.bvh
  foretouch repair walk1_subject1.csv --robot g1.urdf --columns lafan1-g1 -o mended.csv --json

Makes the least smooth change after which nothing touches between two poses, feet that rest do not
slide, and a robot's joints keep their limits. Every interval of what was written is asked again:
exit code 0 says that all are proven free, 1 that the report names some that are not. How, and what
counts: docs/repair.md.)";

}  // namespace

Command repairCommand() {
  const auto job = std::make_shared<RepairJob>();
  RepairRequest& request = job->request;
  Settings settings;
  addFeetSettings(settings, request);
  addSelfSettings(settings, request);
  settings.list("--ignore", "PAIRS", request.ignore, "Contacts to ignore; may be repeated")
      .in(kTouchGroup);
  settings
      .number("--gap", "M", request.gap, NumberRange{1e-5, 0.02, "metres", "m"},
              "What touched is moved so far apart (m), and feet rest so far above the ground")
      .in(kTouchGroup);
  settings
      .number("--most-slide", "M", request.mostSlide, NumberRange{0.0, 10.0, "metres", "m", true},
              "A foot that moves farther while it touches (m) means to, and is left as it is")
      .in(kTouchGroup);
  settings
      .output("-o,--output", "FILE", job->output,
              "The mended clip, in the format of the clip that is read")
      .required()
      .in(kOutputGroup);
  settings.asJson(job->asJson);
  addFilesSetting(settings, job->files);
  Command command{"repair", "Mend a clip: nothing touches between poses, and feet do not slide",
                  kRepairExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) {
    const auto done = runRepair(*job);
    return done.ok() ? done.value() : failed(done.error());
  };
  return command;
}

}  // namespace foretouch::tools
