// tools/touches/touch_strength.h: how hard two meet where a touch begins: the same fields in
// events, results, view documents and a GLB (docs/formats.md, "Events of a world").
#pragma once

#include <optional>

#include "assets/json_writer.h"
#include "middleware/events/world_event.h"

namespace foretouch::tools {

/// As WorldEvent has it. Metres per second along the normal, above zero while the two approach.
struct TouchStrength {
  double approachSpeed = 0.0, approachLower = 0.0, approachUpper = 0.0;
  double effectiveMass = 0.0;  ///< Kilograms; infinite where neither of the two has a mass.

  /// The impulse that would take the whole approach away, without bouncing: newton seconds. Zero if
  /// the two do not approach; nothing if neither has a mass.
  [[nodiscard]] std::optional<double> impulse() const;
};
[[nodiscard]] TouchStrength strengthOf(const WorldEvent& event);

/// Writes "approach" and "effective_mass" into an open object.
void writeStrength(const TouchStrength& strength, JsonWriter& out);
/// The same, and "impulse" where it is known.
void writeForce(const TouchStrength& strength, JsonWriter& out);

}  // namespace foretouch::tools
