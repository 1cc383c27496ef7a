// The files that a run of an experiment reads: a run must not go on with an edited one.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace palace {

/// " files 3f2a9c", of the names and bytes of all files that the options of a run name: files,
/// those of a folder of data, and what a TOML file among them names in turn, such as the meshes of
/// a world. Empty where they name none.
std::string InputsOf(const CLI::App& verb);

}  // namespace palace
