// tests/tools/solid/solid_check_test.cpp: files of shown poses whose marks are all true, as
// somebody may make them who knows the format: only the query tells those that are not sound.
#include "tools/solid/solid_check.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tests/tools/small_inputs.h"
#include "tools/solid/solid_lines.h"
#include "tools/solid/solid_reader.h"
#include "tools/solid/solid_summary.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using tools::CheckedSolid;
using tools::PlayedTick;
using tools::SolidRecord;

/// The wall at x = 0 reaches from -2 to 2 in y and z: above it there is a way to the other side.
class SolidFile : public testing::Test {
 protected:
  SolidFile() : inputs_(smallInputs({-0.5, -0.5, 0.5})) {
    inputs_.request.scenePath = folder_ / "wall.obj";
    inputs_.request.avatarPath = folder_ / "man.json";
    inputs_.request.motionPath = folder_ / "clip.bvh";
    for (const char* const name : {"wall.obj", "man.json", "clip.bvh"}) folder_.write(name, name);
    options_ = tools::completedOptions(inputs_, {}).value();
  }

  [[nodiscard]] Pose at(double x, double y) const {
    Pose pose = restPose(inputs_.avatar.skeleton());
    pose.translations[0] = Vector3d(x, y, 0.0);
    return pose;
  }
  /// A tick that shows the last pose of its way; without one it appears there.
  [[nodiscard]] PlayedTick tick(std::int64_t number, std::vector<Pose> way,
                                SolidState state = SolidState::Following) const {
    PlayedTick played;
    played.tick = number;
    played.timeS = inputs_.timeOfStep(number);
    played.answer.shown = played.tracked = way.back();
    played.answer.state = state;
    played.answer.isCertified = state != SolidState::Placing;
    played.answer.hasAppeared = number == 0;
    played.answer.numWay = way.size();
    for (std::size_t i = 0; i < way.size(); ++i) {
      const double t = static_cast<double>(i + 1) / static_cast<double>(way.size());
      played.answer.times.push_back(played.answer.hasAppeared ? 0.0 : t);
    }
    played.answer.clearance = 1e-4;
    played.answer.linkDeviation = {0.0, 0.0};
    played.answer.deviation = 0.0;
    played.answer.joints.assign(2, SolidJointState::Free);
    played.answer.way = std::move(way);
    return played;
  }
  [[nodiscard]] std::vector<PlayedTick> around() const {
    return {tick(0, {at(-0.5, 0.0)}, SolidState::Equal), tick(1, {at(-0.4, 0.0)}),
            tick(2, {at(-0.4, 3.0), at(0.4, 3.0), at(0.4, 0.0)})};
  }

  void write(const std::vector<PlayedTick>& ticks) {
    tools::SolidLines lines(inputs_, options_);
    std::string text = lines.header().value();
    tools::SolidSummary summary(inputs_);
    for (const PlayedTick& played : ticks) {
      text += lines.line(played);
      summary.add(played);
    }
    folder_.write("shown.jsonl", text + lines.last(summary.fields()));
  }
  [[nodiscard]] std::vector<SolidRecord> read() {
    auto reader = tools::SolidReader::open(folder_ / "shown.jsonl").value();
    EXPECT_TRUE(reader.isHeaderMarkTrue());
    std::vector<SolidRecord> records;
    while (auto record = reader.next().value()) records.push_back(std::move(*record));
    EXPECT_TRUE(reader.isComplete());
    return records;
  }
  /// What is wrong; empty: nothing.
  [[nodiscard]] std::string faultOf(const std::vector<PlayedTick>& ticks) {
    write(ticks);
    auto reader = tools::SolidReader::open(folder_ / "shown.jsonl").value();
    const auto query =
        tools::queryOf(reader.header(), inputs_.avatar, inputs_.scene, "shown.jsonl").value();
    auto check =
        tools::SolidCheck::build(inputs_.avatar, inputs_.scene, query, reader.header().tolerance)
            .value();
    for (const SolidRecord& record : read()) {
      EXPECT_TRUE(record.isMarkTrue);
      if (!check.take(record)) {
        const auto& finding = *check.checked().finding;
        return std::to_string(finding.tick) + ": " + finding.text;
      }
    }
    checked_ = check.checked();
    return "";
  }

