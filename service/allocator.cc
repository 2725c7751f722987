// Programs that allocate and free messages of megabytes all the time, on all cores, take their memory from
// jemalloc. The allocator of the C library either gives such blocks back at once, and the page faults then cost more
// than the messages do, or keeps in each of its arenas the most that was ever in use there.
#include <jemalloc/jemalloc.h>

// Read by jemalloc when the program starts: jemalloc(3), TUNING; the environment variable MALLOC_CONF has the last
// word. What was not used for a second goes back to the system, by threads of jemalloc, so also when nothing is
// asked any more. The default, ten seconds, is no faster and keeps a third more under mixed load.
const char* malloc_conf = "background_thread:true,dirty_decay_ms:1000";
