// tools/feet/feet_labels.h: what each part does at each pose, for those who train or test on it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "articulated/result.h"
#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// docs/formats.md, "Labels of feet".
enum class LabelFormat : std::uint8_t { Csv, JsonLines, Npz };

/// The format by the ending: .csv, .jsonl or .npz. Errors: another ending.
[[nodiscard]] Result<LabelFormat> labelFormatOf(const std::string& path);

/// Hands the text on, piece by piece. Errors: an .npz of 4 GiB or more.
[[nodiscard]] Result<Done> writeLabels(const FeetInputs& inputs, const FeetAnswer& answer,
                                       LabelFormat format,
                                       const std::function<void(const std::string&)>& write);

}  // namespace foretouch::tools
