// Freed memory stays with the process: maps and pictures of one size come and go with every frame,
// and most of the time of a fresh one was the system's, handing out and clearing pages.
#pragma once

namespace palace {

/// For main(), before threads start. Up to 256 MiB that were in use and were freed are kept; single
/// blocks above 32 MiB go back as before. Where the allocator is not glibc's nothing changes.
void KeepFreedMemory();

}  // namespace palace
