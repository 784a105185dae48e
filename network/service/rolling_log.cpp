#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "articulated/try.h"
#include "network/log/event_log.h"
#include "network/service/journal.h"
#include "network/wire/messages.h"

namespace foretouch {
namespace {

namespace fs = std::filesystem;

/// The size of an event beside its channel and payload (network/log/event_log.h).
constexpr std::uint64_t kEventBytes = 28;

class RollingLog final : public JournalSink {
 public:
  RollingLog(std::string path, EventLogWriter writer, const LogLimits& limits,
             std::string skeletonChannel)
      : path_(std::move(path)),
        limits_(limits),
        skeletonChannel_(std::move(skeletonChannel)),
        writer_(std::move(writer)) {
    files_.push_back(path_);
  }

  Result<Done> write(std::int64_t utimeUs, const std::string& channel, ByteView payload) override {
    const std::uint64_t bytes = sizeOf(channel, payload);
    if (!writer_ || (limits_.bytes > 0 && bytes_ > 0 && bytes_ + bytes > limits_.bytes)) {
      FORETOUCH_CHECK(roll(utimeUs));
    }
    if (limits_.bytes > 0 && channel == skeletonChannel_) remember(payload);
    bytes_ += bytes;
    return writer_->write(utimeUs, channel, payload);
  }
  Result<Done> flush() override { return writer_ ? writer_->flush() : Result<Done>(Done{}); }
  Result<Done> close() override { return writer_ ? writer_->close() : Result<Done>(Done{}); }

 private:
  static std::uint64_t sizeOf(const std::string& channel, ByteView payload) {
    return kEventBytes + channel.size() + payload.size;
  }

  /// So that poses of the next file have theirs.
  void remember(ByteView payload) {
    SkeletonMessage message;
    if (decode(payload, message) != Reject::None) return;
    skeletons_[message.avatar].assign(payload.data, payload.data + payload.size);
  }

  [[nodiscard]] std::string nameOf(int number) const {
    const fs::path path(path_);
    const std::string name =
        path.stem().string() + "." + std::to_string(number) + path.extension().string();
    return (path.parent_path() / name).string();
  }

  /// By whatever it is, also a link that leads nowhere.
  static bool isTaken(const std::string& path) {
    std::error_code unknown;
    return fs::exists(fs::symlink_status(path, unknown));
  }

  /// After an error the next event tries again.
  Result<Done> roll(std::int64_t utimeUs) {
    // Room first: the disk may be full of these.
    while (files_.size() >= static_cast<std::size_t>(limits_.files)) {
      std::error_code none;
      fs::remove(files_.front(), none);  // gone already, or not ours to mend
      files_.pop_front();
    }
    if (writer_) FORETOUCH_CHECK(writer_->close());
    writer_.reset();
    // An earlier run under this name may have left some behind; they stay.
    while (isTaken(nameOf(number_ + 1))) ++number_;
    const std::string next = nameOf(number_ + 1);
    FORETOUCH_TRY(auto writer, EventLogWriter::create(next));
    ++number_;
    writer_ = std::move(writer);
    files_.push_back(next);
    bytes_ = 0;
    for (const auto& [avatar, payload] : skeletons_) {
      bytes_ += sizeOf(skeletonChannel_, payload);
      FORETOUCH_CHECK(writer_->write(utimeUs, skeletonChannel_, payload));
    }
    return Done{};
  }

  std::string path_;
  LogLimits limits_;
  std::string skeletonChannel_;
  std::optional<EventLogWriter> writer_;  // none: the next one could not be made yet
  std::uint64_t bytes_ = 0;               // of the file at hand
  int number_ = 1;
  std::deque<std::string> files_;  // that are there, oldest first
  std::map<std::int32_t, Bytes> skeletons_;
};

}  // namespace

Result<std::unique_ptr<JournalSink>> createLogSink(const std::string& path, const LogLimits& limits,
                                                   const std::string& skeletonChannel) {
  FORETOUCH_TRY(auto writer, EventLogWriter::create(path));
  return std::unique_ptr<JournalSink>(
      std::make_unique<RollingLog>(path, std::move(writer), limits, skeletonChannel));
}

}  // namespace foretouch
