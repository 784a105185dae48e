// tests/tools/stream/stream_program_test.cpp: sender, service and listener as programs of their
// own, over real UDP multicast in a network namespace (tests/network/in_namespace.sh), and LCM's
// own tools beside them: the stream answers what a replay of the clip answers, byte for byte.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/network/http_client.h"
#include "tests/support/holds.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"
#include "tests/tools/stream/stream_lines.h"

namespace foretouch::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

/// How long what must come is waited for; only failures take so long.
bool waitFor(const std::function<bool()>& isThere) {
  for (int i = 0; i < 6000; ++i) {
    if (isThere()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// A clip, whom it moves, and where: in options of the program.
struct Stage {
  std::string clip, avatar;
  Words ofClip;   ///< Scale, place and rate.
  Words ofScene;  ///< The scene, and what is ignored.
};

/// Skips outside a namespace; owns the files of a case.
class StreamPrograms : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("FORETOUCH_PRIVATE_NETWORK") == nullptr) {
      GTEST_SKIP() << "sends multicast: run it by tests/network/in_namespace.sh";
    }
    stage_ = roomStage();
  }

  /// The bundled room and dancer.
  static Stage roomStage() {
    const std::string folder = FORETOUCH_EXAMPLE_FOLDER;
    return {folder + "/dancer.bvh",
            folder + "/dancer.avatar.json",
            {"--rate", "10"},
            {"--scene", folder + "/room.obj"}};
  }

  static Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  [[nodiscard]] Words serveWords(const Words& more = {}) const {
    return joined(joined({"serve", "--avatar", stage_.avatar, "--url", kUrl}, stage_.ofScene),
                  more);
  }
  [[nodiscard]] Words publishWords(const Words& more = {}) const {
    return joined(joined({"publish", stage_.clip, "--avatar", stage_.avatar}, stage_.ofClip), more);
  }

  /// A service that says that it is ready.
  [[nodiscard]] std::unique_ptr<ProgramRun> service(const Words& more = {},
                                                    const Words& environment = {}) const {
    auto run = std::make_unique<ProgramRun>(serveWords(more), environment);
    EXPECT_TRUE(waitFor([&] { return holds(run->outSoFar(), "ready\n"); })) << run->errSoFar();
    return run;
  }

  /// A listener that has heard the service's heartbeat: from now on it hears its answers.
  [[nodiscard]] std::unique_ptr<ProgramRun> listener(std::size_t answers,
                                                     const Words& more = {}) const {
    auto run =
        std::make_unique<ProgramRun>(joined({"listen", "--json", "--status", "--url", kUrl,
                                             "--count", std::to_string(answers), "--timeout", "30"},
                                            more));
    EXPECT_TRUE(waitFor([&] { return holds(run->outSoFar(), "\"status\""); })) << run->errSoFar();
    return run;
  }

  /// Lines of results of `--motion CLIP`, the header first.
  [[nodiscard]] std::vector<std::string> replayedClip() const {
    const std::string out = folder_ / "clip.jsonl";
    const Ended ended = runForetouch(joined(
        joined({"replay", "--avatar", stage_.avatar, "--motion", stage_.clip, "--output", out},
               stage_.ofClip),
        stage_.ofScene));
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return linesOf(contentOf(out));
  }

  [[nodiscard]] Ended replayedLog(const std::string& log) const {
    return runForetouch(joined(
        {"replay", "--avatar", stage_.avatar, "--motion", log, "--output", folder_ / "log.jsonl"},
        stage_.ofScene));
  }

  /// Only the answers among a listener's lines.
  static std::vector<std::string> answersIn(const std::string& out) {
    std::vector<std::string> answers;
    for (const std::string& line : linesOf(out)) {
      if (line.rfind("{\"avatar\"", 0) == 0) answers.push_back(line);
    }
    return answers;
  }

  /// One answer a pose: the first pose's is an instant, then one a step of the replay, alike.
  static void expectReplayed(const std::vector<std::string>& answers,
                             const std::vector<std::string>& replayed) {
    ASSERT_EQ(answers.size(), replayed.size());  // a header there, the first pose here
    EXPECT_EQ(json::parse(answers[0])["kind"], "first");
    int touching = 0;
    for (std::size_t i = 1; i < answers.size(); ++i) {
      const json answer = json::parse(answers[i]);
      ASSERT_EQ(answer["kind"], "consecutive") << answers[i];
      ASSERT_EQ(answer["sequence"], json({i - 1, i}));
      const std::string contacts = contactsIn(replayed[i]);
      ASSERT_EQ(contactsIn(answers[i]), contacts) << "step " << i - 1;
      touching += contacts == "[]" ? 0 : 1;
    }
    EXPECT_GT(touching, 5);
  }

  /// What stands under this name among lines of JSON.
  static std::vector<json> eventsOf(const std::string& lines, const std::string& name) {
    std::vector<json> events;
    for (const std::string& line : linesOf(lines)) {
      if (line.rfind("{\"" + name + "\":", 0) == 0) events.push_back(json::parse(line)[name]);
    }
    return events;
  }

  static void expectEndsInOrder(ProgramRun& service) {
    service.send(SIGTERM);
    const Ended ended = service.ended();
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
  }

  /// Sender, service and listener once through; the journal is checked by a replay.
  void runOnce(const Words& howToSend) {
    const std::vector<std::string> replayed = replayedClip();
    const std::string journal = folder_ / "journal.lcmlog";
    const auto serving = service({"--log", journal});
    const auto listening = listener(replayed.size());
    const Ended sent = runForetouch(publishWords(joined({"--url", kUrl}, howToSend)));
    ASSERT_EQ(sent.exitCode, 0) << sent.err;
    const Ended heard = listening->ended();
    EXPECT_EQ(heard.exitCode, 0) << heard.err;
    EXPECT_EQ(heard.err, "");
    expectReplayed(answersIn(heard.out), replayed);
    expectEndsInOrder(*serving);
    const Ended again = replayedLog(journal);
    EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
    const std::string all = std::to_string(replayed.size());
    EXPECT_TRUE(holds(again.out, all + " of " + all + " verdicts equal the journal's"))
        << again.out;
  }

  TempFolder folder_;
  Stage stage_;
};

