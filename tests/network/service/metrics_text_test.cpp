#include "network/service/metrics_text.h"

#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

struct Page {
  std::map<std::string, std::string> values;  ///< By name and labels.
  std::map<std::string, std::string> types;
};

/// Reads the text format: HELP and TYPE before a metric's lines, "name{labels} value".
Page read(const std::string& text) {
  Page page;
  std::istringstream lines(text);
  std::string metric;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("# HELP ", 0) == 0) {
      EXPECT_NE(line.find(' ', 7), std::string::npos) << line;
      continue;
    }
    if (line.rfind("# TYPE ", 0) == 0) {
      const std::size_t space = line.rfind(' ');
      metric = line.substr(7, space - 7);
      EXPECT_TRUE(page.types.emplace(metric, line.substr(space + 1)).second) << line;
      continue;
    }
    EXPECT_EQ(line.rfind(metric, 0), 0u) << line;
    const std::size_t space = line.rfind(' ');
    EXPECT_TRUE(page.values.emplace(line.substr(0, space), line.substr(space + 1)).second) << line;
  }
  EXPECT_EQ(text.back(), '\n');
  return page;
}

ServiceCounts someCounts() {
  ServiceCounts counts;
  counts.received = 100;
  counts.answered = 90;
  counts.waiting = 3;
  counts.lost = 5;
  counts.gaps = 2;
  counts.skeletons = 4;
  counts.rejects[static_cast<std::size_t>(Reject::Duplicate)] = 7;
  counts.skeletonRejects[static_cast<std::size_t>(Reject::BadHash)] = 1;
  counts.publishFailures = 8;
  counts.journalFailures = 9;
  counts.wire.datagrams = 120;
  counts.wire.kernelDrops = 11;
  counts.wire.faults[static_cast<std::size_t>(DatagramFault::Magic)] = 12;
  counts.lastPoseUtimeUs = 1'700'000'000'500'000;
  return counts;
}

TEST(MetricsText, SaysEveryCount) {
  AnswerTimes times;
  for (const double us : {4.0, 40.0, 400.0, 2e6}) times.latency.record(us);
  const Page page = read(metricsText({"a build", "room.obj", 2, 3, 0}, someCounts(), times));
  const auto value = [&](const std::string& name) {
    const auto found = page.values.find(name);
    return found == page.values.end() ? "none" : found->second;
  };
  EXPECT_EQ(value("foretouch_poses_received_total"), "100");
  EXPECT_EQ(value("foretouch_poses_answered_total"), "90");
  EXPECT_EQ(value("foretouch_poses_rejected_total{reason=\"duplicate\"}"), "7");
  EXPECT_EQ(value("foretouch_poses_rejected_total{reason=\"overrun\"}"), "0");
  EXPECT_EQ(value("foretouch_poses_waiting"), "3");
  EXPECT_EQ(value("foretouch_poses_lost_total"), "5");
  EXPECT_EQ(value("foretouch_answers_across_gap_total"), "2");
  EXPECT_EQ(value("foretouch_skeletons_received_total"), "4");
  EXPECT_EQ(value("foretouch_skeletons_rejected_total{reason=\"bad-hash\"}"), "1");
  EXPECT_EQ(value("foretouch_publish_failures_total"), "8");
  EXPECT_EQ(value("foretouch_journal_failures_total"), "9");
  EXPECT_EQ(value("foretouch_datagrams_received_total"), "120");
  EXPECT_EQ(value("foretouch_datagrams_dropped_total"), "11");
  EXPECT_EQ(value("foretouch_datagrams_faulty_total{fault=\"magic\"}"), "12");
  EXPECT_EQ(value("foretouch_last_pose_timestamp_seconds"), "1700000000.5");
  EXPECT_EQ(value("foretouch_avatars"), "2");
  EXPECT_EQ(value("foretouch_workers"), "3");
  EXPECT_EQ(value("foretouch_build_info{build=\"a build\",scene=\"room.obj\"}"), "1");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_bucket{le=\"5e-06\"}"), "1");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_bucket{le=\"0.0005\"}"), "3");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_bucket{le=\"1\"}"), "3");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_bucket{le=\"+Inf\"}"), "4");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_count"), "4");
  EXPECT_EQ(value("foretouch_answer_latency_seconds_sum"), "2.000444");
  EXPECT_EQ(page.types.at("foretouch_answer_latency_seconds"), "histogram");
  EXPECT_EQ(page.types.at("foretouch_poses_waiting"), "gauge");
}

