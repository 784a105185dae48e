#include "network/vmc/osc.h"

#include <cstdint>
#include <cstring>

namespace foretouch {
namespace {

constexpr std::size_t kWord = 4;
constexpr std::string_view kBundle{"#bundle\0", 8};
constexpr std::size_t kTimeTag = 8;

/// The length with the zeros after it, of which there is at least one.
std::size_t padded(std::size_t length) {
  return length / kWord * kWord + kWord;
}

/// The number that has these bits.
template <typename Number, typename Bits>
Number numberOf(Bits bits) {
  static_assert(sizeof(Number) == sizeof(Bits));
  Number number{};
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

/// Bytes of an argument that has no text and no size of its own; nothing: there is no such type.
std::optional<std::size_t> bytesOf(char type) {
  constexpr std::string_view kNothing = "TFNI[]", kWords = "ifcrm", kLongs = "hdt";
  if (kNothing.find(type) != std::string_view::npos) return 0;
  if (kWords.find(type) != std::string_view::npos) return 4;
  if (kLongs.find(type) != std::string_view::npos) return 8;
  return std::nullopt;
}

}  // namespace

OscReader::OscReader(ByteView packet) : packet_(packet) {
  if (packet.size == 0 || packet.size % kWord != 0) fail();
}

std::uint32_t OscReader::wordAt(std::size_t at) const {
  const std::uint8_t* const byte = packet_.data + at;
  return std::uint32_t{byte[0]} << 24 | std::uint32_t{byte[1]} << 16 | std::uint32_t{byte[2]} << 8 |
         std::uint32_t{byte[3]};
}

bool OscReader::fail() {
  isBroken_ = true;
  return false;
}

bool OscReader::next(OscMessage& message) {
  if (isBroken_) return false;
  if (at_ == 0) {
    if (enter(packet_.size)) return readMessage(packet_.size, message);
    if (isBroken_) return false;
  }
  while (depth_ > 0) {
    if (at_ == ends_[depth_ - 1]) {
      --depth_;
      continue;
    }
    const std::size_t end = ends_[depth_ - 1];
    if (left(end) < kWord) return fail();
    const std::size_t size = wordAt(at_);
    at_ += kWord;
    if (size == 0 || size % kWord != 0 || size > left(end)) return fail();
    if (enter(at_ + size)) return readMessage(at_ + size, message);
    if (isBroken_) return false;
  }
  return false;
}

/// True if what is here is a message; a bundle is opened.
bool OscReader::enter(std::size_t end) {
  const bool isBundle = left(end) >= kBundle.size() &&
                        std::memcmp(packet_.data + at_, kBundle.data(), kBundle.size()) == 0;
  if (!isBundle) return true;
  if (left(end) < kBundle.size() + kTimeTag || depth_ == kMaxOscDepth) return fail();
  at_ += kBundle.size() + kTimeTag;
  ends_[depth_++] = end;
  return false;
}

bool OscReader::readMessage(std::size_t end, OscMessage& message) {
  message.numArguments = 0;
  std::string_view types;
  if (!readText(end, message.address) || message.address.empty() || message.address[0] != '/') {
    return fail();
  }
  // Old senders leave out the types of a message without arguments.
  if (at_ == end) return true;
  if (!readText(end, types) || types.empty() || types[0] != ',') return fail();
  types.remove_prefix(1);
  for (const char type : types) {
    OscArgument argument;
    if (!readArgument(type, end, argument)) return fail();
    if (message.numArguments < kMaxOscArguments)
      message.arguments[message.numArguments++] = argument;
  }
  return at_ == end || fail();
}

bool OscReader::readText(std::size_t end, std::string_view& text) {
  const auto* const begin = reinterpret_cast<const char*>(packet_.data + at_);
  const void* const nul = std::memchr(begin, 0, left(end));
  if (nul == nullptr) return false;
  text = {begin, static_cast<std::size_t>(static_cast<const char*>(nul) - begin)};
  const std::size_t size = padded(text.size());
  if (size > left(end)) return false;
  for (std::size_t i = text.size(); i < size; ++i) {
    if (begin[i] != 0) return false;
  }
  at_ += size;
  return true;
}

bool OscReader::readArgument(char type, std::size_t end, OscArgument& argument) {
  const std::size_t from = at_;
  const auto take = [&](std::size_t bytes) {
    if (bytes > left(end)) return false;
    at_ += bytes;
    return true;
  };
  if (type == 's' || type == 'S') {
    std::string_view text;
    if (!readText(end, text)) return false;
    argument.text = text;
    return true;
  }
  if (type == 'b') {
    if (!take(kWord)) return false;
    const std::size_t size = wordAt(from);
    return size <= left(end) && take((size + kWord - 1) / kWord * kWord);
  }
  const auto bytes = bytesOf(type);
  if (!bytes || !take(*bytes)) return false;
  const auto longAt = [&] { return std::uint64_t{wordAt(from)} << 32 | wordAt(from + kWord); };
  if (type == 'i') argument.number = numberOf<std::int32_t>(wordAt(from));
  if (type == 'f') argument.number = numberOf<float>(wordAt(from));
  if (type == 'h') argument.number = static_cast<double>(numberOf<std::int64_t>(longAt()));
  if (type == 'd') argument.number = numberOf<double>(longAt());
  return true;
}

bool isOscPacket(ByteView packet) {
  OscReader reader(packet);
  OscMessage message;
  while (reader.next(message)) {
  }
  return !reader.isBroken();
}

}  // namespace foretouch
