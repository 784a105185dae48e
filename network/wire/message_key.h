// network/wire/message_key.h: a key that senders, services and listeners share, and the code that
// it adds to their messages, so that no other program can speak for them. The code is SipHash-2-4
// of 64 bits ([Aumasson12]), by
// OpenSSL's libcrypto.
//
// A signed payload is the payload, "FTSIGN01", the time of sending (i64, us since the Unix epoch),
// and the code (u64), big-endian: 24 bytes more. The code covers the channel, a NUL, and all before
// it. Each sender's times grow from message to message. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "articulated/result.h"
#include "network/wire/codec.h"
#include "network/wire/messages.h"

namespace foretouch {

inline constexpr std::size_t kKeyBytes = 16;
inline constexpr std::size_t kSignatureBytes = 24;
/// A signed message may be this much older or newer (us) than its receiver's clock says.
inline constexpr std::int64_t kMostSignatureAgeUs = 10'000'000;

/// A payload without its signature.
struct SignedPayload {
  ByteView content;
  std::int64_t sentUtimeUs = 0;
};

/// Copies are cheap. From any thread.
class MessageKey {
 public:
  /// Precondition (asserted as it is used): the system's libcrypto gives SipHash.
  explicit MessageKey(const std::array<std::uint8_t, kKeyBytes>& key);
  /// A file of 32 hexadecimal digits, as `openssl rand -hex 16` writes them. Errors: not a regular
  /// file, readable by others than its owner, anything else in it; a libcrypto without SipHash.
  static Result<MessageKey> read(const std::string& path);

  /// Appends the signature.
  void sign(std::string_view channel, std::int64_t utimeUs, Bytes& payload) const;
  /// Unauthenticated unless it was signed with this key, for this channel.
  [[nodiscard]] Reject open(std::string_view channel, ByteView payload,
                            SignedPayload& opened) const;

 private:
  struct Impl;
  [[nodiscard]] std::uint64_t codeOf(std::string_view channel, ByteView bytes) const;
  std::shared_ptr<const Impl> impl_;
};

/// The payload without a signature, if it has one: for a receiver without a key.
[[nodiscard]] ByteView withoutSignature(ByteView payload);

/// Whether signed messages of one sender and kind are new: each one's time is later than all before
/// it, and near the receiver's. So nothing is taken twice, and after a restart of the receiver
/// nothing that is older than kMostSignatureAgeUs.
class ReplayGuard {
 public:
  /// Replayed, or None; the message then counts.
  [[nodiscard]] Reject take(std::int64_t sentUtimeUs, std::int64_t receiveUtimeUs);

 private:
  std::int64_t last_ = 0;
};

}  // namespace foretouch