  TempFolder folder_;
  tools::ReplayInputs inputs_;
  SolidOptions options_;
  CheckedSolid checked_;
};

TEST_F(SolidFile, OfAWayAroundTheWallIsSound) {
  EXPECT_EQ(faultOf(around()), "");
  EXPECT_EQ(checked_.ticks, 3);
  EXPECT_EQ(checked_.motions, 5);  // the first place, and four pieces
}

TEST_F(SolidFile, WithAPieceLeftOutIsFound) {
  auto ticks = around();
  ticks[2] = tick(2, {at(-0.4, 3.0), at(0.4, 0.0)});
  const std::string fault = faultOf(ticks);
  EXPECT_EQ(fault.rfind("2: on piece 1 of its way", 0), 0u) << fault;
  EXPECT_NE(fault.find("meets 'wall'"), std::string::npos) << fault;
}

TEST_F(SolidFile, WithAPoseThroughTheWallIsFound) {
  auto ticks = around();
  ticks[1] = tick(1, {at(-0.05, 0.0)});
  const std::string fault = faultOf(ticks);
  EXPECT_EQ(fault.rfind("1: on piece 0 of its way", 0), 0u) << fault;
}

TEST_F(SolidFile, ThatBeginsInsideIsFound) {
  auto ticks = around();
  ticks[0] = tick(0, {at(0.0, 0.0)}, SolidState::Equal);
  EXPECT_EQ(faultOf(ticks).rfind("0: where the curve begins", 0), 0u);
}

TEST_F(SolidFile, WithAFlagSetIsFound) {
  auto ticks = around();
  ticks[1].answer.isCertified = false;
  EXPECT_NE(faultOf(ticks).find("1: it is not certified, but following"), std::string::npos);
  ticks = around();
  ticks[1].answer.hasAppeared = true;  // as if it might jump there
  EXPECT_NE(faultOf(ticks).find("1: the curve begins anew"), std::string::npos);
  ticks = around();
  ticks[1].answer.state = SolidState::Equal;
  ticks[1].tracked = at(0.3, 0.0);
  EXPECT_NE(faultOf(ticks).find("1: it is equal, but"), std::string::npos);
  ticks[1].tracked = at(-0.4, -0.03);  // below the floor, and lifted
  EXPECT_NE(faultOf(ticks).find("1: it is equal, but"), std::string::npos);
  ticks[1].answer.lift = 0.03;
  EXPECT_EQ(faultOf(ticks), "");
  ticks = around();
  ticks[2].answer.deviation = 0.25;
  EXPECT_NE(faultOf(ticks).find("2: its deviation"), std::string::npos);
  ticks = around();
  ticks[2].answer.times = {0.5, 0.4, 1.0};
  EXPECT_NE(faultOf(ticks).find("2: the times of its way"), std::string::npos);
  ticks = around();
  std::swap(ticks[1], ticks[2]);
  EXPECT_NE(faultOf(ticks).find("expected tick 1"), std::string::npos);
}

TEST_F(SolidFile, WithAWayThatBeginsElsewhereIsFound) {
  auto ticks = around();
  write(ticks);
  auto records = read();
  // Of another curve: the pose shown before is another one by the last bit.
  ticks[1] = tick(1, {at(std::nextafter(-0.4, 0.0), 0.0)});
  write(ticks);
  const auto others = read();
  records[1] = others[1];
  auto check =
      tools::SolidCheck::build(inputs_.avatar, inputs_.scene, QueryOptions{}, 5e-4).value();
  EXPECT_TRUE(check.take(records[0]));
  EXPECT_TRUE(check.take(records[1]));
  EXPECT_FALSE(check.take(records[2]));
  EXPECT_NE(check.checked().finding->text.find("bit for bit"), std::string::npos);
}

