#include "app/cli/command.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // A fit gives back and asks for the same megabytes again and again; fetched anew from the system each time, they were
  // a fifth of a diagnosis.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
  return odolab::run_command_line(argc, argv);
}
