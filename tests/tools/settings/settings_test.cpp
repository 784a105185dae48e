// tests/tools/settings/settings_test.cpp: the tables of settings, and what is made of them.
#include "tools/settings/settings.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "middleware/query_options.h"
#include "network/service/service.h"
#include "tests/support/temp_folder.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/project_file.h"
#include "tools/settings/serve_settings.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

std::string errorOf(Setting& setting, const std::string& text) {
  const auto taken = takeTyped(setting, {text});
  return taken.ok() ? "accepted" : describe(taken.error());
}

/// As a first line says them.
std::string fieldsOf(const Settings& settings, std::initializer_list<const char*> fields) {
  std::string text;
  JsonWriter out(text);
  writeHeaderFields(settings, fields, out);
  return text;
}

TEST(Settings, PutLegalValuesInTheirPlace) {
  WorldRequest request;
  Settings settings;
  addSceneSettings(settings, request);
  addQuerySettings(settings, request);
  EXPECT_FALSE(settings.isGiven("--tolerance"));
  EXPECT_EQ(errorOf(settings.of("--tolerance"), "0.25"), "accepted");
  EXPECT_TRUE(settings.isGiven("--tolerance"));
  EXPECT_EQ(request.query.tolerance, 0.25);
  EXPECT_EQ(errorOf(settings.of("--scene-up"), "z"), "accepted");
  EXPECT_EQ(request.sceneImport.up, UpAxis::Z);
  ASSERT_TRUE(takeTyped(settings.of("--ignore"), {"Hand", "Foot:floor"}).ok());
  EXPECT_EQ(request.ignore, (std::vector<std::string>{"Hand", "Foot:floor"}));
}

TEST(Settings, RefuseWhatIsNotLegalAndLeaveThePlaceAlone) {
  WorldRequest request;
  Settings settings;
  addQuerySettings(settings, request);
  Setting& tolerance = settings.of("--tolerance");
  for (const char* const text : {"0", "9.9e-10", "1.1e7", "nan", "inf", "-1", "", "1m", " 1"}) {
    EXPECT_EQ(errorOf(tolerance, text),
              "--tolerance: expected a finite number of metres from 1e-9 to 1e7, found '" +
                  std::string(text) + "'");
  }
  EXPECT_EQ(request.query.tolerance, QueryOptions().tolerance);
  EXPECT_EQ(errorOf(tolerance, "1e-9"), "accepted");
  EXPECT_EQ(errorOf(tolerance, "1e7"), "accepted");
  EXPECT_EQ(errorOf(settings.of("--fidelity"), "exakt"),
            "--fidelity: expected link, exact or skinned, found 'exakt'; did you mean 'exact'?");
  EXPECT_EQ(errorOf(settings.of("--fidelity"), "avatar").rfind("--fidelity: avatar is gone: ", 0),
            0u);
  EXPECT_EQ(errorOf(settings.of("--budget-us"), "60000001"),
            "--budget-us: expected a whole number from 0 to 60000000, found '60000001'");
}

TEST(Settings, WordsStandForNumbersWhereTheyMay) {
  ClipRequest request;
  Settings settings;
  Setting& rate = addRateSetting(settings, request);
  EXPECT_EQ(rate.shown(), "all");
  EXPECT_EQ(errorOf(rate, "12.5"), "accepted");
  EXPECT_EQ(request.rateHz, 12.5);
  EXPECT_EQ(fieldsOf(settings, {"rate"}), "\"rate\":12.5");
  EXPECT_EQ(errorOf(rate, "all"), "accepted");
  EXPECT_EQ(request.rateHz, std::nullopt);
  EXPECT_EQ(fieldsOf(settings, {"rate"}), "\"rate\":null");
  EXPECT_EQ(errorOf(rate, "0"),
            "--rate: expected a finite number greater than 0 or all, found '0'");
}

