#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bounds/bounds_file.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/person.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedPerson {
  PersonBenchRequest request;
  std::vector<std::string> models{"constant-rate", "cubic", "cubic-late"};
  std::string json, csv;
};

ExitCode run(AskedPerson& asked) {
  PersonBenchRequest& request = asked.request;
  if (request.dataFolder.empty()) request.dataFolder = usualData();
  request.command = ownCommandLine();
  request.models.clear();
  for (const std::string& word : asked.models) request.models.push_back(*motionModelNamed(word));
  FORETOUCH_TRY_OR(failed, const auto bench, measurePerson(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  if (bench.violations == 0) return ExitCode::Done;
  printError(fmt::format("{} touches were missed or invented", bench.violations));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command bodyCommand() {
  constexpr int kMostPlaces = 1000, kMostInstants = 100, kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<AskedPerson>();
  PersonBenchRequest& request = asked->request;
  Settings settings;
  settings.path("--data", "FOLDER", request.dataFolder,
                "With mocap/ and scenes/; $FORETOUCH_DATA, else ../shared/data, if not given");
  addWords(settings, "--scenes", "NAME,...", request.scenes, {},
           "kitchen, office, collision-world, undulating, room; kitchen,office,room if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths, or all; six if not given");
  addNumbers(settings, "--rates", "HZ,...", request.ratesHz, kAboveZero,
             "Given poses per second, of clips that have twice as many");
  addWords(settings, "--between", "WORD,...", asked->models,
           {"constant-rate", "cubic", "cubic-late"}, "Models of the motion between two poses");
  settings.whole("--places", "N", request.places, 1, kMostPlaces, "Busy places per clip and scene");
  settings.number("--seconds", "S", request.seconds, kAboveZero, "Of the clip at each place");
  settings.whole("--instants", "N", request.instants, 1, kMostInstants,
                 "Per frame of the clip, that the judge looks at");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the places");
  settings.number("--bound-share", "X", request.boundShare, kAboveZero,
                  "Of the bounds that hold: below 1, touches are missed");
  settings.number("--learned", "Q", request.learned, NumberRange{0.0, 1.0},
                  "Instead by bounds of the clips of other makers, learned at this quantile");
  settings.number("--ahead", "S", request.aheadS, NumberRange{0.0, 2.0},
                  "Instead: what is said of this long after each pose, beside grown capsules");
  addFigures(settings, asked->json, asked->csv, "Also write the table to a file");
  Command command{"body",
                  "What brackets say of persons whose poses are held back; exit code 1 where a "
                  "touch is missed or invented",
                  "Example:\n  foretouch-bench body --scenes kitchen --clips all --rates 30,10",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
