// assets/import/model_stream.h: the stream in which foretouch-import hands a model to its
// parent. Not installed.
//
// In the frames of assets/import/stream.h: nodes, parents first; then each mesh, its vertices,
// its triangles and its bones, each bone with its weights; then each animation, its tracks, each
// with its keys; then notes. What holds others states their number first; the trailer counts the
// frames.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "assets/import/stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

inline constexpr std::size_t kMaxModelNodes = 65536;
inline constexpr std::size_t kMaxModelNameBytes = kMaxNameBytes;  // one, as handed on
inline constexpr std::size_t kMaxModelNotes = 64;
inline constexpr std::size_t kMaxModelNoteBytes = 512;

/// How much of everything a model holds.
struct ModelSize {
  std::uint64_t nodes = 0, lss = 0, meshes = 0, vertices = 0, triangles = 0, bones = 0, weights = 0;
  std::uint64_t animations = 0, tracks = 0, keys = 0, nameBytes = 0, notes = 0;

  /// What there is more of than the limits allow, such as "more than 65536 nodes"; empty where
  /// all is within them.
  [[nodiscard]] std::string excess() const;
};

/// The child's end. Names are handed on as they are: the parent cleans them.
class ModelWriter : public FrameWriter {
 public:
  using FrameWriter::FrameWriter;

  /// Precondition: the model is within the limits. False where any byte could not be handed over.
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
/// in range, frames and LSS are finite, names and notes are readable. Memory grows with the bytes
/// received, whatever the counts promise.
class ModelReader : public FrameReader {
 public:
  [[nodiscard]] Model take() { return std::move(model_); }

 private:
  /// What was promised and has not arrived.
  struct Left {
    std::uint64_t vertices = 0, triangles = 0, bones = 0, weights = 0;
    std::uint64_t tracks = 0, positions = 0, scales = 0, rotations = 0;
    [[nodiscard]] bool keys() const { return positions + scales + rotations != 0; }
    [[nodiscard]] bool nothing() const {
      return vertices + triangles + bones + weights + tracks == 0 && !keys();
    }
  };

  void parseFrame(std::uint32_t type, std::string_view payload) override;
  [[nodiscard]] bool isWhole(std::uint64_t count) const override;
  void parseNode(std::string_view payload);
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
  void parseNote(std::string_view payload);

  /// Hands each record to `take`, which returns false for one that cannot be; breaks off then, and
  /// where there are more than are left.
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
