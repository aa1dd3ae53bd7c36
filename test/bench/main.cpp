// With its memory as the program has it.
#include <benchmark/benchmark.h>

#include "core/base/kept_memory.h"

int main(int argc, char** argv) {
  odolab::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
