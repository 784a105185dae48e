#include "network/wire/message_key.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <openssl/core_names.h>
#include <openssl/evp.h>
#include <openssl/params.h>
#include <sys/stat.h>
#include <unistd.h>

#include "assets/system_files.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

constexpr std::string_view kMark = "FTSIGN01";
constexpr std::size_t kNumberBytes = 8;
static_assert(kSignatureBytes == kMark.size() + 2 * kNumberBytes);

void append(std::uint64_t number, Bytes& bytes) {
  for (int shift = 56; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

std::uint64_t numberAt(const std::uint8_t* bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < kNumberBytes; ++i) number = number << 8 | bytes[i];
  return number;
}

bool hasMark(ByteView payload) {
  return payload.size >= kSignatureBytes &&
         std::memcmp(payload.data + payload.size - kSignatureBytes, kMark.data(), kMark.size()) ==
             0;
}

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

/// OpenSSL's own state of the key, which each code begins with a copy of.
struct MessageKey::Impl {
  explicit Impl(const std::array<std::uint8_t, kKeyBytes>& key)
      : method(EVP_MAC_fetch(nullptr, "SIPHASH", nullptr), EVP_MAC_free),
        start(method ? EVP_MAC_CTX_new(method.get()) : nullptr, EVP_MAC_CTX_free) {
    std::size_t size = kNumberBytes;
    unsigned compressions = 2, finals = 4;
    const OSSL_PARAM parameters[] = {
        OSSL_PARAM_construct_size_t(OSSL_MAC_PARAM_SIZE, &size),
        OSSL_PARAM_construct_uint(OSSL_MAC_PARAM_C_ROUNDS, &compressions),
        OSSL_PARAM_construct_uint(OSSL_MAC_PARAM_D_ROUNDS, &finals), OSSL_PARAM_construct_end()};
    isReady =
        start != nullptr && EVP_MAC_init(start.get(), key.data(), key.size(), parameters) == 1;
  }
  std::unique_ptr<EVP_MAC, void (*)(EVP_MAC*)> method;
  std::unique_ptr<EVP_MAC_CTX, void (*)(EVP_MAC_CTX*)> start;
  bool isReady = false;  ///< A system that allows only FIPS methods has no SipHash.
};

MessageKey::MessageKey(const std::array<std::uint8_t, kKeyBytes>& key)
    : impl_(std::make_shared<const Impl>(key)) {}

Result<MessageKey> MessageKey::read(const std::string& path) {
  const auto refused = [&](ErrorCode code, const std::string& why) {
    return Error::in(path, code, why);
  };
  const internal::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat facts {};
  if (file.get() < 0 || ::fstat(file.get(), &facts) != 0) {
    return refused(ErrorCode::FileUnreadable, std::strerror(errno));
  }
  if (!S_ISREG(facts.st_mode)) {
    return refused(ErrorCode::FileUnreadable, "expected a regular file");
  }
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return refused(ErrorCode::OutOfRange,
                   "expected a key that its owner alone can read; type: chmod 600 " + path);
  }
  std::array<char, 2 * kKeyBytes + 2> text{};
  const ssize_t got = ::read(file.get(), text.data(), text.size());
  const bool endsRight =
      got == 2 * kKeyBytes || (got == 2 * kKeyBytes + 1 && text[2 * kKeyBytes] == '\n');
  std::array<std::uint8_t, kKeyBytes> key{};
  bool isHex = endsRight;
  for (std::size_t i = 0; isHex && i < kKeyBytes; ++i) {
    const int high = digitOf(text[2 * i]), low = digitOf(text[2 * i + 1]);
    isHex = high >= 0 && low >= 0;
    if (isHex) key[i] = static_cast<std::uint8_t>(high << 4 | low);
  }
  if (!isHex) {
    return refused(ErrorCode::Syntax,
                   "expected 32 hexadecimal digits, as openssl rand -hex 16 writes them");
  }
  MessageKey read(key);
  if (!read.impl_->isReady) {
    return refused(ErrorCode::DeviceFailed, "this system's libcrypto gives no SipHash");
  }
  return read;
}

std::uint64_t MessageKey::codeOf(std::string_view channel, ByteView bytes) const {
  FORETOUCH_ASSERT(impl_->isReady);
  const std::unique_ptr<EVP_MAC_CTX, void (*)(EVP_MAC_CTX*)> state(
      EVP_MAC_CTX_dup(impl_->start.get()), EVP_MAC_CTX_free);
  const std::uint8_t end = 0;
  std::array<std::uint8_t, kNumberBytes> code{};
  std::size_t size = 0;
  const bool isDone =
      state != nullptr &&
      EVP_MAC_update(state.get(), reinterpret_cast<const std::uint8_t*>(channel.data()),
                     channel.size()) == 1 &&
      EVP_MAC_update(state.get(), &end, 1) == 1 &&
      EVP_MAC_update(state.get(), bytes.data, bytes.size) == 1 &&
      EVP_MAC_final(state.get(), code.data(), &size, code.size()) == 1;
  if (!isDone) throw std::bad_alloc();  // the only reason that is left
  std::uint64_t number = 0;             // its bytes come with the lowest first
  for (auto byte = code.rbegin(); byte != code.rend(); ++byte) number = number << 8 | *byte;
  return number;
}

void MessageKey::sign(std::string_view channel, std::int64_t utimeUs, Bytes& payload) const {
  payload.insert(payload.end(), kMark.begin(), kMark.end());
  append(static_cast<std::uint64_t>(utimeUs), payload);
  append(codeOf(channel, payload), payload);
}

Reject MessageKey::open(std::string_view channel, ByteView payload, SignedPayload& opened) const {
  if (!hasMark(payload)) return Reject::Unauthenticated;
  const ByteView covered(payload.data, payload.size - kNumberBytes);
  // Two whole numbers: how long it takes to compare them reveals nothing of their bytes.
  if (codeOf(channel, covered) != numberAt(payload.data + covered.size)) {
    return Reject::Unauthenticated;
  }
  opened.content = withoutSignature(payload);
  opened.sentUtimeUs =
      static_cast<std::int64_t>(numberAt(payload.data + covered.size - kNumberBytes));
  return Reject::None;
}

ByteView withoutSignature(ByteView payload) {
  return hasMark(payload) ? ByteView(payload.data, payload.size - kSignatureBytes) : payload;
}

Reject ReplayGuard::take(std::int64_t sentUtimeUs, std::int64_t receiveUtimeUs) {
  const std::int64_t least = receiveUtimeUs - kMostSignatureAgeUs;
  const std::int64_t most = receiveUtimeUs + kMostSignatureAgeUs;
  if (sentUtimeUs <= last_ || sentUtimeUs < least || sentUtimeUs > most) return Reject::Replayed;
  last_ = sentUtimeUs;
  return Reject::None;
}

}  // namespace foretouch
