// tests/tools/log/stream_log_program_test.cpp: `foretouch publish --output`, `replay` of event
// logs and `log convert`, from files to files.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "network/log/event_log.h"
#include "network/wire/codec.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"
#include "tests/tools/stream/stream_lines.h"
#include "tools/log/replay_log.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

/// The small world, its clip also as a log.
class LoggedWorld : public SmallWorld {
 public:
  LoggedWorld() {
    std::vector<double> places;
    for (int i = 0; i < 60; ++i) places.push_back(0.4 * std::sin(0.9 * i));
    folder.write("swing.bvh", clipAlongX(places));
    log = publish("swing.lcmlog");
  }

  [[nodiscard]] std::string publish(const std::string& name,
                                    const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"publish",           folder / "swing.bvh", "--avatar",
                                       folder / "man.json", "--output",           folder / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return folder / name;
  }

  [[nodiscard]] Ended replayLog(const std::string& path,
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"replay",   "--scene",           folder / "wall.obj",
                                       "--avatar", folder / "man.json", "--motion",
                                       path,       "--output",          folder / "log.jsonl"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  }

  /// The log with what a service would have answered, or what `change` makes of it.
  template <typename Change>
  [[nodiscard]] std::string journal(const std::string& name, Change change) const {
    auto reader = EventLogReader::open(log).value();
    auto writer = EventLogWriter::create(folder / name).value();
    LogEvent event;
    while (reader.next(event).value()) {
      EXPECT_TRUE(writer.write(event.utimeUs, event.channel, event.payload).ok());
    }
    for (ContactsMessage& answer : answers()) {
      Bytes payload;
      answer.receiveUtimeUs = 1;
      answer.sendUtimeUs = 2;
      if (!change(answer)) continue;
      encode(answer, payload);
      EXPECT_TRUE(writer.write(answer.utimeToUs, kContactsChannel, payload).ok());
    }
    EXPECT_TRUE(writer.close().ok());
    return folder / name;
  }

  std::string log;

 private:
  /// From our own solver: what they are does not matter here, only that a replay finds them again.
  [[nodiscard]] std::vector<ContactsMessage> answers() const {
    tools::LogReplayRequest request;
    request.world.scenePath = folder / "wall.obj";
    request.logPath = log;
    request.avatars = {{1, folder / "man.json"}};
    const auto inputs = tools::loadLogReplayInputs(request);
    std::vector<ContactsMessage> answers;
    const auto replayed =
        tools::replayLog(inputs.value(), [&](const tools::AnsweredPose& answered) {
          answers.push_back(answered.answer);
          return true;
        });
    EXPECT_TRUE(replayed.ok());
    return answers;
  }
};

TEST(ReplayOfALog, FindsWhatTheReplayOfTheClipFinds) {
  const LoggedWorld world;
  const Ended ended = world.replayLog(world.log);
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "answered")) << ended.out;
  EXPECT_FALSE(holds(ended.out, "journal")) << ended.out;
  const std::string clip = world.folder / "clip.jsonl";
  ASSERT_EQ(
      runForetouch(world.replay({"--output", clip}, "wall.obj", "man.json", "swing.bvh")).exitCode,
      0);
  const auto ofLog = linesOf(contentOf(world.folder / "log.jsonl"));
  const auto ofClip = linesOf(contentOf(clip));
  ASSERT_EQ(ofLog.size(), 61u);   // a header, and an answer a pose
  ASSERT_EQ(ofClip.size(), 60u);  // a header, and a step between two poses
  EXPECT_EQ(json::parse(ofLog[0])["format"], "foretouch-results");
  EXPECT_EQ(json::parse(ofLog[0])["avatars"][0]["links"], json({"Hips", "Arm"}));
  EXPECT_EQ(json::parse(ofLog[1])["kind"], "first");
  int touching = 0;
  for (std::size_t step = 0; step + 1 < ofClip.size(); ++step) {
    const std::string contacts = contactsIn(ofClip[step + 1]);
    EXPECT_EQ(contactsIn(ofLog[step + 2]), contacts) << "step " << step;
    touching += contacts == "[]" ? 0 : 1;
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT(touching, 59);
  const auto touchesIn = [](const std::string& path) {
    std::vector<std::string> touches;
    std::istringstream lines(contentOf(path));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("{\"touch\":", 0) != 0) continue;
      const json touch = json::parse(line)["touch"];
      // A log answers the first pose by itself, so there the first contacts are one more.
      touches.push_back(touch["link"].get<std::string>() + touch["begins"].get<std::string>() +
                        touch["ends"].get<std::string>() + std::to_string(touch.count("missed")));
    }
    return touches;
  };
  EXPECT_EQ(touchesIn(world.folder / "log.jsonl"), touchesIn(clip));
  EXPECT_GT(touchesIn(clip).size(), 5u);
}

