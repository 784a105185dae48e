// tools/glb/replay_glb.h: a replay as one animated GLB, for any viewer of glTF: the scene, the
// avatar in its in-between motion, its touches, and the sweeps of touching links (docs/formats.md,
// "A replay as GLB").
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/glb/shown_touch.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/results_writer.h"

namespace foretouch::tools {

struct GlbRequest {
  std::string path;                       ///< Empty: none.
  std::size_t mostTriangles = 1'000'000;  ///< Scene, avatar and swept surfaces together.
};

/// Collects the answers of a replay, in bounded memory.
class ReplayGlb {
 public:
  /// `inputs` must outlive it.
  ReplayGlb(const ReplayInputs& inputs, GlbRequest request)
      : inputs_(inputs), request_(std::move(request)) {}

  /// Steps in order.
  void add(const StepAnswer& answer);
  /// Contacts that begin touches, in order.
  void add(const std::vector<ReportedContact>& begun);

  /// `touches`: those of all steps. Writes the file; returns what it leaves out, one sentence each.
  /// Errors: an unwritable file, times that floats cannot distinguish, more than a GLB can hold.
  [[nodiscard]] Result<std::vector<std::string>> write(const std::vector<Touch>& touches) const;

 private:
  [[nodiscard]] std::vector<ShownTouch> shownOf(const std::vector<Touch>& touches) const;

  const ReplayInputs& inputs_;
  GlbRequest request_;
  std::vector<ReportedContact> first_;  // each begins a touch
  std::int64_t undecided_ = 0, notShown_ = 0;
};

}  // namespace foretouch::tools
