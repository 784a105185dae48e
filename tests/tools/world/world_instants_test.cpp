// Tests that every time of a world file, and of the options beside it, is the microsecond that its
// text says: by arithmetic on the digits, which has no doubles in it.
#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/world/small_stage.h"

namespace foretouch::test {
namespace {

constexpr std::int64_t kMostUs = 1'000'000'000;

/// So many microseconds as seconds, without rounding: at least `least` digits behind the point.
std::string secondsText(std::int64_t us, std::size_t least = 1) {
  std::string digits = std::to_string(us);
  if (digits.size() < 7) digits.insert(0, 7 - digits.size(), '0');
  std::string fraction = digits.substr(digits.size() - 6);
  while (fraction.size() > least && fraction.back() == '0') fraction.pop_back();
  return digits.substr(0, digits.size() - 6) + "." + fraction;
}

/// The nearest microsecond, by its digits.
std::int64_t microsecondsIn(const std::string& text) {
  const std::size_t point = text.find('.');
  std::string digits = text.substr(point + 1);
  digits.resize(std::max<std::size_t>(digits.size(), 7), '0');
  const std::int64_t whole = std::stoll(text.substr(0, point) + digits.substr(0, 6));
  return whole + (digits[6] >= '5' ? 1 : 0);
}

/// Instants as people write them, a tenth of them finer than a microsecond.
class Instants {
 public:
  explicit Instants(unsigned seed) : random_(seed) {}
  std::string next() {
    const std::int64_t us = std::uniform_int_distribution<std::int64_t>(0, kMostUs)(random_);
    if (us % 10 != 0) return secondsText(us);
    // Not a half: which microsecond is nearest is then no question.
    return secondsText(us, 6) + std::string(1, "12346789"[us / 10 % 8]) + "25";
  }

 private:
  std::mt19937 random_;
};

TEST(WorldInstants, AreTheMicrosecondsOfTheirText) {
  Instants instants(1);
  for (int i = 0; i < 2000; ++i) {
    const std::string text = instants.next(), time = "time = " + text + "\n";
    const std::int64_t right = microsecondsIn(text);
    const auto parsed = tools::parseWorldFile(
        "format = \"foretouch-world\"\nversion = 1\n"
        "[[body]]\nname = \"a\"\nsphere = 1\n[[body.pose]]\n" +
            time + "yaw = 0\n[[body.attach]]\n" + time + "to = \"b\"\n" +
            "[[body]]\nname = \"b\"\nsphere = 1\n[[body.detach]]\n" + time +
            "[[body]]\nname = \"c\"\nsphere = 1\n[body.clip]\nfile = \"c.bvh\"\nstart = " + text +
            "\nfrom = " + text + "\nuntil = " + text +
            "\n[[trigger]]\nname = \"d\"\nsphere = 1\n[[trigger.pose]]\n" + time + "yaw = 0\n",
        "w.toml");
    ASSERT_TRUE(parsed.ok()) << text << describe(parsed.error());
    const auto& bodies = parsed.value().bodies;
    EXPECT_EQ(bodies[0].poses[0].utimeUs, right) << text;
    EXPECT_EQ(bodies[0].changes[0].utimeUs, right) << text;
    EXPECT_EQ(bodies[1].changes[0].utimeUs, right) << text;
    EXPECT_EQ(bodies[2].timing.startUs, right) << text;
    EXPECT_EQ(bodies[2].timing.fromUs, right) << text;
    EXPECT_EQ(bodies[2].timing.untilUs, right) << text;
    EXPECT_EQ(bodies[3].poses[0].utimeUs, right) << text;
  }
}

TEST(WorldInstants, OfATableAreAsWell) {
  const SmallStage stage;
  Instants instants(2);
  std::set<std::pair<std::int64_t, std::string>> rows;
  for (int i = 0; i < 1000; ++i) {
    const std::string text = instants.next();
    rows.emplace(microsecondsIn(text), text);
  }
  std::string csv = "time,x,y,z\n";
  for (const auto& [us, text] : rows) csv += text + ",0,0,0\n";
  stage.folder.write("ball.csv", csv);
  const auto world = stage.load(sphereNamed("ball", "poses = \"ball.csv\"\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  EXPECT_EQ(world.value().beginUs, rows.begin()->first);
  EXPECT_EQ(world.value().endUs, rows.rbegin()->first);
  const Track& track = world.value().bodies[0].stretches[0].track;
  ASSERT_EQ(track.numKnots(), rows.size());
  std::int64_t us = track.knownFromUs();
  for (const auto& [right, text] : rows) {
    EXPECT_EQ(us, right) << text;
    us = track.nextKnotUs(us);
  }
}

TEST(WorldInstants, ThatAWorldBeginsAndEndsAtCanBeAskedFor) {
  const SmallStage stage;
  Instants instants(3);
  for (int i = 0; i < 24; ++i) {
    std::string first = instants.next(), last = instants.next();
    if (microsecondsIn(last) < microsecondsIn(first)) std::swap(first, last);
    const std::string path = stage.write(
        sphereNamed("a", "[[body.pose]]\ntime = " + first +
                             "\nyaw = 0\n[[body.pose]]\ntime = " + last + "\nyaw = 0\n"));
    const std::string out = stage.folder / "out.jsonl";
    const Ended ended =
        runForetouch({"world", "replay", path, "--from", first, "--until", last, "-o", out});
    ASSERT_EQ(ended.exitCode, 0) << first << " " << last << " " << ended.err;
    const std::string text = contentOf(out);
    const auto header = nlohmann::json::parse(text.substr(0, text.find('\n')));
    EXPECT_EQ(header["until"], std::stod(secondsText(microsecondsIn(last))));
    // What the results say can be typed again.
    const Ended again = runForetouch({"world", "replay", path, "--from", header["from"].dump(),
                                      "--until", header["until"].dump(), "-o", out});
    EXPECT_EQ(again.exitCode, 0) << again.err;
    const std::string after = secondsText(microsecondsIn(last) + 1);
    const Ended beyond = runForetouch({"world", "replay", path, "--until", after, "-o", out});
    EXPECT_EQ(beyond.exitCode, 2);
    EXPECT_TRUE(holds(beyond.err, "found " + nlohmann::json(std::stod(after)).dump()))
        << beyond.err;
  }
}

TEST(WorldInstants, BeyondAllTimeAreRefused) {
  const SmallStage stage;
  const std::string path = stage.write(sphereNamed("a", ""));
  const Ended ended =
      runForetouch({"world", "replay", path, "--until", "1e300", "-o", stage.folder / "o.jsonl"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "--until: expected a number of seconds within 285 years of zero"))
      << ended.err;
}

}  // namespace
}  // namespace foretouch::test