TEST(ReplayOfALog, TellsALogByItsContent) {
  const LoggedWorld world;
  const std::string other = world.folder.write("renamed.bvh", contentOf(world.log));
  EXPECT_EQ(world.replayLog(other).exitCode, 0);
}

TEST(ReplayOfALog, IsTheSameEveryTime) {
  const LoggedWorld world;
  ASSERT_EQ(world.replayLog(world.log).exitCode, 0);
  const std::string once = contentOf(world.folder / "log.jsonl");
  ASSERT_EQ(world.replayLog(world.log).exitCode, 0);
  EXPECT_EQ(contentOf(world.folder / "log.jsonl"), once);
}

TEST(ReplayOfALog, ComparesWithTheJournal) {
  const LoggedWorld world;
  const std::string same = world.journal("same.lcmlog", [](ContactsMessage&) { return true; });
  const Ended equal = world.replayLog(same);
  EXPECT_EQ(equal.exitCode, 0) << equal.out << equal.err;
  EXPECT_TRUE(holds(equal.out, "60 of 60 verdicts equal the journal's, byte for byte"))
      << equal.out;

  const std::string other = world.journal("other.lcmlog", [](ContactsMessage& answer) {
    if (answer.sequenceTo == 17) answer.lost = 1;
    return true;
  });
  const Ended differs = world.replayLog(other);
  EXPECT_EQ(differs.exitCode, 1);
  EXPECT_TRUE(holds(differs.out, "59 of 60 verdicts")) << differs.out;
  EXPECT_TRUE(holds(differs.out, "pose 17 is answered differently")) << differs.out;
  EXPECT_TRUE(holds(differs.out, "the number of lost poses is 1 in the log, 0 here, in the step "))
      << differs.out;

  const std::string less = world.journal(
      "less.lcmlog", [](const ContactsMessage& answer) { return answer.sequenceTo != 23; });
  const Ended lacks = world.replayLog(less);
  EXPECT_EQ(lacks.exitCode, 1);
  EXPECT_TRUE(holds(lacks.out, "pose 23 is answered here, and not in the log")) << lacks.out;

  const Ended coarse = world.replayLog(same, {"--tolerance", "0.002"});
  EXPECT_EQ(coarse.exitCode, 1);
  EXPECT_TRUE(holds(coarse.out, "the tolerance is 0.001 in the log, 0.002 here")) << coarse.out;
}

