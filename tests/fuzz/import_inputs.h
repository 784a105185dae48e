// tests/fuzz/import_inputs.h: what comes from the importer, whoever has taken it over. A broken
// promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "assets/model/model.h"

namespace foretouch::fuzz {

/// What a model promises: assets/model/model.h.
void checkModel(const Model& model);

/// First byte even: the rest is the importer's answer, in pieces. Odd: it is frames (a byte of
/// type, two of length, the payload), sent with the greeting and the check sum of an honest
/// importer, so that what is behind them is reached. Read as a scene and as a model; returns
/// whether one of them was whole.
bool feedImportStream(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
