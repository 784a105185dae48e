// The importer's stream: what the writer sends arrives, and nothing else is believed.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/protocol.h"

namespace foretouch::internal {
namespace {

using State = ImportReader::State;
using Eigen::Vector3d;

constexpr std::size_t kGreetingBytes = 16;
constexpr std::size_t kFrameHeadBytes = 8;

std::array<Vector3d, 3> triangleNumber(double i) {
  return {Vector3d(i, 0.1, -i), Vector3d(i, 1e-300, 2), Vector3d(-0.0, i, 1e300)};
}

/// The stream of a scene whose objects hold `counts` triangles.
std::string streamOf(const std::vector<std::uint64_t>& counts, const ImportTotals& extra = {}) {
  std::string stream;
  ImportWriter writer([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  ImportTotals totals = extra;
  for (const auto count : counts) totals.triangles += count;
  totals.objects = counts.size();
  writer.totals(totals);
  double number = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    writer.object("object " + std::to_string(i), counts[i]);
    for (std::uint64_t k = 0; k < counts[i]; ++k) writer.triangle(triangleNumber(number++));
  }
  EXPECT_TRUE(writer.finish());
  return stream;
}

State stateAfter(std::string_view bytes) {
  ImportReader reader;
  return reader.feed(bytes);
}

/// A frame as the child would send it.
std::string frame(std::uint32_t type, const std::string& payload) {
  const auto size = static_cast<std::uint32_t>(payload.size());
  std::string bytes(kFrameHeadBytes, '\0');
  std::memcpy(bytes.data(), &type, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  return bytes + payload;
}

std::string words(std::initializer_list<std::uint64_t> numbers) {
  std::string bytes;
  for (const std::uint64_t number : numbers) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return bytes;
}

std::string greeting() {
  return streamOf({}).substr(0, kGreetingBytes);
}

TEST(ImportReader, HandsOnWhatTheWriterWasGiven) {
  ImportTotals extra;
  extra.nodes = 11;
  extra.meshInstances = 12;
  extra.uniqueMeshes = 13;
  extra.skippedPrimitives = 14;
  extra.skippedFaces = 15;
  ImportReader reader;
  ASSERT_EQ(reader.feed(streamOf({1, 20000, 3}, extra)), State::Complete);
  const ImportedScene imported = reader.take();
  ASSERT_EQ(imported.scene.triangles.size(), 20004U);
  EXPECT_EQ(imported.scene.objectNames,
            (std::vector<std::string>{"object 0", "object 1", "object 2"}));
  for (std::size_t i = 0; i < 20004; ++i) {
    const auto expected = triangleNumber(static_cast<double>(i));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(imported.scene.triangles[i].vertices[k], expected[k]) << i;
    }
    ASSERT_EQ(imported.scene.objectOf[i], i == 0 ? 0 : i <= 20000 ? 1 : 2) << i;
  }
  EXPECT_EQ(imported.report.nodes, 11U);
  EXPECT_EQ(imported.report.meshInstances, 12U);
  EXPECT_EQ(imported.report.uniqueMeshes, 13U);
  EXPECT_EQ(imported.report.skippedPrimitives, 14U);
  EXPECT_EQ(imported.report.skippedFaces, 15U);
}

TEST(ImportReader, DoesNotCareHowTheStreamIsCut) {
  const std::string stream = streamOf({3, 9000, 1});
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const std::size_t longest = seed % 5 == 0 ? 10 : std::size_t{1} << (seed % 20);
    ImportReader reader;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size = 1 + random() % longest;
      reader.feed(std::string_view(stream).substr(at, size));
      at += size;
    }
    ASSERT_EQ(reader.state(), State::Complete) << seed;
    EXPECT_EQ(reader.take().scene.triangles.size(), 9004U);
  }
}

TEST(ImportReader, WaitsForTheRestOfEveryTruncatedStream) {
  const std::string stream = streamOf({2, 1});
  for (std::size_t size = 0; size < stream.size(); ++size) {
    ASSERT_EQ(stateAfter(stream.substr(0, size)), State::Reading) << size;
  }
}

TEST(ImportReader, CompletesNoStreamWithAChangedByte) {
  const std::string stream = streamOf({2, 1});
  for (std::size_t at = 0; at < stream.size(); ++at) {
    for (const int change : {1, 0x80, 0xFF}) {
      std::string changed = stream;
      changed[at] = static_cast<char>(changed[at] ^ change);
      ASSERT_NE(stateAfter(changed), State::Complete) << at << ' ' << change;
    }
  }
}

TEST(ImportReader, BreaksOffAtOnceOnGarbage) {
  EXPECT_EQ(stateAfter("Segmentation fault"), State::Broken);
  EXPECT_EQ(stateAfter("x"), State::Broken);
  EXPECT_EQ(stateAfter("FTIMPORT\x04"), State::Broken);  // another version
}

TEST(ImportReader, HandsOnWhatTheFileDeclares) {
  std::string stream;
  ImportWriter writer([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  FileFrame said;
  said.declared = {0.0254, UpAxis::Z, false};
  said.metresPerUnit = 0.0254;
  writer.totals({});
  writer.fileFrame(said);
  ASSERT_TRUE(writer.finish());
  ImportReader reader;
  ASSERT_EQ(reader.feed(stream), State::Complete);
  EXPECT_EQ(reader.fileFrame().declared.metresPerUnit, 0.0254);
  EXPECT_EQ(reader.fileFrame().declared.up, UpAxis::Z);
  EXPECT_EQ(reader.fileFrame().metresPerUnit, 0.0254);
  EXPECT_EQ(reader.fileFrame().up, UpAxis::Y);  // nobody has turned it
}

TEST(ImportReader, RefusesUnitsAndAxesThatCannotBe) {
  const auto record = [](double declared, double unit, std::uint64_t ups, std::uint64_t format) {
    std::string bytes(16, '\0');
    std::memcpy(bytes.data(), &declared, 8);
    std::memcpy(bytes.data() + 8, &unit, 8);
    return frame(6, bytes + words({ups, format}));
  };
  const auto ups = [](std::uint64_t declared, std::uint64_t up) { return declared | up << 32; };
  EXPECT_EQ(stateAfter(greeting() + record(0.0, 1.0, ups(0, 1), 0)), State::Reading);
  EXPECT_EQ(stateAfter(greeting() + record(0.01, 0.01, ups(2, 2), 1)), State::Reading);
  for (const double unit : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(stateAfter(greeting() + record(unit, 1.0, ups(1, 1), 0)), State::Broken) << unit;
    EXPECT_EQ(stateAfter(greeting() + record(1.0, unit, ups(1, 1), 0)), State::Broken) << unit;
  }
  EXPECT_EQ(stateAfter(greeting() + record(1.0, 0.0, ups(1, 1), 0)), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + record(1.0, 1.0, ups(3, 1), 0)), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + record(1.0, 1.0, ups(1, 0), 0)), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + record(1.0, 1.0, ups(1, 3), 0)), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + record(1.0, 1.0, ups(1, 1), 2)), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + frame(6, "short")), State::Broken);
}

