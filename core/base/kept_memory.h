// Memory that a process has given back, kept for when it asks again.
#pragma once

namespace odolab {

// To be called once, at a program's start. A fit gives back and asks for the same megabytes again and again; fetched
// anew from the system each time, they were a fifth of a diagnosis. Does nothing where the allocator is not glibc's.
void keep_freed_memory();

}  // namespace odolab
