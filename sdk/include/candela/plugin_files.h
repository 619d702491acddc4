// Files that come with a plugin: next to <kind>-<name>.so, in the folder <kind>-<name>, where
// candela_add_plugin(… DATA …) puts them.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace candela::sdk {

/// An object in this library, by whose address the library is found.
[[maybe_unused]] static const char k_in_this_library = 0;

/// The absolute path of the folder with the plugin's own files, wherever the plugin has been moved or copied.
/// Call it while creating an instance, and not while the current directory is another program's. Does not
/// check that the folder exists. Throws std::runtime_error if the plugin is not in a library. Any thread.
inline std::filesystem::path data_folder() {
    Dl_info info{};
    if (::dladdr(&k_in_this_library, &info) == 0 || info.dli_fname == nullptr)
        throw std::runtime_error("the plugin's own folder cannot be found");
    return std::filesystem::absolute(info.dli_fname).replace_extension();
}

}  // namespace candela::sdk