TEST(ImportReader, RefusesFramesOutOfOrder) {
  const std::string totals = frame(1, words({6, 2, 0, 0, 0, 0, 0}));
  const std::string object = frame(2, words({3}) + "name");
  const std::string triangle = frame(3, std::string(72, '\0'));
  EXPECT_EQ(stateAfter(greeting() + object), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + totals), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + triangle), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + object + object), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + frame(4, words({0, 0}))), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + frame(99, "")), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + object + triangle), State::Reading);  // the yardstick
}

TEST(ImportReader, RefusesFramesOfAWrongSize) {
  const std::string totals = frame(1, words({5, 2, 0, 0, 0, 0, 0}));
  const std::string object = frame(2, words({3}));
  EXPECT_EQ(stateAfter(greeting() + frame(1, words({5, 2}))), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + frame(2, "short")), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + object + frame(3, std::string(71, '\0'))),
            State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + object + frame(3, std::string(72 * 4, '\0'))),
            State::Broken);
  EXPECT_EQ(stateAfter(greeting() + frame(5, "")), State::Broken);
  // Judged by its head, before anything of it is kept.
  EXPECT_EQ(stateAfter(greeting() + frame(3, "").replace(4, 4, "\xFF\xFF\xFF\xFF")), State::Broken);
}

