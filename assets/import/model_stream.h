// assets/import/model_stream.h: the stream in which foretouch-import sends a model to its parent.
// Not installed.
//
// In the frames of assets/import/stream.h: nodes, parents first; then the nodes whose joints
// follow others'; then each mesh, its vertices, its triangles and its bones, each bone with its
// weights; then each animation, its tracks, each with its keys; then notes. Every container states
// the number of its parts first; the trailer counts
// the frames.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "assets/import/stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

inline constexpr std::size_t kMaxModelNodes = 65536;
inline constexpr std::size_t kMaxModelNameBytes = kMaxNameBytes;  // each, as sent
inline constexpr std::size_t kMaxModelNotes = 64;
inline constexpr std::size_t kMaxModelNoteBytes = 512;

/// The sizes of a model's parts.
struct ModelSize {
  std::uint64_t nodes = 0, lss = 0, meshes = 0, vertices = 0, triangles = 0, bones = 0, weights = 0;
  std::uint64_t animations = 0, tracks = 0, keys = 0, nameBytes = 0, notes = 0, mimics = 0;

  /// The part that exceeds its limit, such as "more than 65536 nodes"; empty if none does.
  [[nodiscard]] std::string excess() const;
};

/// The child's end. Sends names unchanged: the parent cleans them.
class ModelWriter : public FrameWriter {
 public:
  using FrameWriter::FrameWriter;

  /// Precondition: the model is within the limits. False if any byte could not be sent.
  bool write(const Model& model);

 private:
  void countedFrame(std::uint32_t type, std::string_view payload);
  template <typename Record, typename Items, typename Pack>
  void writeAll(std::uint32_t type, const Items& items, Pack pack);
  void writeNode(const ModelNode& node);
  void writeMesh(const ModelMesh& mesh);
  void writeTrack(const ModelTrack& track);

  std::uint64_t frames_ = 0;
};

/// The parent's end. Complete: take() the model, in which parents come before children, indices are
/// in range, frames and LSS are finite, names and notes are readable. Memory grows with the
/// received bytes, whatever the counts promise.
class ModelReader : public FrameReader {
 public:
  [[nodiscard]] Model take() { return std::move(model_); }

 private:
  /// The promised parts that have not arrived.
  struct Left {
    std::uint64_t vertices = 0, triangles = 0, bones = 0, weights = 0;
    std::uint64_t tracks = 0, positions = 0, scales = 0, rotations = 0;
    std::uint64_t positionTangents = 0, rotationTangents = 0;
    [[nodiscard]] bool keys() const {
      return positions + scales + rotations + positionTangents + rotationTangents != 0;
    }
    [[nodiscard]] bool nothing() const {
      return vertices + triangles + bones + weights + tracks == 0 && !keys();
    }
  };

  void parseFrame(std::uint32_t type, std::string_view payload) override;
  [[nodiscard]] bool isWhole(std::uint64_t count) const override;
  void parseNode(std::string_view payload);
  void parseMimic(std::string_view payload);
  void parseMesh(std::string_view payload);
  void parseVertices(std::string_view payload);
  void parseTriangles(std::string_view payload);
  void parseBone(std::string_view payload);
  void parseWeights(std::string_view payload);
  void parseAnimation(std::string_view payload);
  void parseTrack(std::string_view payload);
  void parsePositions(std::string_view payload);
  void parseScales(std::string_view payload);
  void parseRotations(std::string_view payload);
  void parsePositionTangents(std::string_view payload);
  void parseRotationTangents(std::string_view payload);
  void parseNote(std::string_view payload);

  /// Passes each record to `take`, which returns false for an impossible one; breaks off then, and
  /// if there are more records than `left`.
  template <typename Record, typename Take>
  void parseAll(std::string_view payload, std::uint64_t& left, Take take);
  /// The name at the end of a record, counted.
  std::string nameIn(std::string_view bytes);
  [[nodiscard]] bool isNode(std::int32_t node) const;
  void checkSize();

  Model model_;
  ModelSize size_;
  Left left_;
  std::uint64_t frames_ = 0;
};

}  // namespace foretouch::internal
