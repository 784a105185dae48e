// tools/feet/feet_text.h: how feet rest, as a table for people, as CSV and as a line of JSON.
#pragma once

#include <string>
#include <vector>

#include "assets/json_writer.h"
#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

[[nodiscard]] std::string feetText(const FeetInputs& inputs, const FeetAnswer& answer);

/// What each foot does, what a fit did and what was asked: sentences, what matters first.
[[nodiscard]] std::vector<std::string> feetSentences(const FeetInputs& inputs,
                                                     const FeetAnswer& answer);
/// The tables of feetText(), in fixed columns.
[[nodiscard]] std::string feetTables(const FeetInputs& inputs, const FeetAnswer& answer);

/// One line per stance, part by part, in the order of time: docs/formats.md, "How feet rest".
[[nodiscard]] std::string feetCsv(const FeetInputs& inputs, const FeetAnswer& answer);

/// The line of --json.
[[nodiscard]] std::string feetJson(const FeetInputs& inputs, const FeetAnswer& answer);

/// Writes `ground_fit` of --json; nothing without a fit.
void writeFit(const FeetInputs& inputs, JsonWriter& out);

/// What the fit found, in one sentence; empty without a fit.
[[nodiscard]] std::string fitText(const FeetInputs& inputs);

}  // namespace foretouch::tools
