#include "app/cli/command.h"
#include "core/base/kept_memory.h"

int main(int argc, char** argv) {
  odolab::keep_freed_memory();
  return odolab::run_command_line(argc, argv);
}