TEST_F(StreamPrograms, AnswerTheBundledClipAsItsReplayDoes) {
  runOnce({"--speed", "8"});
}

TEST_F(StreamPrograms, AnswerARecordedClipInARealKitchenAsItsReplayDoes) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/bandai1_kick_normal_001.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/kitchen_fatihrmutfak.ply");
  stage_ = {*clip,
            folder_ / "kick.avatar.json",
            {"--scale", "0.01", "--place", "1,0.02,-1"},
            {"--scene", *scene, "--up", "z"}};
  const Ended made = runForetouch({"avatar", "bvh", *clip, "--scale", "0.01", "-o", stage_.avatar});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  runOnce({"--speed", "4"});
}

// The answers are those without a solid avatar; what is shown is certified, and its journal repeats
// it, with the same options only.
TEST_F(StreamPrograms, ShowASolidAvatarThatItsJournalRepeats) {
  const std::vector<std::string> replayed = replayedClip();
  const std::string journal = folder_ / "journal.lcmlog", lines = folder_ / "again.jsonl";
  const auto serving = service({"--solid", "--log", journal});
  const auto listening = listener(replayed.size());
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "4"})).exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  EXPECT_EQ(heard.err, "");
  expectReplayed(answersIn(heard.out), replayed);
  expectEndsInOrder(*serving);
  const std::vector<json> shown = eventsOf(heard.out, "solid");
  // The listener leaves with the last answer; what is shown there comes after it.
  ASSERT_GE(shown.size() + 1, replayed.size());
  std::size_t certified = 0;
  for (const json& one : shown) certified += one["certified"].get<bool>() ? 1 : 0;
  EXPECT_GT(certified, shown.size() / 2);

  const auto again = [&](const Words& more) {
    return runForetouch(
        joined(joined({"replay", "--avatar", stage_.avatar, "--motion", journal, "--output", lines},
                      stage_.ofScene),
               more));
  };
  const std::string all = std::to_string(replayed.size());
  const Ended equal = again({"--solid"});
  EXPECT_EQ(equal.exitCode, 0) << equal.out << equal.err;
  EXPECT_TRUE(holds(equal.out, all + " of " + all + " verdicts equal the journal's")) << equal.out;
  EXPECT_TRUE(holds(equal.out, all + " of " + all + " shown poses equal the journal's"))
      << equal.out;
  EXPECT_EQ(eventsOf(contentOf(lines), "solid").size(), replayed.size());
  const Ended other = again({"--solid", "--solid-skin", "0.004"});
  EXPECT_EQ(other.exitCode, 1) << other.out << other.err;
  EXPECT_TRUE(holds(other.out, "is shown differently: the skin is 0.002 in the log, 0.004 here"))
      << other.out;
  const Ended without = again({});
  EXPECT_EQ(without.exitCode, 0) << without.out << without.err;
  EXPECT_TRUE(holds(without.out, "the log also has " + all + " shown poses")) << without.out;
}

