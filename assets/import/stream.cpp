#include "assets/import/stream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

struct Greeting {
  std::array<char, 8> magic = {'F', 'T', 'I', 'M', 'P', 'O', 'R', 'T'};
  std::uint32_t version = 3;
  std::uint32_t byteOrder = 0x01020304;
};
struct FrameHead {
  std::uint32_t type, bytes;
};
struct Trailer {
  std::uint64_t count, checksum;
};

/// Without padding. 0: not declared.
struct FileFrameRecord {
  double declaredUnit, unit;
  std::uint32_t declaredUp, up, isOfFormat, unused;
};

std::uint32_t numberOf(UpAxis up) {
  return up == UpAxis::Z ? 2 : 1;
}

/// Nothing if the record cannot be.
std::optional<FileFrame> frameIn(const FileFrameRecord& record) {
  const auto isUnit = [](double unit) { return std::isfinite(unit) && unit > 0.0; };
  const bool isDeclaredUnit = record.declaredUnit != 0.0;
  if ((isDeclaredUnit && !isUnit(record.declaredUnit)) || !isUnit(record.unit)) return {};
  if (record.declaredUp > 2 || record.up < 1 || record.up > 2 || record.isOfFormat > 1) return {};
  FileFrame frame;
  if (isDeclaredUnit) frame.declared.metresPerUnit = record.declaredUnit;
  if (record.declaredUp != 0) {
    frame.declared.up = record.declaredUp == 2 ? UpAxis::Z : UpAxis::Y;
  }
  frame.declared.isOfFormat = record.isOfFormat == 1;
  frame.metresPerUnit = record.unit;
  frame.up = record.up == 2 ? UpAxis::Z : UpAxis::Y;
  return frame;
}

constexpr std::uint64_t kChecksumSeed = 0xCBF29CE484222325;

/// Eight bytes per step: ten million triangles are 700 MB. The multiplier is odd, so each step is a
/// bijection of the state: a single changed word always shows.
std::uint64_t addToChecksum(std::uint64_t sum, std::string_view bytes) {
  const auto add = [&sum](std::uint64_t word) {
    sum = (sum ^ word) * 0x9E3779B97F4A7C15;
    sum ^= sum >> 32;
  };
  while (bytes.size() >= sizeof(std::uint64_t)) {
    add(valueIn<std::uint64_t>(bytes));
    bytes.remove_prefix(sizeof(std::uint64_t));
  }
  std::uint64_t last = bytes.size();
  for (const char byte : bytes) last = last << 8 | static_cast<unsigned char>(byte);
  add(last);
  return sum;
}

}  // namespace

FrameWriter::FrameWriter(Sink sink) : sink_(std::move(sink)), checksum_(kChecksumSeed) {
  put(bytesOf(Greeting{}));
}

void FrameWriter::put(std::string_view bytes) {
  outgoing_ += bytes;
  if (outgoing_.size() >= kMaxImportFrameBytes) flush();
}

void FrameWriter::flush() {
  intact_ = intact_ && sink_(outgoing_);
  outgoing_.clear();
}

void FrameWriter::frame(std::uint32_t type, std::string_view payload) {
  const FrameHead head{type, static_cast<std::uint32_t>(payload.size())};
  checksum_ = addToChecksum(addToChecksum(checksum_, bytesOf(head)), payload);
  put(bytesOf(head));
  put(payload);
}

bool FrameWriter::end(std::uint64_t count) {
  frame(kTrailerFrame, bytesOf(Trailer{count, checksum_}));
  flush();
  return intact_;
}

bool FrameWriter::fail(ImportFailure failure, std::string_view text) {
  std::string payload(bytesOf(failure));
  payload += text.substr(0, kMaxFailureTextBytes);
  frame(kFailureFrame, payload);
  flush();
  return intact_;
}

