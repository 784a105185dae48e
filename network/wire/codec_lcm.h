// network/wire/codec_lcm.h: shared by the codecs: conversion between bytes and lcm-gen types. Which
// values are legal: wire_fields.h. For the codec's sources only.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lss/assert.h"
#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "network/wire/payload_check.h"

namespace foretouch {

/// The most of stamps (us), sequences and counts: differences of two such fit in an int64.
inline constexpr std::int64_t kMaxWireInteger = (std::int64_t{1} << 62) - 1;

/// Checks all bytes before lcm-gen's decoder sees one or allocates anything.
template <typename LcmType>
[[nodiscard]] Reject fromBytes(PayloadType type, ByteView payload, LcmType& wire) {
  const Reject reject = checkPayload(type, payload);
  if (reject != Reject::None) return reject;
  const int size = static_cast<int>(payload.size);
  return wire.decode(payload.data, 0, size) == size ? Reject::None : Reject::Length;
}

template <typename LcmType>
void toBytes(PayloadType type, LcmType& wire, Bytes& payload) {
  wire.version = kMessageVersion;
  payload.resize(static_cast<std::size_t>(wire.getEncodedSize()));
  const int written = wire.encode(payload.data(), 0, static_cast<int>(payload.size()));
  payload.resize(written > 0 ? countOf(written) : 0);
  FORETOUCH_ASSERT(checkPayload(type, payload) == Reject::None);
  static_cast<void>(type);
}

}  // namespace foretouch
