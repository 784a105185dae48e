#include "tools/commands/replay_log_command.h"

#include <optional>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/console.h"
#include "tools/interrupt.h"
#include "tools/log/log_touches.h"
#include "tools/log/replay_log_summary.h"
#include "tools/progress.h"
#include "tools/report/log_report.h"
#include "tools/report/report_file.h"
#include "tools/results_output.h"
#include "tools/stream/contacts_line.h"
#include "tools/stream/person_text.h"
#include "tools/stream/solid_text.h"

namespace foretouch::tools {

Result<LogReplayReport> runLogReplay(const LogReplayJob& job,
                                     const std::function<void(const std::string&)>& tell) {
  std::vector<std::string> inputPaths{job.request.world.scenePath, job.request.logPath};
  inputPaths.push_back(job.request.world.policyPath);
  for (const NumberedAvatar& avatar : job.request.avatars) inputPaths.push_back(avatar.path);
  inputPaths.push_back(job.request.world.skinPath);
  inputPaths.push_back(job.request.person.boundsPath);
  FORETOUCH_CHECK(checkOutputs(job.outputPath, job.report.path, inputPaths));
  FORETOUCH_TRY(const auto inputs, loadLogReplayInputs(job.request));

  LogReplaySummary summary(inputs);
  LogTouches touches(inputs);
  std::optional<LogReport> report;
  if (!job.report.path.empty()) report.emplace(inputs, job.report);
  const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
  FORETOUCH_TRY(auto file, PendingFile::create(job.outputPath));
  file.write(logHeaderLine(inputs));
  ProgressBar progress("replay", 100);
  auto replayed = replayLog(inputs, [&](const AnsweredPose& answered) {
    file.write(contactsLine(answered.answer, Stamps::Without));
    if (answered.solid != nullptr) file.write(solidLine(*answered.solid, Stamps::Without));
    for (std::size_t i = 0; answered.person != nullptr && i < answered.person->numSaid(); ++i) {
      file.write(personStepLine(answered.person->said(i), Stamps::Without));
    }
    summary.add(answered.answer, answered.avatar);
    touches.add(answered);
    if (report) report->add(answered);
    if (answered.logBytes > 0) {
      progress.advanceTo(
          static_cast<std::int64_t>(100 * answered.positionBytes / answered.logBytes));
    }
    return !guard.requested();
  });
  if (!replayed.ok() || guard.requested()) return replayed;
  for (const std::string& remark : replayed.value().remarks) printNote(remark);
  for (const PersonMessage& said : replayed.value().ended) {
    file.write(personStepLine(said, Stamps::Without));
  }
  touches.finish();
  summary.add(touches.counts());
  file.write(touches.lines());
  FORETOUCH_CHECK(file.commit());
  if (report) {
    const auto reported = writeReport(job.report.path, guard,
                                      [&](const ReportProgress& watch) -> Result<ViewDocument> {
                                        return report->document(replayed.value(), summary, watch);
                                      });
    if (!reported.ok()) return reported.error();
    if (guard.requested()) return replayed;
  }
  tell(summary.text(replayed.value()));
  return replayed;
}

}  // namespace foretouch::tools
