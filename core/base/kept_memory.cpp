#include "core/base/kept_memory.h"

#include <cstdlib>  // which says whether the library is glibc

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace odolab {

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

}  // namespace odolab