TEST(Settings, PlacesKeepTheAxisThatAnotherOptionTurned) {
  ClipRequest request;
  Settings settings;
  addClipSettings(settings, request);
  EXPECT_EQ(settings.of("--place").shown(), "0,0,0,0");
  EXPECT_EQ(errorOf(settings.of("--clip-up"), "z"), "accepted");
  EXPECT_EQ(errorOf(settings.of("--place"), "1.5,0,-2,90"), "accepted");
  EXPECT_TRUE(request.placement.motionUpZ);
  EXPECT_EQ(request.placement.yawDeg, 90.0);
  EXPECT_EQ(fieldsOf(settings, {"motion_up", "place"}),
            "\"motion_up\":\"z\",\"place\":[1.5,0,-2,90]");
}

TEST(Settings, StreamsAreAskedInSecondsAndKeptInMicroseconds) {
  StreamPolicy policy;
  Settings settings;
  addStreamSettings(settings, policy);
  EXPECT_EQ(settings.of("--max-step").shown(), "10");
  EXPECT_EQ(errorOf(settings.of("--max-step"), "0.25"), "accepted");
  EXPECT_EQ(policy.maxStepUs, 250'000);
  EXPECT_EQ(errorOf(settings.of("--max-step"), "86400"), "accepted");
  EXPECT_EQ(policy.maxStepUs, kMostStepUs);
  EXPECT_EQ(errorOf(settings.of("--max-step"), "86400.1"),
            "--max-step: expected a finite number of seconds from 1e-6 to 86400, found '86400.1'");
  ASSERT_TRUE(takeTyped(settings.of("--unmatched-at-rest"), {}).ok());
  EXPECT_TRUE(policy.unmatchedAtRest);
}

TEST(Settings, DefaultsAreThoseOfTheQueryAndTheService) {
  ServeConfig config;
  Settings settings;
  addServeSettings(settings, config);
  EXPECT_EQ(std::stod(settings.of("--tolerance").shown()), QueryOptions().tolerance);
  EXPECT_EQ(settings.of("--fidelity").shown(), toString(QueryOptions().fidelity));
  EXPECT_EQ(std::stoul(settings.of("--queue").shown()), ServiceOptions().queue);
  EXPECT_EQ(std::stoi(settings.of("--workers").shown()), ServiceOptions().workers);
  EXPECT_EQ(std::stoi(settings.of("--confirmations").shown()), StreamPolicy().confirmations);
}

TEST(Settings, NoTwoHaveOneNameOrOneKey) {
  ServeConfig config;
  ClipRequest clip;
  Settings settings;
  addServeSettings(settings, config);
  addReplayQuerySettings(settings, config.world);
  addClipSettings(settings, clip);
  std::set<std::string> options, keys, fields, rows;
  for (const Setting& setting : settings) {
    EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
    EXPECT_TRUE(setting.key.empty() || keys.insert(setting.table + "." + setting.key).second)
        << setting.key;
    EXPECT_TRUE(setting.field.empty() || fields.insert(setting.field).second) << setting.field;
    EXPECT_TRUE(setting.row.empty() || rows.insert(setting.row).second) << setting.row;
    EXPECT_EQ(setting.help.empty(), !setting.isGone.empty()) << setting.option;
  }
}

TEST(Settings, NumbersAreWrittenTidily) {
  EXPECT_EQ(tidyNumber(1e-9), "1e-9");
  EXPECT_EQ(tidyNumber(1e7), "1e7");
  EXPECT_EQ(tidyNumber(0.001), "0.001");
  EXPECT_EQ(tidyNumber(86400), "86400");
}

/// What docs/formats.md holds between two marks.
std::string heldBetween(const std::string& begin, const std::string& end) {
  const std::string text = test::contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/docs/formats.md");
  const std::size_t from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos) return "no marks";
  return text.substr(from + begin.size(), to - from - begin.size());
}

TEST(Settings, TheDocumentOfConfigurationsHoldsTheTable) {
  const std::string held =
      heldBetween("<!-- made of the settings: begin -->\n", "<!-- made of the settings: end -->\n");
  EXPECT_TRUE(held == configTable()) << "docs/formats.md should hold:\n" << configTable();
}

TEST(Settings, TheDocumentOfProjectsHoldsTheTable) {
  const std::string held =
      heldBetween("<!-- project settings: begin -->\n", "<!-- project settings: end -->\n");
  EXPECT_TRUE(held == projectTable()) << "docs/formats.md should hold:\n" << projectTable();
}

}  // namespace
}  // namespace foretouch::tools