TEST(ReplayOfALog, KeepsAvatarsApart) {
  const LoggedWorld world;
  const std::string log = world.publish("two.lcmlog", {"--id", "2", "--place", "9,0,0"});
  const Ended ended =
      runForetouch({"replay", "--scene", world.folder / "wall.obj", "--avatar",
                    "2=" + world.folder / "man.json", "--avatar", "5=" + world.folder / "man.json",
                    "--motion", log, "--output", world.folder / "log.jsonl"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  const auto lines = linesOf(contentOf(world.folder / "log.jsonl"));
  ASSERT_EQ(lines.size(), 61u);
  EXPECT_EQ(json::parse(lines[9])["avatar"], 2);
  EXPECT_EQ(contactsIn(lines[9]), "[]");  // nine metres away
  const Ended other = world.replayLog(log);
  EXPECT_EQ(other.exitCode, 1) << "nothing was answered: that is no result";
  EXPECT_TRUE(holds(other.out, "of avatar 2")) << other.out;
  EXPECT_TRUE(holds(other.out, "nothing was answered")) << other.out;
  EXPECT_EQ(linesOf(contentOf(world.folder / "log.jsonl")).size(), 1u);
}

TEST(ReplayOfALog, RefusesByNameWhatMakesNoSense) {
  const LoggedWorld world;
  const std::vector<std::vector<std::string>> ofClips = {
      {"--rate", "10"},     {"--place", "0,0,0"},    {"--clip-scale", "1"}, {"--clip-up", "y"},
      {"--map", "m"},       {"--animation", "Walk"}, {"--robot", "r"},      {"--threads", "2"},
      {"--scope", "links"}, {"--pass-separating"},   {"--package", "p"}};
  for (const auto& options : ofClips) {
    const Ended ended = world.replayLog(world.log, options);
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(holds(ended.err, "foretouch: " + options[0] +
                                     ": applies to clips only, but --motion is the event log"))
        << ended.err;
  }
  const std::vector<std::vector<std::string>> ofLogs = {
      {"--suffix", "X"}, {"--max-step", "1"}, {"--confirmations", "3"}, {"--unmatched-at-rest"}};
  for (std::vector<std::string> options : ofLogs) {
    const std::string name = options[0];
    options.insert(options.end(), {"--output", world.folder / "x.jsonl"});
    const Ended ended = runForetouch(world.replay(options));
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(holds(
        ended.err, "foretouch: " + name + ": applies to event logs only, but --motion is the clip"))
        << ended.err;
  }
  EXPECT_EQ(runForetouch(world.replay({"--avatar", world.folder / "man.json", "--output",
                                       world.folder / "x.jsonl"}))
                .exitCode,
            2);
}

// What is said of the person of a log is what is said of the clip's; a log that holds it is
// compared byte for byte, and a message that was changed is found.
TEST(ReplayOfALog, SaysOfThePersonWhatAServiceSaid) {
  const LoggedWorld world;
  const std::string bounds = world.folder.write(
      "man.bounds.json",
      R"({"format": "foretouch-bounds", "version": 1, "bounds": [{"part": "all", "model": "cubic-late",
          "acceleration_m_s2": 5, "gap_speed_m_s": 2, "ahead_acceleration_m_s2": 30}]})");
  const std::vector<std::string> asked{"--bounds",   bounds,    "--between",
                                       "cubic-late", "--ahead", "0.1"};
  ASSERT_EQ(world.replayLog(world.log, asked).exitCode, 0);
  std::vector<json> steps;
  for (const std::string& line : linesOf(contentOf(world.folder / "log.jsonl"))) {
    const json one = json::parse(line);
    if (one.contains("person_step")) steps.push_back(one["person_step"]);
  }
  // One per pose, and the last step, as no pose comes after it.
  ASSERT_EQ(steps.size(), 61U);
  EXPECT_EQ(steps[60]["sequence_to"], steps[60]["sequence"]);
  int certain = 0, excluded = 0;
  for (const json& step : steps) {
    for (const json& verdict : step["verdicts"]) {
      certain += verdict == "certain" ? 1 : 0;
      excluded += verdict == "excluded" ? 1 : 0;
    }
  }
  EXPECT_GT(certain, 10);
  EXPECT_GT(excluded, 10);
  const auto journal = [&](const std::string& name, std::int64_t later) {
    tools::LogReplayRequest request;
    request.world.scenePath = world.folder / "wall.obj";
    request.logPath = world.log;
    request.avatars = {{1, world.folder / "man.json"}};
    request.person = {bounds, MotionModel::CubicLate, 100'000};
    auto reader = EventLogReader::open(world.log).value();
    auto writer = EventLogWriter::create(world.folder / name).value();
    LogEvent event;
    while (reader.next(event).value()) {
      EXPECT_TRUE(writer.write(event.utimeUs, event.channel, event.payload).ok());
    }
    const auto inputs = tools::loadLogReplayInputs(request).value();
    const auto write = [&](PersonMessage said) {
      Bytes payload;
      said.sendUtimeUs = 77;
      said.notBeforeUs[0] += said.sequence == 30 ? later : 0;
      encode(said, payload);
      EXPECT_TRUE(writer.write(said.utimeUs, kPersonChannel, payload).ok());
    };
    const auto replayed = tools::replayLog(inputs, [&](const tools::AnsweredPose& answered) {
      write(answered.person->said(0));
      return true;
    });
    EXPECT_EQ(replayed.value().ended.size(), 1U);
    for (const PersonMessage& said : replayed.value().ended) write(said);
    EXPECT_TRUE(writer.close().ok());
    return world.folder / name;
  };
  const std::string same = journal("same.lcmlog", 0);
  const Ended equal = world.replayLog(same, asked);
  EXPECT_EQ(equal.exitCode, 0) << equal.out;
  EXPECT_TRUE(holds(equal.out, "61 of 61 messages about the person equal the journal's"))
      << equal.out;
  const Ended notAsked = world.replayLog(same);
  EXPECT_EQ(notAsked.exitCode, 0);
  EXPECT_TRUE(holds(notAsked.out, "61 messages about the person: --bounds")) << notAsked.out;
  const Ended other = world.replayLog(journal("other.lcmlog", 1), asked);
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_TRUE(holds(other.out,
                    "pose 30 is known differently: the instant until which nothing is "
                    "touched of link 0"))
      << other.out;
}

