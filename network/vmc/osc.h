// network/vmc/osc.h: the messages of one packet of Open Sound Control 1.0. Pure and bounded: reads
// any bytes, allocates nothing, and looks at each byte a bounded number of times. Time tags are not
// heeded: VMC's senders say "now". Not installed.
// Source: opensoundcontrol.stanford.edu, "OSC 1.0 specification". Numbers are big-endian; texts end
// with one to four zeros, so that everything begins at a multiple of four bytes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "network/wire/codec.h"

namespace foretouch {

/// More arguments than any message has that is of use here; what is beyond is passed over.
inline constexpr std::size_t kMaxOscArguments = 16;
/// Bundles within bundles, deeper than which none goes.
inline constexpr std::size_t kMaxOscDepth = 8;

/// A number (of the types i, h, f, d), or a text (s, S); neither, if it is of another type.
struct OscArgument {
  std::optional<double> number;
  std::optional<std::string_view> text;
};

/// Views into the packet.
struct OscMessage {
  std::string_view address;
  std::array<OscArgument, kMaxOscArguments> arguments;
  std::size_t numArguments = 0;
};

class OscReader {
 public:
  explicit OscReader(ByteView packet);
  /// False at the packet's end, and where its bytes break a rule.
  [[nodiscard]] bool next(OscMessage& message);
  [[nodiscard]] bool isBroken() const { return isBroken_; }

 private:
  bool enter(std::size_t end);
  bool readMessage(std::size_t end, OscMessage& message);
  bool readArgument(char type, std::size_t end, OscArgument& argument);
  bool readText(std::size_t end, std::string_view& text);
  [[nodiscard]] std::size_t left(std::size_t end) const { return end - at_; }
  [[nodiscard]] std::uint32_t wordAt(std::size_t at) const;
  bool fail();

  ByteView packet_;
  std::size_t at_ = 0;
  std::array<std::size_t, kMaxOscDepth> ends_{};  // of the bundles that are open
  std::size_t depth_ = 0;
  bool isBroken_ = false;
};

/// Whether every byte of it keeps the rules.
[[nodiscard]] bool isOscPacket(ByteView packet);

}  // namespace foretouch
