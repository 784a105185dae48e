// lss/simd.h: which of the processor's vector instructions the lanes use. The build compiles every
// source with lanes once for each of them (Google Highway); at run time the program uses the widest
// that the processor has. Away from x86-64 there is one, which the build settles. Not installed.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace foretouch {

/// From the narrowest to the widest.
enum class Simd {
  Scalar,   ///< One lane: any processor.
  Ssse3,    ///< 4 floats.
  Sse4,     ///< 4 floats.
  Avx2,     ///< 8 floats, fused multiply-add.
  Avx512,   ///< 16 floats.
  Neon,     ///< 4 floats, fused multiply-add: ARM64, all of it.
  Simd128,  ///< 4 floats: WebAssembly.
  Other,    ///< Another architecture's, as Highway finds it.
};

/// "scalar", "ssse3", "sse4", "avx2", "avx512", "neon", "simd128", "other".
[[nodiscard]] const char* toString(Simd simd);
[[nodiscard]] std::optional<Simd> simdFromName(std::string_view name);

/// Those that this processor has and this library was built for, narrowest first; never empty.
[[nodiscard]] std::vector<Simd> supportedSimd();
/// The one in use.
[[nodiscard]] Simd activeSimd();
/// From now on the whole process uses `simd`, or the widest if empty; false, without a change, if
/// the processor lacks it. For tests and measurements: not while a query runs.
bool useSimd(std::optional<Simd> simd);

}  // namespace foretouch
