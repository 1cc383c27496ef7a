// Freed memory stays with the process: maps and pictures of one size come and go with every frame,
// and most of the time of a fresh one was the system's, handing out and clearing pages.
#pragma once

namespace palace {

/// For main(), before threads start. Freed blocks of up to 32 MiB stay with the process until 256
/// MiB lie free together at the end of the heap: it stays near its peak. Larger blocks go back as
/// before. Where the allocator is not glibc's, or refuses, nothing changes.
void KeepFreedMemory();

}  // namespace palace