TEST(MetricsText, NamesEveryReasonThereIs) {
  const Page page = read(metricsText({}, {}, {}));
  for (std::size_t i = 1; i < kNumRejects; ++i) {
    const std::string reason = toString(static_cast<Reject>(i));
    EXPECT_EQ(page.values.count("foretouch_poses_rejected_total{reason=\"" + reason + "\"}"), 1u);
  }
  for (const auto& [name, type] : page.types) {
    EXPECT_EQ(name.rfind("foretouch_", 0), 0u);
    const bool isTotal = name.size() > 6 && name.substr(name.size() - 6) == "_total";
    EXPECT_EQ(isTotal, type == "counter") << name;
  }
}

TEST(MetricsText, EscapesLabels) {
  const std::string text = metricsText({"b", "a\"b\\c\nd", 1, 1, 0}, {}, {});
  EXPECT_NE(text.find("scene=\"a\\\"b\\\\c\\nd\"} 1\n"), std::string::npos);
  read(text);
}

TEST(MetricsText, SaysWhatSolidAvatarsShow) {
  SolidCounter counter;
  SolidMessage message;
  message.avatar = 4;
  message.state = SolidState::Held;
  message.isCertified = true;
  message.deviation = 0.25;
  message.counters.queries = 3;
  message.counters.work = 100;
  message.solidUs = 40.0;
  counter.shown(message);
  message.state = SolidState::Placing;
  message.isCertified = false;
  counter.shown(message);
  const Page page = read(metricsText({}, {}, {}, counter.counts()));
  const auto value = [&](const std::string& name) {
    const auto found = page.values.find(name);
    return found == page.values.end() ? "none" : found->second;
  };
  EXPECT_EQ(value("foretouch_solid_poses_total{avatar=\"4\",state=\"held\"}"), "1");
  EXPECT_EQ(value("foretouch_solid_poses_total{avatar=\"4\",state=\"placing\"}"), "1");
  EXPECT_EQ(value("foretouch_solid_poses_total{avatar=\"4\",state=\"equal\"}"), "none");
  EXPECT_EQ(value("foretouch_solid_uncertified_total{avatar=\"4\"}"), "1");
  EXPECT_EQ(value("foretouch_solid_deviation_metres{avatar=\"4\"}"), "0.25");
  EXPECT_EQ(value("foretouch_solid_queries_total{avatar=\"4\"}"), "6");
  EXPECT_EQ(value("foretouch_solid_work_total{avatar=\"4\"}"), "200");
  EXPECT_EQ(value("foretouch_solid_seconds_count"), "2");
  EXPECT_EQ(page.types.at("foretouch_solid_poses_total"), "counter");
  EXPECT_EQ(read(metricsText({}, {}, {})).types.count("foretouch_solid_poses_total"), 0U);
}

TEST(MetricsText, SaysWhatIsKnownOfPersons) {
  PersonCounter counter;
  PersonMessage message;
  message.avatar = 4;
  message.kind = StepKind::Consecutive;
  message.verdicts = {BracketVerdict::Excluded, BracketVerdict::Excluded, BracketVerdict::Certain};
  message.broken.resize(2);
  counter.said(message);
  message.kind = StepKind::First;  // no step
  message.broken.clear();
  counter.said(message);
  message.kind = StepKind::AcrossGap;  // of the second link alone
  message.sequence = 9;
  message.sequenceTo = 8;
  message.verdicts = {BracketVerdict::Unclaimed, BracketVerdict::Possible};
  counter.said(message);
  const Page page = read(metricsText({}, {}, {}, {}, nullptr, counter.counts()));
  const auto value = [&](const std::string& name) {
    const auto found = page.values.find(name);
    return found == page.values.end() ? "none" : found->second;
  };
  EXPECT_EQ(value("foretouch_person_links_total{avatar=\"4\",verdict=\"excluded\"}"), "2");
  EXPECT_EQ(value("foretouch_person_links_total{avatar=\"4\",verdict=\"certain\"}"), "1");
  EXPECT_EQ(value("foretouch_person_links_total{avatar=\"4\",verdict=\"possible\"}"), "1");
  EXPECT_EQ(value("foretouch_person_links_total{avatar=\"4\",verdict=\"unclaimed\"}"), "none");
  EXPECT_EQ(value("foretouch_person_bounds_broken_total{avatar=\"4\"}"), "2");
  EXPECT_EQ(value("foretouch_person_seconds_count"), "3");
  EXPECT_EQ(read(metricsText({}, {}, {})).types.count("foretouch_person_links_total"), 0U);
}

}  // namespace
}  // namespace foretouch
