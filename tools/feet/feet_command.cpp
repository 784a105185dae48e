#include "tools/feet/feet_command.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/feet/feet_labels.h"
#include "tools/feet/feet_plot.h"
#include "tools/feet/feet_text.h"
#include "tools/feet/stances.h"
#include "tools/inputs/file_roles.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct FeetJob {
  FeetRequest request;
  std::vector<std::string> files;
  std::string output, labels, plot;  ///< Empty: none.
  bool asJson = false;
};

/// Checks the job before any work.
Result<Done> check(const FeetJob& job) {
  const FeetRequest& request = job.request;
  if (!job.labels.empty()) FORETOUCH_CHECK(labelFormatOf(job.labels));
  std::vector<std::string> taken;
  for (const std::string& output : {job.output, job.labels, job.plot}) {
    if (output.empty()) continue;
    FORETOUCH_CHECK(checkOutput(output, {request.scenePath, request.avatarPath, request.motionPath,
                                         request.robotPath, request.mapPath}));
    for (const std::string& other : taken) {
      if (!isSameFile(output, other)) continue;
      return Error::in(output, ErrorCode::FileUnwritable,
                       "is to hold another output as well; expected a file for each");
    }
    taken.push_back(output);
  }
  return Done{};
}

/// Writes nothing if there is no path.
Result<Done> writeWhole(const std::string& path, const std::string& text) {
  if (path.empty()) return Done{};
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

Result<Done> writeAll(const FeetJob& job, const FeetInputs& inputs, const FeetAnswer& answer) {
  if (!job.output.empty()) FORETOUCH_CHECK(writeWhole(job.output, feetCsv(inputs, answer)));
  if (!job.plot.empty()) FORETOUCH_CHECK(writeWhole(job.plot, feetPage(inputs, answer)));
  if (job.labels.empty()) return Done{};
  FORETOUCH_TRY(const LabelFormat format, labelFormatOf(job.labels));
  FORETOUCH_TRY(auto file, PendingFile::create(job.labels));
  FORETOUCH_CHECK(
      writeLabels(inputs, answer, format, [&](const std::string& text) { file.write(text); }));
  return file.commit();
}

std::string placesOf(const FeetJob& job) {
  std::string text;
  const auto add = [&](const char* name, const std::string& path) {
    if (!path.empty()) text += name + path + "\n";
  };
  add("stances: ", job.output);
  add("labels:  ", job.labels);
  add("plot:    ", job.plot);
  return text.empty() ? text : "\n" + text;
}

bool hasGround(const FeetAnswer& answer) {
  return std::any_of(answer.samples.begin(), answer.samples.end(),
                     [](const PartSample& sample) { return !std::isnan(sample.height); });
}

Result<Done> runFeet(const FeetJob& job) {
  FORETOUCH_CHECK(check(job));
  FORETOUCH_TRY(const auto inputs, loadFeetInputs(job.request));
  for (const std::string& remark : remarksOn(inputs)) printNote(remark);
  std::string text;
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    ProgressBar progress("feet", inputs.steps());
    FORETOUCH_TRY(const auto answer, stancesOf(inputs, [&](std::int64_t step) {
                    progress.advanceTo(step);
                    return !guard.requested();
                  }));
    if (guard.requested()) return Done{};
    if (!hasGround(answer)) {
      printNote(
          "there is no ground below the feet at any pose; --place X,Y,Z,YAW puts the body "
          "elsewhere");
    }
    FORETOUCH_CHECK(writeAll(job, inputs, answer));
    text = job.asJson ? feetJson(inputs, answer) : feetText(inputs, answer) + placesOf(job);
  }
  const bool outIsTaken =
      isStandardOutput(job.output) || isStandardOutput(job.labels) || isStandardOutput(job.plot);
  outIsTaken ? printAside(text) : printOut(text);
  return Done{};
}

constexpr char kFeetExamples[] = R"(Examples:
  foretouch feet walk.bvh --clip-scale 0.01 --ground fit
  foretouch feet walk.bvh dancer.avatar.json room.obj --place 1.5,0,-2,90 \
      --output feet.csv --plot feet.html
  foretouch feet walk.bvh --skip-t-pose --ground fit --labels walk.npz
  foretouch feet walk1_subject1.csv --robot g1.urdf --columns lafan1-g1

Without a scene the ground is a plain floor at y = 0. A slide is the path along the ground of what
touches it, while it neither comes down nor lifts by more than 0.05 m/s; a depth is along the
ground's normal. A foot hovers if it stays within 30 mm above the ground without touching it. What
each figure means, and where the thresholds come from: docs/feet.md.)";

void addOutputSettings(Settings& settings, FeetJob& job) {
  settings.output("-o,--output", "FILE", job.output, "All stances, as a table (csv)")
      .in(kOutputGroup);
  settings
      .output("--labels", "FILE", job.labels,
              "Each part at each pose: contact, distance, depth, slide speed (csv, jsonl or npz)")
      .in(kOutputGroup);
  settings
      .output("--plot", "FILE", job.plot,
              "Stances over time, and slides on the ground: a page for a browser")
      .in(kOutputGroup);
  settings.asJson(job.asJson);
}

}  // namespace

void addFeetSettings(Settings& settings, FeetRequest& request) {
  addMotionSetting(settings, request, "--motion", "CLIP").required();
  addAvatarSetting(settings, request);
  settings.of("--avatar").help =
      "Avatar file; if there is none, a body is made of a BVH clip's bones, or it is the robot";
  addSceneSettings(settings, request);
  settings.of("--scene").help = "Scene to stand in; a plain floor at y = 0 if there is none";
  addClipSettings(settings, request);
  addCutSettings(settings, request);
  settings
      .word<GroundFrom>("--ground", "WORD", request.ground,
                        {{"given", GroundFrom::Given}, {"fit", GroundFrom::Fit}},
                        "Where the clip's floor is: as placed, or found by its resting feet and "
                        "laid on the ground")
      .in(kUnitsGroup);
  settings
      .list("--foot", "LINK", request.feet,
            "A link that is a foot, or a pattern of them (*ankle_roll_link), in place of those "
            "that are "
            "called so; may be repeated")
      .in(kInputGroup);
  settings
      .number("--tolerance", "M", request.tolerance, NumberRange{1e-6, 0.03, "metres", "m"},
              "What is this near to the ground touches it (m)")
      .in(kTouchGroup);
}

Command feetCommand() {
  const auto job = std::make_shared<FeetJob>();
  FeetRequest& request = job->request;
  Settings settings;
  addFeetSettings(settings, request);
  addRateSetting(settings, request);
  addOutputSettings(settings, *job);
  addFilesSetting(settings, job->files);
  Command command{"feet",
                  "Find which foot slides, sinks in or hovers, when and by how many millimetres",
                  kFeetExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) {
    const auto done = runFeet(*job);
    return done.ok() ? ExitCode::Done : failed(done.error());
  };
  return command;
}

}  // namespace foretouch::tools
