// assets/bvh/bvh_reader.h: BVH mocap files, with the quirks found in the wild, in bounded memory.
// BVH has no specification; docs/formats.md lists what the reader accepts, tolerates with a note,
// and refuses. Rotation channels compose in file order (Z X Y means Rz*Rx*Ry); position channels
// replace the joint's OFFSET; angles are degrees in the file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/bvh/bvh_limits.h"

namespace foretouch {

struct BvhOptions {
  double scale = 1.0;  ///< Metres per file unit: 0.01 for centimetres, 0.0254 for inches. > 0.
};

/// Reads and checks a BVH file. Iterative: no recursion on the file's nesting. A clip has at least
/// one frame; callers that need motion must check for two.
[[nodiscard]] Result<Clip> readBvhFile(const std::string& path, const BvhOptions& options = {});

/// The same for text in memory; errors name `name` as the file. Safe on hostile input.
[[nodiscard]] Result<Clip> parseBvh(std::string_view text, const std::string& name,
                                    const BvhOptions& options = {});

}  // namespace foretouch
