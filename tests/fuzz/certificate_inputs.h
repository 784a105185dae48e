// tests/fuzz/certificate_inputs.h: certificates, as a stranger reads them. A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// A certificate, or edges: a text that is read says nothing beyond the format; and of a step or an
/// edge on which a sphere passes through a triangle, nothing that names it is proven.
bool feedCertificate(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