void FrameWriter::fileFrame(const FileFrame& fileFrame) {
  const DeclaredFrame& declared = fileFrame.declared;
  frame(kFileFrame,
        bytesOf(FileFrameRecord{declared.metresPerUnit.value_or(0.0), fileFrame.metresPerUnit,
                                declared.up ? numberOf(*declared.up) : 0, numberOf(fileFrame.up),
                                declared.isOfFormat ? 1U : 0U, 0}));
}

FrameReader::State FrameReader::feed(std::string_view bytes) {
  if (state_ != State::Reading) return state_;
  // Parses whole frames in place; keeps only an incomplete one.
  const bool continues = !pending_.empty();
  if (continues) {
    pending_ += bytes;
    bytes = pending_;
  }
  std::size_t parsed = 0;
  while (state_ == State::Reading) {
    const std::size_t step = parseOne(bytes.substr(parsed));
    if (step == 0) break;
    parsed += step;
  }
  if (continues) {
    pending_.erase(0, parsed);
  } else {
    pending_ = bytes.substr(parsed);
  }
  return state_;
}

/// Parses the first frame; returns its size, 0 if it is not yet complete.
std::size_t FrameReader::parseOne(std::string_view bytes) {
  if (!greeted_) return parseGreeting(bytes);
  if (bytes.size() < sizeof(FrameHead)) return 0;
  const auto head = valueIn<FrameHead>(bytes);
  if (head.bytes > kMaxImportFrameBytes) {
    breakOff("a frame of " + std::to_string(head.bytes) + " bytes");
    return 0;
  }
  const std::size_t size = sizeof head + head.bytes;
  if (bytes.size() < size) return 0;
  const std::string_view payload = bytes.substr(sizeof head, head.bytes);
  if (head.type == kFailureFrame) {
    parseFailure(payload);
  } else if (head.type == kFileFrame) {
    parseFileFrame(payload);
  } else if (head.type == kTrailerFrame) {
    parseTrailer(payload);
  } else {
    parseFrame(head.type, payload);
  }
  checksum_ = addToChecksum(addToChecksum(checksum_, bytesOf(head)), payload);
  return size;
}

std::size_t FrameReader::parseGreeting(std::string_view bytes) {
  const Greeting expected;
  // Judges the bytes present: garbage shorter than a greeting is still garbage.
  const std::size_t present = std::min(bytes.size(), sizeof expected);
  if (bytes.substr(0, present) != bytesOf(expected).substr(0, present)) {
    breakOff("it does not open with the greeting of this version");
    return 0;
  }
  if (present < sizeof expected) return 0;
  greeted_ = true;
  checksum_ = kChecksumSeed;
  return sizeof expected;
}

void FrameReader::parseFailure(std::string_view payload) {
  if (payload.size() < sizeof(ImportFailure)) return breakOff("a failure of a wrong size");
  const auto failure = valueIn<std::uint32_t>(payload);
  if (failure == 0 || failure > static_cast<std::uint32_t>(ImportFailure::OutOfMemory)) {
    return breakOff("a failure of unknown kind");
  }
  failure_ = static_cast<ImportFailure>(failure);
  failureText_ = readableText(payload.substr(sizeof failure), kMaxFailureTextBytes);
  state_ = State::Failed;
}

void FrameReader::parseFileFrame(std::string_view payload) {
  if (payload.size() != sizeof(FileFrameRecord)) return breakOff("a file's frame of a wrong size");
  const auto frame = frameIn(valueIn<FileFrameRecord>(payload));
  if (!frame) return breakOff("a file's unit or axis that cannot be");
  fileFrame_ = *frame;
}

void FrameReader::parseTrailer(std::string_view payload) {
  if (payload.size() != sizeof(Trailer)) return breakOff("a trailer of a wrong size");
  const auto trailer = valueIn<Trailer>(payload);
  if (!isWhole(trailer.count)) return breakOff("a trailer before everything promised arrived");
  if (trailer.checksum != checksum_) return breakOff("a wrong checksum");
  state_ = State::Complete;
}

void FrameReader::breakOff(std::string reason) {
  state_ = State::Broken;
  broken_ = std::move(reason);
}

}  // namespace foretouch::internal
