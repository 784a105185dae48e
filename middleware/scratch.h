// middleware/scratch.h: memory that questions keep from one to the next, so that they allocate
// nothing once it has grown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace foretouch {

namespace internal {

/// Which sort of question keeps something.
enum class ScratchKind : std::uint8_t {
  Query,
  Near,
  Bracket,
  Edge,
  Depth,
  World,
  WorldDepth,
  StepList,
  EdgeList,
  Ask,
  Clearance,
  Count
};

/// What one sort of question keeps; a derived class names its kind as `kKind`.
struct ScratchPart {
  ScratchPart() = default;
  ScratchPart(const ScratchPart&) = delete;
  ScratchPart& operator=(const ScratchPart&) = delete;
  virtual ~ScratchPart() = default;
};

}  // namespace internal

/// Scratch memory of questions of any sort: about steps, near features, edges, depths and worlds.
/// One per thread; a question about a world can reuse most in the scratch that asked the window
/// before.
class Scratch {
 public:
  /// The part of this kind, for the questions' own sources; made when it is first asked for.
  template <typename Part>
  [[nodiscard]] Part& of() {
    auto& part = parts_[static_cast<std::size_t>(Part::kKind)];
    if (!part) part = std::make_unique<Part>();
    return static_cast<Part&>(*part);
  }
  /// Drops what a question that was broken off may have left half written.
  void forget(internal::ScratchKind kind) { parts_[static_cast<std::size_t>(kind)].reset(); }

 private:
  std::array<std::unique_ptr<internal::ScratchPart>,
             static_cast<std::size_t>(internal::ScratchKind::Count)>
      parts_;
};

}  // namespace foretouch
