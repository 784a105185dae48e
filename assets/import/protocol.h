// assets/import/protocol.h: the stream in which foretouch-import sends a scene to its parent. Not
// installed.
//
// In the frames of assets/import/stream.h: totals first; then notes; then each object (its triangle
// count and name) followed by its triangles; the trailer counts the triangles.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include "assets/import/imported_scene.h"
#include "assets/import/stream.h"

namespace foretouch::internal {

inline constexpr std::size_t kMaxImportObjects = std::size_t{1} << 20;
inline constexpr std::size_t kMaxObjectNameBytes = 256;  // each, as sent
inline constexpr std::size_t kMaxImportNotes = 64;
inline constexpr std::size_t kMaxImportNoteBytes = 512;

struct ImportTotals {
  std::uint64_t triangles = 0, objects = 0;
  std::uint64_t nodes = 0, meshInstances = 0, uniqueMeshes = 0;
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
};

/// The child's end. Call in the order totals, note..., (object, triangle...)..., finish; or fail at
/// any time before finish.
class ImportWriter : public FrameWriter {
 public:
  using FrameWriter::FrameWriter;

  void totals(const ImportTotals& totals);
  /// Right behind the totals, at most kMaxImportNotes.
  void note(std::string_view text);
  void object(std::string_view name, std::uint64_t triangles);
  void triangle(const std::array<Eigen::Vector3d, 3>& vertices);
  /// False if any byte could not be sent.
  bool finish();

 private:
  void flushTriangles();

  std::uint64_t triangles_ = 0;
  std::string pending_;  // triangles of the frame being filled
};

/// The parent's end. Complete: take() the scene. Memory grows with the received bytes, whatever the
/// totals promise.
class ImportReader : public FrameReader {
 public:
  [[nodiscard]] ImportedScene take() { return std::move(scene_); }

 private:
  void parseFrame(std::uint32_t type, std::string_view payload) override;
  [[nodiscard]] bool isWhole(std::uint64_t count) const override;
  void parseTotals(std::string_view payload);
  void parseNote(std::string_view payload);
  void parseObject(std::string_view payload);
  void parseTriangles(std::string_view payload);
  void makeRoomFor(std::size_t triangles);

  bool haveTotals_ = false;
  ImportTotals totals_;
  std::uint64_t leftInObject_ = 0, claimedTriangles_ = 0;
  std::size_t nameBytes_ = 0;
  ImportedScene scene_;
};

}  // namespace foretouch::internal
