#include "service/openssl_at_exit.h"

#include <openssl/crypto.h>

namespace albtpu {

bool KeepOpenSslAtExit() { return OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr) == 1; }

}  // namespace albtpu
