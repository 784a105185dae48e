// middleware/import_protocol.h: the stream in which foretouch-import hands a scene to its parent.
// Not installed.
//
// A greeting (magic, version, byte order), then frames: type and payload size as 32-bit numbers,
// then the payload. Totals first; then each object (its triangle count and name) followed by its
// triangles; last a trailer with the triangle count and a checksum of everything before it. Or, at
// any place before the trailer, a failure with its text. Native byte order: both ends are processes
// of one machine. The checksum finds a stream that something else wrote into; that the reader
// trusts nothing it is told guards against the rest.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "middleware/scene_import.h"

namespace foretouch::internal {

inline constexpr std::size_t kMaxImportFrameBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxImportObjects = std::size_t{1} << 20;
inline constexpr std::size_t kMaxImportNameBytes = std::size_t{64} << 20;  // all names together
inline constexpr std::size_t kMaxObjectNameBytes = 256;                    // one, as handed on
inline constexpr std::size_t kMaxFailureTextBytes = 1024;

enum class ImportFailure : std::uint32_t {
  None,
  Refused,        ///< The file breaks its format's rules.
  UnknownFormat,  ///< No reader for the file's extension.
  TooLarge,       ///< More triangles, objects or names than the limits.
  OutOfMemory,
};

struct ImportTotals {
  std::uint64_t triangles = 0, objects = 0;
  std::uint64_t nodes = 0, meshInstances = 0, uniqueMeshes = 0;
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
};

/// The child's end. Calls in the order totals, (object, triangle...)..., finish; or fail at any
/// place before finish.
class ImportWriter {
 public:
  /// Takes bytes away; false where that failed for good.
  using Sink = std::function<bool(std::string_view)>;
  explicit ImportWriter(Sink sink);

  void totals(const ImportTotals& totals);
  void object(std::string_view name, std::uint64_t triangles);
  void triangle(const std::array<Eigen::Vector3d, 3>& vertices);
  /// False where any byte could not be handed over.
  bool finish();
  bool fail(ImportFailure failure, std::string_view text);

 private:
  void frame(std::uint32_t type, std::string_view payload);
  void flushTriangles();
  void put(std::string_view bytes);
  void flush();

  Sink sink_;
  bool intact_ = true;
  std::uint64_t checksum_;
  std::uint64_t triangles_ = 0;
  std::string pending_;   // triangles of the frame being filled
  std::string outgoing_;  // frames on their way: many objects are small
};

/// The parent's end: a parser that is fed as bytes arrive and believes none of them. Memory grows
/// with the bytes received, whatever the totals promise.
class ImportReader {
 public:
  enum class State : std::uint8_t {
    Reading,
    Complete,  ///< The trailer arrived and agrees: take() the scene.
    Failed,    ///< The child reported failure() and failureText().
    Broken,    ///< The bytes break the protocol: broken() says how.
  };
  /// After anything but Reading, further bytes are ignored.
  State feed(std::string_view bytes);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool greeted() const { return greeted_; }
  [[nodiscard]] ImportFailure failure() const { return failure_; }
  [[nodiscard]] const std::string& failureText() const { return failureText_; }
  [[nodiscard]] const std::string& broken() const { return broken_; }
  [[nodiscard]] ImportedScene take() { return std::move(scene_); }

 private:
  std::size_t parseOne(std::string_view bytes);
  std::size_t parseGreeting(std::string_view bytes);
  void parseFrame(std::uint32_t type, std::string_view payload);
  void parseTotals(std::string_view payload);
  void parseObject(std::string_view payload);
  void parseTriangles(std::string_view payload);
  void parseFailure(std::string_view payload);
  void parseTrailer(std::string_view payload);
  void breakOff(std::string reason);
  void makeRoomFor(std::size_t triangles);

  State state_ = State::Reading;
  bool greeted_ = false, haveTotals_ = false;
  ImportTotals totals_;
  std::uint64_t leftInObject_ = 0, claimedTriangles_ = 0;
  std::size_t nameBytes_ = 0;
  std::uint64_t checksum_ = 0;
  ImportedScene scene_;
  ImportFailure failure_ = ImportFailure::None;
  std::string failureText_, broken_;
  std::string pending_;  // the incomplete frame at the end of what was fed
};

}  // namespace foretouch::internal
