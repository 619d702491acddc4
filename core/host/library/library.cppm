module;

#include "candela/api.h"

#include <filesystem>
#include <string>
#include <string_view>

export module candela.library;

export import candela.manifest;

export namespace candela {

/// Loads a library and checks it against `manifest` (null: the fingerprint only); the handshake comes before
/// any other call into it. Throws Error with a plain sentence. The library stays loaded until the process
/// ends. Any thread.
CANDELA_API const PluginDescriptor& load_plugin(const std::filesystem::path& library,
                                                const Manifest* manifest);

/// Why a library is no whole ELF file of this machine, without running any of it; empty if it is one. The
/// loader maps a truncated file without a word, and the process ends with SIGBUS where its pages are missing.
CANDELA_API std::string library_damage(const std::filesystem::path& library);

/// Rethrows a plugin's exception as an Error that names the plugin; call it in a catch block.
[[noreturn]] CANDELA_API void rethrow_as_plugin_error(PluginKind kind, std::string_view name);

}  // namespace candela
