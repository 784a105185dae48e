// tools/sweep/surface_writer.h: swept surfaces as mesh files (docs/formats.md, Swept volumes).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/text_file.h"
#include "tools/sweep/sweep.h"

namespace foretouch::tools {

enum class MeshFormat : std::uint8_t { Obj, Ply, Glb };

/// The format by the path's extension, ignoring case; error for any other than these three.
[[nodiscard]] Result<MeshFormat> meshFormatOf(const std::string& path);

/// Precondition: at least one link. For GLB, coordinates are floats (CoordinateBits::Single). Error
/// if the format's numbers are too small for so many vertices or bytes. Returns bytes written.
[[nodiscard]] Result<std::size_t> writeSurfaces(const Sweep& sweep, SurfaceSide side,
                                                MeshFormat format, PendingFile& file);

}  // namespace foretouch::tools
