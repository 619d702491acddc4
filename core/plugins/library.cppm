module;

#include "candela/plugin/export.h"

#include <filesystem>
#include <string>
#include <string_view>

export module candela.plugins:library;

export import :manifest;

export namespace candela {

/// Loads a library and checks it against `manifest` (null: the fingerprint only); the handshake precedes any
/// other call into it. Throws Error with a plain sentence. The library stays loaded until the process ends.
/// Any thread.
CANDELA_EXPORT const PluginDescriptor& load_plugin(const std::filesystem::path& library,
                                                   const Manifest* manifest);

/// Why a library is not an ELF file of the size that its headers say; empty if it is one. The loader silently
/// maps a truncated file, and the process ends with SIGBUS when it touches a missing page. Throws Error
/// (failure) if it cannot be read.
CANDELA_EXPORT std::string library_damage(const std::filesystem::path& library);

/// Rethrows a plugin's exception as an Error that names the plugin. Call it in a catch block.
[[noreturn]] CANDELA_EXPORT void rethrow_as_plugin_error(PluginKind kind, std::string_view name);

}  // namespace candela
