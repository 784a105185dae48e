#include "tests/fuzz/import_inputs.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "assets/import/model_stream.h"
#include "assets/import/protocol.h"
#include "assets/import/stream.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

/// The parent's reader cannot know who counts: every frame by itself.
class AnyFrames : public internal::FrameWriter {
 public:
  using FrameWriter::FrameWriter;
  void add(std::uint32_t type, std::string_view payload) { frame(type, payload); }
  bool finish(std::uint64_t count) { return end(count); }
};

std::string framed(std::string_view bytes) {
  std::string sent;
  AnyFrames frames([&](std::string_view more) {
    sent += more;
    return true;
  });
  std::uint64_t count = 0;
  if (!bytes.empty()) count = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 1));
  while (bytes.size() >= 3) {
    const auto type = static_cast<unsigned char>(bytes[0]);
    const std::size_t length = static_cast<unsigned char>(bytes[1]) |
                               std::size_t{static_cast<unsigned char>(bytes[2])} << 8;
    bytes.remove_prefix(3);
    const std::size_t taken = std::min(length, bytes.size());
    frames.add(type, bytes.substr(0, taken));
    bytes.remove_prefix(taken);
  }
  frames.finish(count);
  return sent;
}

void feedInPieces(internal::FrameReader& reader, std::string_view bytes, std::size_t piece) {
  for (std::size_t i = 0; i < bytes.size(); i += piece) {
    const auto state = reader.feed(bytes.substr(i, piece));
    require(state == reader.state(), "a reader is in the state that it tells");
  }
  using State = internal::FrameReader::State;
  require((reader.state() == State::Broken) == !reader.broken().empty(),
          "a broken answer has a reason, and no other");
  require((reader.state() == State::Failed) == (reader.failure() != internal::ImportFailure::None),
          "a failure has a kind, and no other answer has");
  for (const char c : reader.failureText() + reader.broken()) {
    require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "reasons can be shown");
  }
}

void checkScene(const ImportedScene& imported) {
  const RawScene& scene = imported.scene;
  require(scene.objectOf.size() == scene.triangles.size(), "every triangle has an object");
  for (const std::int32_t object : scene.objectOf) {
    require(object >= 0 && static_cast<std::size_t>(object) < scene.objectNames.size(),
            "objects exist");
  }
}

}  // namespace

void checkModel(const Model& model) {
  const auto nodes = static_cast<std::int32_t>(model.nodes.size());
  for (std::int32_t i = 0; i < nodes; ++i) {
    const std::int32_t parent = model.nodes[static_cast<std::size_t>(i)].parent;
    require(parent >= -1 && parent < i, "parents come before their children");
  }
  for (const ModelMimic& mimic : model.mimics) {
    require(mimic.node >= 0 && mimic.node < nodes && mimic.leader >= 0 && mimic.leader < nodes,
            "joints follow joints");
  }
  for (const ModelMesh& mesh : model.meshes) {
    require(mesh.node >= 0 && mesh.node < nodes, "a mesh is placed by a node");
    const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
    for (const auto& triangle : mesh.triangles) {
      for (const std::int32_t corner : triangle) {
        require(corner >= 0 && corner < vertices, "corners exist");
      }
    }
    for (const ModelBone& bone : mesh.bones) {
      require(bone.node >= -1 && bone.node < nodes, "bones are nodes or none");
      for (const auto& weight : bone.weights) {
        require(weight.vertex >= 0 && weight.vertex < vertices, "weights are of vertices");
      }
    }
  }
  for (const ModelAnimation& animation : model.animations) {
    for (const ModelTrack& track : animation.tracks) {
      require(track.node >= 0 && track.node < nodes, "tracks move nodes");
    }
  }
}

bool feedImportStream(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return false;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string answer = (data[0] & 1) != 0 ? framed(bytes) : std::string(bytes);
  const std::size_t piece = 1 + std::size_t{data[0]} * 7;
  internal::ImportReader scene;
  feedInPieces(scene, answer, piece);
  internal::ModelReader model;
  feedInPieces(model, answer, piece);
  using State = internal::FrameReader::State;
  if (scene.state() == State::Complete) checkScene(scene.take());
  if (model.state() == State::Complete) checkModel(model.take());
  return scene.state() == State::Complete || model.state() == State::Complete;
}

}  // namespace foretouch::fuzz