// A world file sent, served and heard is told as it is replayed.
TEST_F(StreamPrograms, TellWhatHappensInAMovingWorld) {
  const std::string world = std::string(FORETOUCH_EXAMPLE_FOLDER) + "/stage.toml";
  const ProgramRun serving({"serve", "--world", world, "--url", kUrl});
  ASSERT_TRUE(waitFor([&] { return holds(serving.outSoFar(), "ready\n"); })) << serving.errSoFar();
  ProgramRun listening(
      {"listen", "--world", world, "--json", "--status", "--url", kUrl, "--timeout", "3"});
  ASSERT_TRUE(waitFor([&] { return holds(listening.outSoFar(), "\"status\""); }))
      << listening.errSoFar();
  ASSERT_EQ(runForetouch({"publish", "--world", world, "--url", kUrl}).exitCode, 0);
  const Ended heard = listening.ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  std::vector<json> told;
  json header;
  for (const std::string& line : linesOf(heard.out)) {
    json one = json::parse(line);
    if (one.count("format") != 0) header = one;
    if (one.count("event") != 0) told.push_back(std::move(one));
  }
  ASSERT_FALSE(header.is_null());
  EXPECT_EQ(header["format"], "foretouch-events");
  EXPECT_EQ(header["bodies"].size(), 4U);

  const std::string events = folder_ / "events.jsonl";
  ASSERT_EQ(
      runForetouch({"world", "replay", world, "-o", folder_ / "world.jsonl", "--events", events})
          .exitCode,
      0);
  std::vector<json> replayed;
  for (const std::string& line : linesOf(contentOf(events))) {
    json one = json::parse(line);
    if (one.count("event") != 0 && one.count("trigger") == 0) replayed.push_back(std::move(one));
  }
  // The network may lose something, and nobody answers beyond the last receipt.
  ASSERT_GT(told.size(), replayed.size() * 8 / 10);
  const double begin = told.front()["time"].get<double>() - replayed.front()["time"].get<double>();
  std::size_t same = 0;
  for (const json& one : told) {
    const bool isThere = std::any_of(replayed.begin(), replayed.end(), [&](const json& other) {
      return one["event"] == other["event"] &&
             one["a"].value("link", "") == other["a"].value("link", "") &&
             one["a"]["body"] == other["a"]["body"] &&
             std::abs(one["time"].get<double>() - begin - other["time"].get<double>()) < 0.002;
    });
    same += isThere ? 1 : 0;
  }
  EXPECT_GT(same, told.size() * 9 / 10);
}