TEST(ReplayOfALog, RefusesWhatIsNoLog) {
  const LoggedWorld world;
  const std::string junk = world.folder.write("junk.lcmlog", "no log at all");
  const Ended ended = world.replayLog(junk);
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "junk.lcmlog")) << ended.err;
  EXPECT_EQ(world.replayLog(world.folder / "absent.lcmlog").exitCode, 2);
}

TEST(Publish, RefusesWhatDoesNotGoTogether) {
  const LoggedWorld world;
  const auto errorOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"publish", world.folder / "swing.bvh", "--avatar",
                                       world.folder / "man.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    return ended.err;
  };
  const std::string log = world.folder / "new.lcmlog";
  EXPECT_TRUE(holds(errorOf({"--output", log, "--loop"}), "--loop: "));
  EXPECT_TRUE(holds(errorOf({"--output", log, "--speed", "2"}), "--speed: "));
  EXPECT_TRUE(holds(errorOf({"--output", log, "--url", "udpm://239.1.1.1:7667"}), "--url: "));
  EXPECT_TRUE(holds(errorOf({"--start", "5"}), "--start: "));
  EXPECT_TRUE(holds(errorOf({"--output", log, "--id", "-1"}), "--id: "));
  EXPECT_TRUE(holds(errorOf({"--output", log, "--rate", "99"}), "--rate"));
  EXPECT_TRUE(holds(errorOf({"--output", log, "--suffix", "a b"}), "--suffix: "));
  EXPECT_TRUE(holds(errorOf({"--output", world.log}), "swing.lcmlog"));  // there already
}

// The writer's own number, which its check sums hold, apart.
TEST(Publish, WritesTheSameEventsForTheSameStart) {
  const LoggedWorld world;
  const std::string one = world.publish("one.lcmlog", {"--start", "1000000", "--rate", "5"});
  const std::string two = world.publish("two.lcmlog", {"--start", "1000000", "--rate", "5"});
  const std::string events = world.folder / "one.jsonl", others = world.folder / "two.jsonl";
  ASSERT_EQ(runForetouch({"log", "convert", one, "-o", events}).exitCode, 0);
  ASSERT_EQ(runForetouch({"log", "convert", two, "-o", others}).exitCode, 0);
  EXPECT_TRUE(contentOf(events) == contentOf(others));
  ASSERT_EQ(world.replayLog(one).exitCode, 0);
  const auto lines = linesOf(contentOf(world.folder / "log.jsonl"));
  ASSERT_EQ(lines.size(), 31u);  // every other frame
  EXPECT_EQ(json::parse(lines[2])["utime"], json({1'000'000, 1'200'000}));
}

