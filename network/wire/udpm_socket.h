// network/wire/udpm_socket.h: the sockets of LCM's UDP multicast. Not installed.
#pragma once

#include <cstddef>
#include <netinet/in.h>
#include <string>

#include "articulated/result.h"
#include "assets/system_files.h"
#include "network/wire/wire.h"

namespace foretouch {

/// "udpm://239.255.76.67:7667?ttl=0".
[[nodiscard]] std::string toString(const UdpmUrl& url);
[[nodiscard]] sockaddr_in addressOf(const UdpmUrl& url);

/// The text of errno, and the command to type if a multicast route is missing.
[[nodiscard]] Error socketError(const UdpmUrl& url, const std::string& what, int errorNumber);

/// Asks for a buffer of so many bytes, for stamps, and for counts of what is dropped.
void prepareToListen(int fd, std::size_t bufferBytes);

/// Non-blocking. Bound to the group on `url.port` (0: any free one, not shared) and joined.
[[nodiscard]] Result<internal::FileDescriptor> openListeningSocket(const UdpmUrl& url);
/// Non-blocking, with the ttl set.
[[nodiscard]] Result<internal::FileDescriptor> openSendingSocket(const UdpmUrl& url);

/// Joins the group on the interface that the route to it names now. Harmless if already joined;
/// needed again if that interface went away. Returns errno, 0 for joined.
int joinGroup(int fd, const UdpmUrl& url);

/// Bytes of datagrams that may wait, bookkeeping left out; 0: the system does not say.
[[nodiscard]] std::size_t receiveBufferOf(int fd);

/// Waits until there is something to read. False: nothing within the time, or interrupted.
[[nodiscard]] bool waitReadable(int fd, int timeoutMs);

}  // namespace foretouch