// What a solid body of the world shows, enters and is pushed by is sent, heard, and repeated from
// the journal.
TEST_F(StreamPrograms, TellWhatASolidBodyOfAWorldShows) {
  const std::string world = std::string(FORETOUCH_EXAMPLE_FOLDER) + "/stage.toml";
  const std::string journal = folder_ / "journal.lcmlog";
  ProgramRun serving({"serve", "--world", world, "--solid", "--world-solid", "ben", "--url", kUrl,
                      "--log", journal});
  ASSERT_TRUE(waitFor([&] { return holds(serving.outSoFar(), "ready\n"); })) << serving.errSoFar();
  ProgramRun listening(
      {"listen", "--world", world, "--json", "--status", "--url", kUrl, "--timeout", "3"});
  ProgramRun reading({"listen", "--world", world, "--url", kUrl, "--timeout", "3"});
  ASSERT_TRUE(waitFor([&] { return holds(listening.outSoFar(), "\"status\""); }))
      << listening.errSoFar();
  ASSERT_EQ(runForetouch({"publish", "--world", world, "--url", kUrl}).exitCode, 0);
  const Ended heard = listening.ended(), read = reading.ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  // Who is not solid in the world is so by himself.
  const std::vector<json> pushes = eventsOf(heard.out, "pushes");
  std::size_t ofWorld = 0, certified = 0, byItself = 0;
  for (const json& one : eventsOf(heard.out, "solid")) {
    byItself += one["avatar"] == 1 ? 1 : 0;
    if (one["avatar"] != 2) continue;
    ++ofWorld;
    certified += one["certified"].get<bool>() ? 1 : 0;
  }
  EXPECT_GT(byItself, 300U);
  EXPECT_GT(ofWorld, 100U);
  EXPECT_GT(certified, ofWorld / 2);
  EXPECT_GE(pushes.size() + 5, ofWorld);
  EXPECT_TRUE(std::all_of(pushes.begin(), pushes.end(),
                          [](const json& one) { return one["avatar"] == 2; }));
  EXPECT_TRUE(holds(read.out, "avatar 2, pose ")) << read.out;
  expectEndsInOrder(serving);
  const Ended again = runForetouch(
      {"log", "replay", journal, "--world", world, "--solid", "--world-solid", "ben", "--json"});
  EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
  const json found = json::parse(again.out);
  EXPECT_EQ(found["agrees"], true) << found;
  EXPECT_GE(found["shown"].get<std::size_t>(), ofWorld);
  EXPECT_EQ(found["shown_equal"], found["shown"]);
  EXPECT_EQ(found["pushes_equal"], found["shown"]);

  const Ended all = runForetouch({"serve", "--world", world, "--solid", "--world-solid", "*"});
  EXPECT_EQ(all.exitCode, 2);
  EXPECT_TRUE(holds(all.err, "'anna' carries 'ball'")) << all.err;
  const Ended bare = runForetouch(joined(
      {"serve", "--avatar", stage_.avatar, "--solid", "--world-solid", "ben"}, stage_.ofScene));
  EXPECT_EQ(bare.exitCode, 2);
  EXPECT_TRUE(holds(bare.err, "--world-solid")) << bare.err;
}

TEST_F(StreamPrograms, AreRecordedByLcmLogger) {
  const std::string log = folder_ / "recorded.lcmlog";
  const std::vector<std::string> replayed = replayedClip();
  const auto serving = service();
  ProgramRun logger({std::string("--lcm-url=") + kUrl, "-q", log}, {}, "", "lcm-logger");
  ASSERT_TRUE(waitFor([&] { return holds(contentOf(log), "FORETOUCH_STATUS"); }))
      << logger.errSoFar();
  const auto listening = listener(replayed.size());
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "8"})).exitCode, 0);
  EXPECT_EQ(listening->ended().exitCode, 0);
  expectEndsInOrder(*serving);  // its last heartbeat comes after all answers
  const std::string last = "\"answered\":" + std::to_string(replayed.size());
  const std::string lines = folder_ / "recorded.jsonl";
  EXPECT_TRUE(waitFor([&] {
    const Ended converted = runForetouch({"log", "convert", log, "-o", lines});
    return converted.exitCode == 0 && holds(contentOf(lines), last);
  }));
  logger.send(SIGINT);
  logger.ended();
  const Ended again = replayedLog(log);
  EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
  const std::string all = std::to_string(replayed.size());
  EXPECT_TRUE(holds(again.out, all + " of " + all + " verdicts equal the journal's")) << again.out;
  std::vector<std::string> answers = linesOf(contentOf(folder_ / "log.jsonl"));
  answers.erase(answers.begin());  // the header
  expectReplayed(answers, replayed);
}

