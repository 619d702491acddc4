#include "candela/plugin/descriptor.h"

#include <array>
#include <optional>
#include <string_view>

namespace candela {

namespace {
constexpr std::array<std::string_view, k_plugin_kinds.size()> k_names = {"light", "reflection", "shading",
                                                                         "shape", "image",      "target"};
}

Instance::~Instance() = default;

std::span<const float> Instance::table(std::size_t) const noexcept { return {}; }

std::string_view name_of(PluginKind kind) noexcept { return k_names[static_cast<std::size_t>(kind)]; }

std::optional<PluginKind> plugin_kind_named(std::string_view name) noexcept {
    for (const PluginKind kind : k_plugin_kinds) {
        if (name_of(kind) == name) return kind;
    }
    return std::nullopt;
}

}  // namespace candela
