#include "tools/replay/replay_log_command.h"

#include <utility>
#include <vector>

#include "articulated/text_file.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/replay/replay_log_summary.h"
#include "tools/replay/results_output.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {

Result<LogReplayReport> runLogReplay(const LogReplayJob& job,
                                     const std::function<void(const std::string&)>& report) {
  std::vector<std::string> inputPaths{job.request.query.scenePath, job.request.query.motionPath};
  inputPaths.push_back(job.request.query.policyPath);
  for (const NumberedAvatar& avatar : job.request.avatars) inputPaths.push_back(avatar.path);
  const auto checked = checkOutput(job.outputPath, inputPaths);
  if (!checked.ok()) return checked.error();
  const auto inputs = loadLogReplayInputs(job.request);
  if (!inputs.ok()) return inputs.error();

  LogReplaySummary summary(inputs.value());
  const InterruptGuard guard;  // first built, last gone: the file goes before the signal comes
  auto file = PendingFile::create(job.outputPath);
  if (!file.ok()) return file.error();
  file.value().write(logHeaderLine(inputs.value()));
  ProgressBar progress("replay", 100);
  auto replayed = replayLog(inputs.value(), [&](const ContactsMessage& answer, std::size_t avatar,
                                                std::uint64_t position, std::uint64_t size) {
    file.value().write(contactsLine(answer, Stamps::Without));
    summary.add(answer, avatar);
    if (size > 0) progress.advanceTo(static_cast<std::int64_t>(100 * position / size));
    return !guard.requested();
  });
  if (!replayed.ok() || guard.requested()) return replayed;
  const auto written = file.value().commit();
  if (!written.ok()) return written.error();
  report(summary.text(replayed.value()));
  return replayed;
}

}  // namespace foretouch::tools