TEST_F(SolidFile, HasEveryBitOfItsPoses) {
  Pose odd = at(-0.1234567890123456789, 1.0 / 3.0);
  odd.translations[1] = Vector3d(-0.0, 0.3 + std::numeric_limits<double>::epsilon(), 5e-324);
  odd.rotations[1] = Quaternion(std::sqrt(0.5), -0.0, -std::sqrt(0.5), 1e-17);
  auto ticks = around();
  ticks[1] = tick(1, {odd, at(-0.4, 0.0)});
  write(ticks);
  const std::vector<SolidRecord> records = read();
  ASSERT_EQ(records.size(), 3u);
  ASSERT_EQ(records[1].way.size(), 2u);
  EXPECT_TRUE(tools::areSamePoses(records[1].way[0], odd));
  EXPECT_EQ(tools::markOfPose(records[1].way[0]), tools::markOfPose(odd));
  // As docs/formats.md says, and xxhsum would with that seed.
  std::vector<double> numbers;
  for (const Quaternion& q : odd.rotations) {
    numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
  }
  for (const Eigen::Vector3d& p : odd.translations) {
    numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  }
  EXPECT_EQ(tools::markOfPose(odd),
            fmt::format("{:016x}", XXH64(numbers.data(), numbers.size() * sizeof(double),
                                         0xef46db3751d8e999u)));
  EXPECT_EQ(records[0].state, SolidState::Equal);
  EXPECT_TRUE(records[0].start.has_value());
}

TEST_F(SolidFile, OfPosesWithoutAPlaceClaimsNothing) {
  PlayedTick placing = tick(0, {at(0.0, 0.0)}, SolidState::Placing);
  placing.answer.numWay = 0;
  placing.answer.hasAppeared = false;
  PlayedTick placed = tick(1, {at(-0.4, 0.0)});
  placed.answer.hasAppeared = true;
  EXPECT_EQ(faultOf({placing, placed}), "");
  EXPECT_EQ(checked_.notCertified, 1);
  placing.answer.isCertified = true;
  EXPECT_NE(faultOf({placing, placed}).find("although it has no place yet"), std::string::npos);
}

TEST_F(SolidFile, ThatIsHostileIsRefusedWithItsLine) {
  write(around());
  const std::string whole = contentOf(folder_ / "shown.jsonl");
  const auto errorOf = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from, text.find("\"tick\":1,"));
    EXPECT_NE(at, std::string::npos) << from;
    folder_.write("shown.jsonl", text.replace(at, from.size(), to));
    auto reader = tools::SolidReader::open(folder_ / "shown.jsonl").value();
    EXPECT_TRUE(reader.next().ok());
    const auto record = reader.next();
    return record.ok() ? std::string() : describe(record.error());
  };
  EXPECT_NE(errorOf("\"state\":\"following\"", "\"state\":\"flying\"").find(":3: state"),
            std::string::npos);
  EXPECT_NE(errorOf("\"rotations\":[[1", "\"rotations\":[[1,2").find("four numbers per link"),
            std::string::npos);
  EXPECT_NE(errorOf("\"rotations\":[[", "\"rotations\":[[[[").find("expected one object of JSON"),
            std::string::npos);
  EXPECT_NE(errorOf("\"translations\":[", "\"translations\":[[1e999,0,0],").find(":3:"),
            std::string::npos);
  EXPECT_NE(errorOf("\"way\":[", "\"way\":[7,").find("way: expected objects"), std::string::npos);
  EXPECT_NE(errorOf("\"tick\":1", "\"tick\":\"1\"").find("tick: expected a whole number"),
            std::string::npos);
}

// What reads such values one in the other needs more of the machine's stack than there is.
TEST_F(SolidFile, NestedAMillionDeepIsRefused) {
  write(around());
  const std::string whole = contentOf(folder_ / "shown.jsonl");
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  for (const std::string field : {"format", "version", "self", "more"}) {
    folder_.write("shown.jsonl", "{\"" + field + "\":" + deep + "," + whole.substr(1));
    const auto reader = tools::SolidReader::open(folder_ / "shown.jsonl");
    ASSERT_FALSE(reader.ok()) << field;
    EXPECT_LT(describe(reader.error()).size(), 1000u);
  }
  const std::size_t end = whole.find('\n') + 1;
  folder_.write("shown.jsonl", whole.substr(0, end) + "{\"more\":" + deep + "}\n");
  auto reader = tools::SolidReader::open(folder_ / "shown.jsonl");
  ASSERT_TRUE(reader.ok());
  const auto record = reader.value().next();
  ASSERT_FALSE(record.ok());
  EXPECT_NE(describe(record.error()).find("nested at most"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