TEST(ImportReader, RefusesTotalsBeyondTheLimits) {
  EXPECT_EQ(stateAfter(greeting() + frame(1, words({kMaxTriangles, 1, 0, 0, 0, 0, 0}))),
            State::Reading);
  EXPECT_EQ(stateAfter(greeting() + frame(1, words({kMaxTriangles + 1, 1, 0, 0, 0, 0, 0}))),
            State::Broken);
  EXPECT_EQ(stateAfter(greeting() + frame(1, words({1, kMaxImportObjects + 1, 0, 0, 0, 0, 0}))),
            State::Broken);
  const std::string totals = frame(1, words({5, 9, 0, 0, 0, 0, 0}));
  EXPECT_EQ(stateAfter(greeting() + totals + frame(2, words({6}))), State::Broken);
  EXPECT_EQ(stateAfter(greeting() + totals + frame(2, words({0}))), State::Broken);
}

TEST(ImportReader, KeepsMemoryInStepWithWhatArrived) {
  ImportReader reader;
  ASSERT_EQ(reader.feed(greeting() + frame(1, words({kMaxTriangles, 1, 0, 0, 0, 0, 0})) +
                        frame(2, words({kMaxTriangles})) + frame(3, std::string(72 * 100, '\0'))),
            State::Reading);
  const RawScene scene = reader.take().scene;
  EXPECT_EQ(scene.triangles.size(), 100U);
  EXPECT_LE(scene.triangles.capacity(), 200U);
}

TEST(ImportReader, ReportsAFailureWithItsTextMadeReadable) {
  std::string stream;
  ImportWriter writer([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  writer.totals({});
  EXPECT_TRUE(writer.fail(ImportFailure::Refused, "bad\x1B[2J chunk\n" + std::string(5000, 'x')));
  ImportReader reader;
  ASSERT_EQ(reader.feed(stream), State::Failed);
  EXPECT_EQ(reader.failure(), ImportFailure::Refused);
  EXPECT_EQ(reader.failureText().substr(0, 13), "bad [2J chunk");
  EXPECT_LE(reader.failureText().size(), kMaxFailureTextBytes);
  EXPECT_EQ(stateAfter(greeting() + frame(5, std::string("\x09\0\0\0", 4))), State::Broken);
}

TEST(ImportReader, CleansAndBoundsNames) {
  std::string stream;
  ImportWriter writer([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  ImportTotals totals;
  totals.triangles = totals.objects = 1;
  writer.totals(totals);
  writer.object("\x1B]0;title\x07\xFF" + std::string(1000, 'n'), 1);
  writer.triangle(triangleNumber(0));
  ASSERT_TRUE(writer.finish());
  ImportReader reader;
  ASSERT_EQ(reader.feed(stream), State::Complete);
  const std::string name = reader.take().scene.objectNames.at(0);
  EXPECT_EQ(name.substr(0, 12), "]0;title \xEF\xBF\xBD");
  EXPECT_EQ(name.size(), kMaxObjectNameBytes);
}

TEST(ImportReader, SurvivesAnyBytesAfterTheGreeting) {
  int broken = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    // A good stream with a few bytes overwritten reaches further than plain noise does.
    std::string bytes = streamOf({2, 5, 1});
    for (unsigned k = 0; k <= seed % 4; ++k) {
      bytes[kGreetingBytes + random() % (bytes.size() - kGreetingBytes)] =
          static_cast<char>(random());
    }
    ImportReader reader;
    const State state = reader.feed(bytes);
    broken += state == State::Broken;
    const RawScene scene = reader.take().scene;
    ASSERT_LE(scene.triangles.size(), 8U);
    ASSERT_EQ(scene.objectOf.size(), scene.triangles.size());
    for (const ObjectId object : scene.objectOf) {
      ASSERT_LT(static_cast<std::size_t>(object), scene.objectNames.size());
    }
  }
  EXPECT_GT(broken, 2000);
}

TEST(ImportWriter, SaysWhenItsBytesWereNotTaken) {
  ImportWriter writer([](std::string_view) { return false; });
  writer.totals({});
  EXPECT_FALSE(writer.finish());
}

}  // namespace
}  // namespace foretouch::internal
