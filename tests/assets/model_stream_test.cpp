// The importer's stream of a model: what the writer sends arrives, and nothing else is believed.
#include "assets/import/model_stream.h"

#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/assets/model_files.h"

namespace foretouch::internal {
namespace {

using State = FrameReader::State;
using test::randomModel;

constexpr std::size_t kGreetingBytes = 16;

std::string streamOf(const Model& model) {
  std::string stream;
  ModelWriter writer([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  EXPECT_TRUE(writer.write(model));
  return stream;
}

/// A small model of two nodes, a mesh with a bone, an animation and a note.
Model smallModel() {
  Model model;
  model.nodes.resize(2);
  model.nodes[1].parent = 0;
  model.nodes[1].lss.push_back({{0, 0, 0}, {1, 0, 0}, 0.5});
  ModelMesh mesh;
  mesh.node = 1;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.bones = {{0, "b", {}, {{2, 0.5}}}};
  model.meshes = {mesh};
  ModelTrack track;
  track.node = 1;
  track.positions = {{0, {1, 2, 3}}};
  track.scales = {{0, {1, 1, 1}}};
  track.rotations = {{0, Quaternion::Identity()}};
  model.animations = {{"a", 1.0, {track}}};
  model.notes = {"a note"};
  return model;
}

/// What the reader says after a model with one thing wrong.
State stateWith(const std::function<void(Model&)>& change) {
  Model model = smallModel();
  change(model);
  ModelReader reader;
  return reader.feed(streamOf(model));
}

TEST(ModelReader, HandsOnWhatTheWriterWasGiven) {
  int meshes = 0, animations = 0, large = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Model model = randomModel(seed);
    ModelReader reader;
    ASSERT_EQ(reader.feed(streamOf(model)), State::Complete) << seed << ' ' << reader.broken();
    ASSERT_EQ(test::difference(reader.take(), model), "") << seed;
    meshes += !model.meshes.empty();
    animations += !model.animations.empty();
    for (const ModelMesh& mesh : model.meshes) large += mesh.vertices.size() > 30000;
  }
  EXPECT_GT(meshes, 150);
  EXPECT_GT(animations, 150);
  EXPECT_GT(large, 0);  // vertices in more than one frame
}

TEST(ModelReader, DoesNotCareHowTheStreamIsCut) {
  const std::string stream = streamOf(smallModel());
  for (std::size_t size = 1; size < 100; ++size) {
    ModelReader reader;
    for (std::size_t at = 0; at < stream.size(); at += size) {
      reader.feed(std::string_view(stream).substr(at, size));
    }
    ASSERT_EQ(reader.state(), State::Complete) << size;
    EXPECT_EQ(test::difference(reader.take(), smallModel()), "");
  }
}

TEST(ModelReader, WaitsForTheRestOfEveryTruncatedStream) {
  const std::string stream = streamOf(smallModel());
  for (std::size_t size = 0; size < stream.size(); ++size) {
    ModelReader reader;
    ASSERT_EQ(reader.feed(stream.substr(0, size)), State::Reading) << size;
  }
}

TEST(ModelReader, CompletesNoStreamWithAChangedByte) {
  const std::string stream = streamOf(smallModel());
  for (std::size_t at = 0; at < stream.size(); ++at) {
    for (const int change : {1, 0x80, 0xFF}) {
      std::string changed = stream;
      changed[at] = static_cast<char>(changed[at] ^ change);
      ModelReader reader;
      ASSERT_NE(reader.feed(changed), State::Complete) << at << ' ' << change;
    }
  }
}

TEST(ModelReader, RefusesIndicesOutOfRange) {
  EXPECT_EQ(stateWith([](Model&) {}), State::Complete);
  EXPECT_EQ(stateWith([](Model& m) { m.nodes[1].parent = 1; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.nodes[0].parent = -2; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].node = 2; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].node = -1; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].triangles[0][2] = 3; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].triangles[0][0] = -1; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].bones[0].node = 2; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].bones[0].node = -1; }), State::Complete);
  EXPECT_EQ(stateWith([](Model& m) { m.meshes[0].bones[0].weights[0].vertex = 3; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.animations[0].tracks[0].node = 2; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.animations[0].tracks[0].node = -1; }), State::Broken);
}

TEST(ModelReader, RefusesJointsThatFollowNone) {
  EXPECT_EQ(stateWith([](Model& m) { m.mimics = {{1, 0, 2.0, 0.1}}; }), State::Complete);
  EXPECT_EQ(stateWith([](Model& m) { m.mimics = {{2, 0, 2.0, 0.1}}; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.mimics = {{1, -1, 2.0, 0.1}}; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.mimics = {{1, 0, std::nan(""), 0.1}}; }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.mimics = {{1, 0, 2.0, INFINITY}}; }), State::Broken);
}

