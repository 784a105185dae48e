// network/service/held_records.h: what a stream says is to be recorded, kept until the world that
// moves has been told of it, so that the journal has the world's order. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "network/service/service_channels.h"
#include "network/service/service_counts.h"
#include "network/stream/bound_stream.h"
#include "network/wire/codec.h"

namespace foretouch::internal {

/// Where messages of a service go.
class Outlet {
 public:
  virtual ~Outlet() = default;
  /// Leaves the payload as it was.
  virtual void publish(const std::string& channel, Bytes& payload) = 0;
  virtual void record(std::int64_t utimeUs, const std::string& channel, ByteView payload) = 0;
};

/// What is to be recorded as soon as the world is told of it. Keeps its memory.
class HeldRecords {
 public:
  void add(std::int64_t utimeUs, const std::string& channel, ByteView payload);
  void flush(Outlet& outlet);

 private:
  struct Held {
    std::int64_t utimeUs = 0;
    const std::string* channel = nullptr;
    Bytes payload;
  };
  std::vector<Held> held_;
  std::size_t count_ = 0;
};

/// What an avatar's stream says is to be recorded.
class HeldStream final : public StreamRecord {
 public:
  HeldStream(const ServiceChannels& channels, ServiceCounter& counter, HeldRecords& held)
      : channels_(channels), counter_(counter), held_(held) {}
  void speaker(const SpeakerMessage& message) override;
  void skeleton(ByteView payload, std::int64_t receiveUtimeUs) override;
  void pose(ByteView payload, std::int64_t receiveUtimeUs) override;
  void leftOut() override;

 private:
  const ServiceChannels& channels_;
  ServiceCounter& counter_;
  HeldRecords& held_;
};

}  // namespace foretouch::internal
