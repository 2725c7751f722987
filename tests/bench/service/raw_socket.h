// Plain TCP connections on this machine, for the peers of the service. What fails ends the program with a message.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace albtpu::bench {

// False when the other side has closed the connection.
bool WriteAll(int socket, const char* bytes, std::size_t count);
bool ReadAll(int socket, char* bytes, std::size_t count);

// Listens on a free port, prints it, and calls `serve(socket)` on a thread of its own for each connection until the
// process ends.
[[noreturn]] void ServeConnections(const std::function<void(int socket)>& serve);

// A connection to a port of this machine, which sends at once.
int ConnectTo(const std::string& port);

}  // namespace albtpu::bench
