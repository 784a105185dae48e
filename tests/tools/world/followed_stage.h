// tests/tools/world/followed_stage.h: files of events of small worlds, read by their documented
// rules alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tests/tools/world/small_stage.h"

namespace foretouch::test {

using nlohmann::json;

/// A file of events, as a reader of docs/formats.md takes it.
struct EventsFile {
  json header, summary;
  std::vector<json> events, intervals, stays;
};

inline EventsFile readEvents(const std::string& text) {
  EventsFile file;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    json one = json::parse(line);
    if (file.header.is_null()) {
      file.header = std::move(one);
    } else if (one.count("event") != 0) {
      file.events.push_back(std::move(one));
    } else if (one.count("interval") != 0) {
      file.intervals.push_back(one["interval"]);
    } else if (one.count("stay") != 0) {
      file.stays.push_back(one["stay"]);
    } else {
      file.summary = one.at("summary");
    }
  }
  return file;
}

inline std::string nameOf(const json& side) {
  return side.value("body", "") + " " + side.value("link", side.value("object", ""));
}

/// Which two an event or an interval is about.
inline std::string pairOf(const json& of) {
  if (of.count("trigger") != 0) return of["trigger"].get<std::string>() + ": " + nameOf(of["who"]);
  return nameOf(of["a"]) + ", " + nameOf(of["b"]) + " " + of["b"].value("object", "");
}

inline std::pair<std::int64_t, double> exactTime(const json& of) {
  return {of.at("utime").get<std::int64_t>(), of.at("fraction").get<double>()};
}

inline int orderOf(const std::string& kind) {
  const std::vector<std::string> order{"leave", "unresolved_to", "starts_inside", "enter",
                                       "unresolved_from"};
  return static_cast<int>(std::find(order.begin(), order.end(), kind) - order.begin());
}

class FollowedStage : public testing::Test {
 protected:
  [[nodiscard]] EventsFile follow(const std::string& world,
                                  const std::vector<std::string>& more = {}) const {
    const std::string events = folder_ / "events.jsonl";
    std::vector<std::string> arguments{"world",    "replay", world, "-o", folder_ / "out.jsonl",
                                       "--events", events};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return readEvents(contentOf(events));
  }

  SmallStage stage_;
  TempFolder folder_;
};

inline const json& find(const std::vector<json>& events, const std::string& kind,
                        const std::string& pair) {
  for (const json& event : events) {
    if (event["event"] == kind && pairOf(event) == pair) return event;
  }
  static const json kNone;
  ADD_FAILURE() << kind << " of " << pair;
  return kNone;
}

}  // namespace foretouch::test
