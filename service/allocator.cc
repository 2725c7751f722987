// Programs that constantly allocate and free messages of megabytes on all cores use jemalloc. The allocator of the C
// library either returns such blocks to the system at once, and the page faults then cost more than the messages, or it
// keeps in each of its arenas the maximum that was ever in use there.
#include <jemalloc/jemalloc.h>

// Read by jemalloc when the program starts (jemalloc(3), TUNING); the environment variable MALLOC_CONF overrides it.
// Memory that was not used for a second is returned to the system. Threads of jemalloc do so, and therefore also when
// there are no more calls. The default, ten seconds, is no faster and keeps a third more memory under mixed load.
const char* malloc_conf = "background_thread:true,dirty_decay_ms:1000";