TEST(ModelReader, RefusesFramesAndVolumesThatCannotBe) {
  const double nan = std::nan("");
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].toParent.linear(1, 1) = nan; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].toParent.translation.x() = nan; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].axis *= 2; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].axis.x() = nan; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].lowerLimit = nan; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[0].joint = static_cast<ModelJointType>(9); }),
            State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[1].lss[0].radius = -1; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.nodes[1].lss[0].a.y() = nan; }), State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.meshes[0].bones[0].meshToBone.translation.z() = nan; }),
            State::Broken);
  EXPECT_EQ(stateWith([&](Model& m) { m.animations[0].durationS = nan; }), State::Broken);
}

TEST(ModelReader, RefusesMoreThanTheLimits) {
  EXPECT_EQ(stateWith([](Model& m) { m.nodes.resize(kMaxModelNodes); }), State::Complete);
  EXPECT_EQ(stateWith([](Model& m) { m.nodes.resize(kMaxModelNodes + 1); }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.notes.resize(kMaxModelNotes); }), State::Complete);
  EXPECT_EQ(stateWith([](Model& m) { m.notes.resize(kMaxModelNotes + 1); }), State::Broken);
  EXPECT_EQ(stateWith([](Model& m) { m.animations.resize(65537); }), State::Broken);
}

TEST(ModelReader, CleansAndBoundsNames) {
  Model model = smallModel();
  model.nodes[0].name = "\x1B]0;title\x07\xFF" + std::string(2000, 'n');
  model.notes = {"bad\nnote"};
  ModelReader reader;
  ASSERT_EQ(reader.feed(streamOf(model)), State::Complete);
  const Model got = reader.take();
  EXPECT_EQ(got.nodes[0].name.substr(0, 12), "]0;title \xEF\xBF\xBD");
  EXPECT_LE(got.nodes[0].name.size(), kMaxModelNameBytes);
  EXPECT_EQ(got.notes[0], "bad note");
}

/// A frame as the child would send it.
std::string frame(std::uint32_t type, const std::string& payload) {
  const auto size = static_cast<std::uint32_t>(payload.size());
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &type, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  return bytes + payload;
}

TEST(ModelReader, KeepsMemoryInStepWithWhatArrived) {
  Model model;
  model.nodes.resize(1);
  const std::string stream = streamOf(model);
  const std::string upToNode = stream.substr(0, stream.size() - 24);  // less the trailer
  const std::uint64_t head[4] = {100'000'000, 40'000'000, 1000, 0};
  std::string mesh(reinterpret_cast<const char*>(head), sizeof head);
  ModelReader reader;
  ASSERT_EQ(reader.feed(upToNode + frame(17, mesh) + frame(18, std::string(240, '\0'))),
            State::Reading)
      << reader.broken();
  const Model got = reader.take();
  ASSERT_EQ(got.meshes.size(), 1U);
  EXPECT_EQ(got.meshes[0].vertices.size(), 10U);
  EXPECT_LE(got.meshes[0].vertices.capacity(), 20U);
  EXPECT_EQ(got.meshes[0].triangles.capacity(), 0U);
}

TEST(ModelReader, SurvivesAnyBytesAfterTheGreeting) {
  int broken = 0, reading = 0;
  const std::string good = streamOf(smallModel());
  for (unsigned seed = 0; seed < 20000; ++seed) {
    std::mt19937 random(seed);
    std::string bytes = good;
    if (seed % 4 == 0) {
      // Frames of known types with noise in them.
      bytes.resize(kGreetingBytes);
      for (unsigned k = 0; k < 4; ++k) {
        std::string payload(random() % 300, '\0');
        for (char& byte : payload) byte = static_cast<char>(random() % (seed % 8 == 0 ? 3 : 256));
        bytes += frame(static_cast<std::uint32_t>(14 + random() % 15), payload);
      }
    } else {
      for (unsigned k = 0; k <= seed % 5; ++k) {
        bytes[kGreetingBytes + random() % (bytes.size() - kGreetingBytes)] =
            static_cast<char>(random());
      }
    }
    ModelReader reader;
    const State state = reader.feed(bytes);
    broken += state == State::Broken;
    reading += state == State::Reading;
    const Model model = reader.take();
    ASSERT_LE(model.nodes.size() + model.meshes.size() + model.notes.size(), 10U) << seed;
  }
  EXPECT_GT(broken, 10000);
  EXPECT_GT(reading, 100);
}

}  // namespace
}  // namespace foretouch::internal