TEST_F(StreamPrograms, AreFedByLcmLogplayer) {
  const std::string log = folder_ / "sent.lcmlog";
  const std::vector<std::string> replayed = replayedClip();
  ASSERT_EQ(runForetouch(publishWords({"--output", log})).exitCode, 0);
  const auto serving = service();
  const auto listening = listener(replayed.size());
  ProgramRun player({std::string("--lcm-url=") + kUrl, "-s", "8", log}, {}, "", "lcm-logplayer");
  EXPECT_EQ(player.ended().exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  expectReplayed(answersIn(heard.out), replayed);
  expectEndsInOrder(*serving);
}

TEST_F(StreamPrograms, AreReadByAPlainSubscriberOfLcm) {
  const std::vector<std::string> replayed = replayedClip();
  const auto serving = service();
  ProgramRun subscriber({kUrl, std::to_string(replayed.size())}, {}, "",
                        FORETOUCH_PLAIN_SUBSCRIBER);
  ASSERT_TRUE(waitFor([&] { return holds(subscriber.outSoFar(), "status"); }))
      << subscriber.errSoFar();
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "8"})).exitCode, 0);
  const Ended heard = subscriber.ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  std::vector<std::string> lines;
  for (const std::string& line : linesOf(heard.out)) {
    if (line.rfind("contacts ", 0) == 0) lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), replayed.size());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::string expected = "contacts " + std::to_string(i);
    const json contacts = json::parse(replayed[i])["contacts"];
    expected += " " + std::to_string(contacts.size());
    for (const json& contact : contacts) expected += " " + contact["link"].get<std::string>();
    EXPECT_EQ(lines[i], expected);
  }
  expectEndsInOrder(*serving);
}

TEST_F(StreamPrograms, AreNotHeldUpByAListenerThatStalls) {
  const std::vector<std::string> replayed = replayedClip();
  const auto serving = service();
  const auto stalled = listener(replayed.size());
  const auto listening = listener(replayed.size());
  stalled->send(SIGSTOP);
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "8"})).exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  expectReplayed(answersIn(heard.out), replayed);
  // What the system kept for the one that slept, it still hears.
  stalled->send(SIGCONT);
  EXPECT_EQ(stalled->ended().exitCode, 0);
  expectEndsInOrder(*serving);
}

// As a full disk: from some byte on every write fails. Answers go on, and the status says what was
// not recorded; what was, is whole.
TEST_F(StreamPrograms, GoOnWhereTheLogCannotGrow) {
  const std::vector<std::string> replayed = replayedClip();
  const std::string journal = folder_ / "small.lcmlog";
  Words words = {"-c", "ulimit -f 200; exec \"$0\" \"$@\"", FORETOUCH_PROGRAM};
  ProgramRun serving(joined(words, serveWords({"--log", journal})), {}, "", "sh");
  ASSERT_TRUE(waitFor([&] { return holds(serving.outSoFar(), "ready\n"); })) << serving.errSoFar();
  const auto listening = listener(replayed.size());
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "8"})).exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  expectReplayed(answersIn(heard.out), replayed);
  serving.send(SIGTERM);
  const Ended ended = serving.ended();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.err, journal)) << ended.err;
  EXPECT_FALSE(holds(ended.out + ended.err, " 0 events not recorded")) << ended.out;
  EXPECT_EQ(runForetouch({"log", "check", journal}).exitCode, 0);
}

// Every write to the log comes short, fails, or stalls for an hour (write_shim.c): answers go on,
// and the service ends when it is told to.
TEST_F(StreamPrograms, AnswerWhateverTheDiskDoes) {
  if (std::string(FORETOUCH_SANITIZED) != "") GTEST_SKIP() << "a sanitizer wants to be first";
  const std::vector<std::string> replayed = replayedClip();
  for (const std::string fault : {"none", "short", "full", "stall"}) {
    SCOPED_TRACE(fault);
    const std::string journal = folder_ / (fault + ".lcmlog");
    const auto serving = service(
        {"--log", journal},
        {std::string("LD_PRELOAD=") + FORETOUCH_WRITE_SHIM, "FORETOUCH_WRITE_FAULT=" + fault});
    const auto listening = listener(replayed.size());
    ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "8"})).exitCode, 0);
    const Ended heard = listening->ended();
    EXPECT_EQ(heard.exitCode, 0) << heard.err;
    expectReplayed(answersIn(heard.out), replayed);
    serving->send(SIGTERM);
    const Ended ended = serving->ended();
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    const bool isWhole = fault == "none" || fault == "short";
    EXPECT_EQ(holds(ended.out, ", 0 events not recorded"), isWhole) << ended.out;
    if (!isWhole) continue;
    const Ended again = replayedLog(journal);
    EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
  }
}

