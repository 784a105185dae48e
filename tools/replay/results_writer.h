// tools/replay/results_writer.h: the lines of a results file (docs/formats.md, "Results"). Pure:
// the same answers give the same text, on any machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "assets/json_writer.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/reported_contact.h"

namespace foretouch::tools {

/// The answer to one step.
struct StepAnswer {
  std::int64_t step = 0;
  double t0S = 0.0, t1S = 0.0;        ///< Seconds from the clip's first frame.
  std::vector<LinkContact> contacts;  ///< Those of the links of reported(), in its order.
  std::vector<LinkContact> objects;   ///< By object (StepContacts::perObject), if asked so.
  std::vector<PairContact> pairs;     ///< Those of own links, if they are asked.
  /// For each of `objects` if they are asked, else of `contacts`: is it with the ground?
  std::vector<bool> onGround;
  std::vector<LinkId> missedByPoses;  ///< Links in contact that touch nothing at either pose.
  QueryCounters counters;
  double latencyUs = 0.0;
  std::optional<std::int64_t> row;  ///< Where several steps make up a row: ReplayInputs::rowOfStep.
};

// For first lines, also of a log's results. Each writes fields into an open object; beginResults()
// opens it.
void beginResults(JsonWriter& out, const char* format = "foretouch-results");
/// Writes the file's name without the folders.
void writeFileName(const char* name, const std::string& path, JsonWriter& out);
void writeLinkNames(const Avatar& avatar, JsonWriter& out);
/// Which pairs of own links the results report, and about which ones they say nothing: `self`.
/// `path`: the file of the rules; empty if they are derived.
void writeSelf(const PairRules& rules, const Skeleton& skeleton, const std::string& path,
               JsonWriter& out);

/// The first line. Does not name threads: they do not change the results.
[[nodiscard]] std::string headerLine(const ReplayInputs& inputs);

/// Lists that every line has if they were asked for, even if nothing is in them.
struct AskedLists {
  bool objects = false, pairs = false;

  [[nodiscard]] static AskedLists of(const QueryOptions& query) {
    return {query.scope == Scope::EveryObject, query.self.has_value()};
  }
};

/// Formats steps. Const calls from several threads are fine.
class StepFormat {
 public:
  StepFormat(const Avatar& avatar, const Scene& scene, AskedLists asked = {});

  /// One line, its line break included.
  [[nodiscard]] std::string line(const StepAnswer& answer) const;

 private:
  void write(const LinkContact& contact, const StepAnswer& answer, JsonWriter& out) const;
  void write(const PairContact& contact, const StepAnswer& answer, JsonWriter& out) const;

  Scene scene_;
  AskedLists asked_;
  std::vector<std::string> links_, objects_;  // as JSON strings
};

}  // namespace foretouch::tools