TEST(LogConvert, GoesToBvhAndBackToTheSameVerdicts) {
  const LoggedWorld world;
  const std::string bvh = world.folder / "back.bvh";
  const Ended there = runForetouch({"log", "convert", world.log, "--output", bvh});
  ASSERT_EQ(there.exitCode, 0) << there.err;
  EXPECT_TRUE(holds(there.out, "60 frames of avatar 1")) << there.out;
  EXPECT_EQ(there.err, "");
  const std::string log = world.folder / "back.lcmlog";
  const Ended back = runForetouch(
      {"log", "convert", bvh, "--avatar", "1=" + world.folder / "man.json", "--output", log});
  ASSERT_EQ(back.exitCode, 0) << back.err;
  ASSERT_EQ(world.replayLog(world.log).exitCode, 0);
  const auto before = linesOf(contentOf(world.folder / "log.jsonl"));
  ASSERT_EQ(world.replayLog(log).exitCode, 0);
  const auto after = linesOf(contentOf(world.folder / "log.jsonl"));
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 1; i < before.size(); ++i) {
    EXPECT_EQ(contactsIn(after[i]), contactsIn(before[i])) << i;  // nothing turns in this clip
  }
}

TEST(LogConvert, WritesALineAnEvent) {
  const LoggedWorld world;
  const std::string out = world.folder / "events.jsonl";
  ASSERT_EQ(runForetouch({"log", "convert", world.log, "-o", out}).exitCode, 0);
  const auto lines = linesOf(contentOf(out));
  ASSERT_EQ(lines.size(), 66u);  // 60 poses over 5.9 s, and six skeletons
  int poses = 0;
  for (const std::string& line : lines) poses += static_cast<int>(json::parse(line).count("pose"));
  EXPECT_EQ(poses, 60);
}

TEST(LogConvert, WritesTheClipThatADamagedLogStillHolds) {
  const LoggedWorld world;
  const std::string bytes = contentOf(world.log);
  const std::string cut =
      world.folder.write("cut.lcmlog", bytes.substr(0, bytes.size() - bytes.size() / 3));
  const std::string bvh = world.folder / "cut.bvh";
  const Ended ended = runForetouch({"log", "convert", cut, "--output", bvh});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(holds(ended.out, "frames of avatar 1, in metres")) << ended.out;
  EXPECT_TRUE(holds(ended.err, "cut.lcmlog: nothing is read after event ")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "events were read; lost: ")) << ended.err;
  EXPECT_EQ(contentOf(bvh).rfind("HIERARCHY", 0), 0u);
}

TEST(LogConvert, RefusesByNameWhatItCannotDo) {
  const LoggedWorld world;
  const auto errorOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"log", "convert"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    return ended.err;
  };
  EXPECT_TRUE(holds(errorOf({world.log, "-o", world.folder / "x.csv"}), ".bvh or .jsonl"));
  EXPECT_TRUE(
      holds(errorOf({world.folder / "swing.bvh", "-o", world.folder / "x.jsonl"}), ".lcmlog"));
  EXPECT_TRUE(
      holds(errorOf({world.folder / "swing.bvh", "-o", world.folder / "x.lcmlog"}), "--avatar"));
  EXPECT_TRUE(holds(errorOf({world.log, "-o", world.folder / "x.bvh", "--avatar", "3"}),
                    "no pose of avatar 3"));
  EXPECT_TRUE(
      holds(errorOf({world.log, "-o", world.folder / "x.jsonl", "--avatar", "3"}), "--avatar"));
}

}  // namespace
}  // namespace foretouch::test
