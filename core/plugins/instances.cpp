module;

#include "candela/plugin/instances.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

module candela.plugins;

import candela.api;

namespace candela {

extern "C++" std::unique_ptr<Instance> make_instance(std::string_view directory, PluginKind kind,
                                                     std::string_view name,
                                                     std::span<const ParamSetting> settings) {
    // One registry per call: a test creates few instances, and must see a plugin that was built again.
    Registry registry({std::filesystem::path(directory)});
    ParamSet values = registry.parameters(kind, name);
    for (const ParamSetting& setting : settings) values.set(setting.name, setting.value);
    const auto made = [&]<class Interface>(std::type_identity<Interface>) -> std::unique_ptr<Instance> {
        return registry.create<Interface>(name, values, ColorEncoding::none);
    };
    switch (kind) {
        case PluginKind::light:
            return made(std::type_identity<Light>());
        case PluginKind::reflection:
            return made(std::type_identity<ReflectionModel>());
        case PluginKind::shading:
            return made(std::type_identity<ShadingModel>());
        case PluginKind::shape:
            return made(std::type_identity<Shape>());
        case PluginKind::image:
            return made(std::type_identity<ImageFormat>());
        case PluginKind::target:
            return made(std::type_identity<Target>());
    }
    return nullptr;
}

}  // namespace candela
