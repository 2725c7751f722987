// Keeps OpenSSL usable until a process is gone.
#pragma once

namespace albtpu {

// By default OpenSSL frees what it holds when main() has returned, while threads of gRPC may still use it: a program
// that has done its work may then crash as it ends (https://github.com/grpc/grpc/issues/38539; gRPC asks for the same
// since 1.83). This has an effect only before the first use of OpenSSL in the process, so call it for a constant of a
// file, which is initialized before main(). Returns whether OpenSSL could be initialized.
bool KeepOpenSslAtExit();

}  // namespace albtpu
