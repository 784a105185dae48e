#include "tools/touches/touch_strength.h"

#include <algorithm>
#include <cmath>

#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

void writeFinite(const char* name, double value, JsonWriter& out) {
  out.key(name);
  std::isfinite(value) ? out.value(value) : out.null();
}

}  // namespace

std::optional<double> TouchStrength::impulse() const {
  if (!std::isfinite(effectiveMass) || !std::isfinite(approachSpeed)) return std::nullopt;
  return effectiveMass * std::max(0.0, approachSpeed);
}

TouchStrength strengthOf(const WorldEvent& event) {
  return {event.approachSpeed, event.approachLower, event.approachUpper, event.effectiveMass};
}

void writeStrength(const TouchStrength& strength, JsonWriter& out) {
  writeObject("approach", out, [&] {
    writeFinite("speed", strength.approachSpeed, out);
    writeFinite("lower", strength.approachLower, out);
    writeFinite("upper", strength.approachUpper, out);
  });
  writeFinite("effective_mass", strength.effectiveMass, out);
}

void writeForce(const TouchStrength& strength, JsonWriter& out) {
  writeStrength(strength, out);
  if (const auto impulse = strength.impulse()) out.field("impulse", *impulse);
}

}  // namespace foretouch::tools
