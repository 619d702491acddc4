// Files that come with a plugin: beside <kind>-<name>.so, in the folder <kind>-<name>, where
// candela_add_plugin(… DATA …) puts them.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace candela::sdk {

/// Something of this library and no other, by which it is found.
[[maybe_unused]] static const char k_in_this_library = 0;

/// The absolute path of the folder of the plugin's own files, wherever the plugin has been moved or copied
/// to. To be called where an instance is made, not while another program's folder is current. Whether the
/// folder is there is not looked at. Throws std::runtime_error if the plugin is in no library. Any thread.
inline std::filesystem::path data_folder() {
    Dl_info info{};
    if (::dladdr(&k_in_this_library, &info) == 0 || info.dli_fname == nullptr)
        throw std::runtime_error("the plugin's own folder cannot be found");
    return std::filesystem::absolute(info.dli_fname).replace_extension();
}

}  // namespace candela::sdk