TEST_F(StreamPrograms, SignWhatTheySayAndHearNothingElse) {
  const std::vector<std::string> replayed = replayedClip();
  const Words key{"--key", folder_.write("key", "000102030405060708090a0b0c0d0e0f\n")};
  const Words otherKey{"--key", folder_.write("other", "100102030405060708090a0b0c0d0e0f\n")};
  for (const Words& words : {key, otherKey}) {
    ASSERT_EQ(::chmod(words[1].c_str(), 0600), 0);
  }
  const std::string journal = folder_ / "journal.lcmlog";
  const auto serving = service(joined(key, {"--log", journal}));
  const auto listening = listener(replayed.size(), key);
  for (const Words& words : {Words{}, otherKey}) {
    ASSERT_EQ(runForetouch(publishWords(joined({"--url", kUrl, "--speed", "0"}, words))).exitCode,
              0);
  }
  ASSERT_EQ(runForetouch(publishWords(joined({"--url", kUrl, "--speed", "8"}, key))).exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  EXPECT_EQ(heard.err, "");
  expectReplayed(answersIn(heard.out), replayed);
  EXPECT_TRUE(holds(heard.out, "\"unauthenticated\"")) << heard.out;
  expectEndsInOrder(*serving);
  EXPECT_EQ(replayedLog(journal).exitCode, 0);
}

// Somebody else on this machine publishes for the same avatar, again and again, each time as a
// later session: none of it is answered while the first one speaks.
TEST_F(StreamPrograms, AreBoundToWhoSpeaksFirst) {
  const std::vector<std::string> replayed = replayedClip();
  const std::string journal = folder_ / "journal.lcmlog";
  const auto serving = service({"--log", journal});
  const auto listening = listener(replayed.size());
  ProgramRun speaker(publishWords({"--url", kUrl, "--speed", "1"}));
  ASSERT_TRUE(waitFor([&] { return answersIn(listening->outSoFar()).size() > 5; }));
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "0"})).exitCode, 0);
  }
  EXPECT_LT(answersIn(listening->outSoFar()).size(), replayed.size());  // it still speaks
  EXPECT_EQ(speaker.ended().exitCode, 0);
  const Ended heard = listening->ended();
  EXPECT_EQ(heard.exitCode, 0) << heard.err;
  expectReplayed(answersIn(heard.out), replayed);
  EXPECT_TRUE(holds(heard.out, "\"other-sender\"")) << heard.out;
  expectEndsInOrder(*serving);
  EXPECT_EQ(replayedLog(journal).exitCode, 0);
}

TEST_F(StreamPrograms, EndWhenToldTo) {
  // Nobody answers: silence ends a listener, and with a number of answers wanted that is a no.
  EXPECT_EQ(runForetouch({"listen", "--url", kUrl, "--timeout", "0.2"}).exitCode, 0);
  const Ended waited = runForetouch({"listen", "--url", kUrl, "--timeout", "0.2", "--count", "3"});
  EXPECT_EQ(waited.exitCode, 1);
  EXPECT_TRUE(holds(waited.err, "0 of 3 verdicts")) << waited.err;
  for (const Words& words :
       {Words{"listen", "--url", kUrl}, publishWords({"--url", kUrl, "--loop"})}) {
    ProgramRun run(words);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    run.send(SIGINT);
    const Ended ended = run.ended();
    EXPECT_EQ(ended.exitCode, 0) << words[0] << ended.err;
  }
}

/// A contact as listeners and viewers both tell of it: whose, when, and what is touched how.
std::string contactKey(const json& avatar, const json& sequence, const std::string& link,
                       json contact) {
  for (const char* const field : {"link", "sequence", "time"}) contact.erase(field);
  return json{avatar, sequence, link, contact}.dump();
}

/// The data of events of this name.
std::vector<json> eventsIn(const std::string& text, const std::string& name) {
  std::vector<json> events;
  const std::string begin = "event: " + name + "\ndata: ";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    const std::size_t end = text.find("\n\n", from);
    if (end == std::string::npos) break;
    events.push_back(json::parse(text.substr(from, end - from)));
  }
  return events;
}

