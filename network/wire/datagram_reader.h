// network/wire/datagram_reader.h: reads a socket's datagrams, many per call, from the senders that
// are heard. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "assets/system_files.h"
#include "network/wire/codec.h"
#include "network/wire/udpm_senders.h"
#include "network/wire/wire.h"

namespace foretouch {

/// An error of a socket that passes: of a link, of memory, of a route.
[[nodiscard]] bool isPassing(int errorNumber);

class DatagramReader {
 public:
  /// `socket`: non-blocking.
  DatagramReader(internal::FileDescriptor socket, SenderFilter filter);
  ~DatagramReader();

  /// `utimeUs`: the kernel's stamp if there is one. The bytes are valid during the call.
  using Take = std::function<void(const UdpmSender&, ByteView, std::int64_t utimeUs)>;
  /// How many datagrams there were, foreign ones among them; negative: an error, in errno. Waits
  /// for none.
  int read(const Take& take);

  [[nodiscard]] int fd() const { return socket_.get(); }
  [[nodiscard]] std::uint64_t foreign() const { return foreign_; }
  [[nodiscard]] std::uint64_t kernelDrops() const { return kernelDrops_; }

 private:
  class Batch;
  const internal::FileDescriptor socket_;
  SenderFilter filter_;
  std::unique_ptr<Batch> batch_;
  std::uint64_t kernelDrops_ = 0, foreign_ = 0;
  std::uint32_t lastDrops_ = 0;
};

}  // namespace foretouch
