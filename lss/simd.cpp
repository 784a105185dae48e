#include "lss/simd.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lss/simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
#include "lss/index.h"

namespace foretouch::HWY_NAMESPACE {
std::int64_t compiledTarget() {
  return HWY_TARGET;
}
}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(compiledTarget);

// The last is what every processor of this architecture has: one lane, where no other entry is it.
constexpr std::array<std::pair<Simd, std::int64_t>, 7> kTargets{{
    {Simd::Ssse3, HWY_SSSE3},
    {Simd::Sse4, HWY_SSE4},
    {Simd::Avx2, HWY_AVX2},
    {Simd::Avx512, HWY_AVX3},
    {Simd::Neon, HWY_NEON},
    {Simd::Simd128, HWY_WASM},
    {Simd::Scalar, HWY_STATIC_TARGET},
}};

constexpr std::array<std::pair<Simd, const char*>, 8> kNames{{
    {Simd::Scalar, "scalar"},
    {Simd::Ssse3, "ssse3"},
    {Simd::Sse4, "sse4"},
    {Simd::Avx2, "avx2"},
    {Simd::Avx512, "avx512"},
    {Simd::Neon, "neon"},
    {Simd::Simd128, "simd128"},
    {Simd::Other, "other"},
}};

Simd simdOf(std::int64_t target) {
  if (target == HWY_SCALAR || target == HWY_EMU128) return Simd::Scalar;
  for (const auto& [simd, known] : kTargets) {
    if (known == target) return simd;
  }
  return Simd::Other;
}

}  // namespace

const char* toString(Simd simd) {
  return kNames[slotOf(simd)].second;
}

std::optional<Simd> simdFromName(std::string_view name) {
  for (const auto& [simd, known] : kNames) {
    if (name == known) return simd;
  }
  return std::nullopt;
}

std::vector<Simd> supportedSimd() {
  std::vector<Simd> found;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    found.push_back(simdOf(target));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Simd activeSimd() {
  return simdOf(HWY_DYNAMIC_DISPATCH(compiledTarget)());
}

bool useSimd(std::optional<Simd> simd) {
  hwy::SetSupportedTargetsForTest(0);
  if (!simd) return true;
  const std::vector<Simd> supported = supportedSimd();
  if (std::find(supported.begin(), supported.end(), *simd) == supported.end()) return false;
  for (const auto& [known, target] : kTargets) {
    if (known == *simd) hwy::SetSupportedTargetsForTest(target);
  }
  return true;
}

}  // namespace foretouch
#endif