TEST_F(StreamPrograms, ShowViewersEveryContactThatListenersHear) {
  const std::vector<std::string> replayed = replayedClip();
  const auto serving = service({"--view"});
  constexpr std::uint16_t kPort = 9465;  // the documented one
  EXPECT_TRUE(holds(serving->outSoFar(), "http://127.0.0.1:9465/")) << serving->outSoFar();
  const std::string page = get(kPort, "/");
  EXPECT_EQ(statusOf(page), 200);
  EXPECT_TRUE(holds(page, "<!doctype html>") || holds(page, "<!DOCTYPE html>"));
  const std::string answer = get(kPort, "/view.json");
  ASSERT_EQ(statusOf(answer), 200);
  const json document = json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  EXPECT_EQ(document["format"], "foretouch-view");
  EXPECT_EQ(document["kind"], "live");
  EXPECT_EQ(document["live"]["events"], "/events");
  const json links = document["avatars"][0]["links"];
  EXPECT_FALSE(document["scene"]["objects"].empty());

  Connection viewer(kPort);
  viewer.send("GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::string seen = viewer.receivedUpTo("event: status\ndata: ");
  const auto listening = listener(replayed.size());
  // Slower than the bound of shown steps, then many times as fast.
  ASSERT_EQ(runForetouch(publishWords({"--url", kUrl, "--speed", "12"})).exitCode, 0);
  const Ended heard = listening->ended();
  ASSERT_EQ(heard.exitCode, 0) << heard.err;
  const std::vector<std::string> lines = answersIn(heard.out);
  ASSERT_EQ(lines.size(), replayed.size());
  const json last = json::parse(lines.back());
  seen += viewer.receivedUpTo("\"sequence\":" + last["sequence"][1].dump() + ",\"utime\"");
  seen += viewer.receivedUpTo("event: status");
  expectEndsInOrder(*serving);  // with the viewer there
  seen += viewer.received();

  std::vector<std::string> told, shown;
  for (const std::string& line : lines) {
    const json heardOf = json::parse(line);
    for (const json& contact : heardOf["contacts"]) {
      told.push_back(
          contactKey(heardOf["avatar"], heardOf["sequence"][1], contact["link"], contact));
    }
  }
  std::size_t steps = 0, events = 0;
  for (const json& step : eventsIn(seen, "step")) {
    ++events;
    steps += 1 + step["skipped"].get<std::size_t>();
    EXPECT_EQ(step["from"].size(), 7 * links.size());
    EXPECT_EQ(step["to"].size(), 7 * links.size());
    EXPECT_LE(step["t0"].get<double>(), step["t1"].get<double>());
    for (const json& contact : step["contacts"]) {
      shown.push_back(contactKey(step["avatar"], contact["sequence"],
                                 links[contact["link"].get<std::size_t>()]["name"], contact));
    }
  }
  EXPECT_EQ(shown, told);  // in order, too
  EXPECT_GT(told.size(), 10u);
  EXPECT_EQ(steps, lines.size());
  EXPECT_LT(events, steps);  // some were skipped
  const std::vector<json> statuses = eventsIn(seen, "status");
  ASSERT_GT(statuses.size(), 1u);
  EXPECT_EQ(statuses.front()["viewers"], 1);
  EXPECT_EQ(statuses.back()["answered"], lines.size());
}

TEST_F(StreamPrograms, NameAUrlThatIsNone) {
  const Ended listening = runForetouch({"listen", "--url", "tcpq://localhost:7700"});
  EXPECT_EQ(listening.exitCode, 2);
  EXPECT_TRUE(holds(listening.err, "tcpq://localhost:7700: expected udpm://")) << listening.err;
  EXPECT_EQ(runForetouch(publishWords({"--url", "udpm://10.0.0.1:7667"})).exitCode, 2);
  // The environment's URL is what every LCM program takes.
  const Ended named = runForetouch({"listen", "--timeout", "0.1"}, {"LCM_DEFAULT_URL=tcpq://here"});
  EXPECT_EQ(named.exitCode, 2);
}

}  // namespace
}  // namespace foretouch::test
