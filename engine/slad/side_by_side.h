// Work shared among OpenCV's threads: each part is done the same whoever does it. Internal to the
// SLAD room.
#pragma once

#include <functional>
#include <initializer_list>

namespace palace {

/// work(0) .. work(count - 1): rows of a map, or stripes, or tiles.
void ForEach(int count, const std::function<void(int)>& work);

/// Jobs that do not touch what the others write. Of large maps the system's work of handing out
/// memory is much of it: layers are laid out so.
void SideBySide(std::initializer_list<std::function<void()>> jobs);

}  // namespace palace
