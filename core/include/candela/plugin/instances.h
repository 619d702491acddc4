// Makes instances as a host does, for tests of plugins built by any compiler. Programs use the module
// candela.plugins.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// The value of a parameter as written in a scene: degrees, colours 0-255.
struct ParamSetting {
    std::string_view name;
    std::variant<bool, std::int64_t, double, std::string, Vec3, Matrix, NumberList> value;
};

/// Creates an instance of the plugin in `directory`, which must contain both its library and its manifest.
/// Parameters not among `settings` have their defaults. Throws std::exception with the message that a user
/// would see.
CANDELA_EXPORT std::unique_ptr<Instance> make_instance(std::string_view directory, PluginKind kind,
                                                       std::string_view name,
                                                       std::span<const ParamSetting> settings);

}  // namespace candela
