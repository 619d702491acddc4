// A plugin's description of itself, and the base class of everything it creates.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "candela/color.h"
#include "candela/plugin/export.h"
#include "candela/plugin/needs.h"
#include "candela/plugin/params.h"

namespace candela {

enum class PluginKind : int { light, reflection, shading, shape, image, target };

inline constexpr std::array k_plugin_kinds = {PluginKind::light, PluginKind::reflection, PluginKind::shading,
                                              PluginKind::shape, PluginKind::image,      PluginKind::target};

CANDELA_EXPORT std::string_view name_of(PluginKind kind) noexcept;
CANDELA_EXPORT std::optional<PluginKind> plugin_kind_named(std::string_view name) noexcept;

/// One set of parameter values of a plugin: a light, a material, a shape. Created by the plugin and owned by
/// the host, which deletes it. Immutable after construction: every member function of the kinds is const and
/// may be called from many threads at once.
class CANDELA_EXPORT Instance {
  public:
    Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    virtual ~Instance();

    /// The numbers of the `Table` that `parameter`, an index into the descriptor's parameters, has in the
    /// struct of the plugin's kernel; empty if it has none. Owned by the instance. Programs generated from
    /// them neither read the parameter's file nor repeat what the plugin computed from it.
    virtual std::span<const float> table(std::size_t parameter) const noexcept;
};

/// A fact that a plugin declares, for listings and the conformance kit: {"reciprocal", "true"}.
struct Property {
    const char* name = "";
    const char* value = "true";
};

/// A file format that an image plugin writes, and optionally reads.
struct FileFormat {
    const char* extension = "";  // lower case, without the dot
    const char* title = "";
    PixelType pixels = PixelType::byte;
    bool reads = false;
    bool layers = false;  // ImageFormat::write_layers() writes it
};

/// A function of a kernel that programs call: <prefix>_<name>.
struct KernelFunction {
    const char* name = "";          // "reflect", "corner_weight"
    bool takes_parameters = false;  // its first argument is the parameter struct
};

/// The mathematics of a plugin as text, from which programs are generated.
struct KernelText {
    const char* text = nullptr;    // the whole .kernel file; null if there is none
    const char* prefix = nullptr;  // its functions are named <prefix>_reflect, <prefix>_normal, …
    const char* parameters =
        "";  // the struct that is their first argument; its members have the parameters' names
    std::span<const KernelFunction> functions{};
    std::span<const std::size_t> members{};  // the struct's members in order, as indices of parameters
};

/// Everything about one plugin. Plain data with static lifetime in the plugin's library.
struct PluginDescriptor {
    PluginKind kind = PluginKind::light;
    const char* name = "";       // "half-lambert"; lower case, digits, hyphens
    const char* version = "";    // of the plugin
    const char* title = "";      // "Half Lambert"
    const char* summary = "";    // one sentence
    const char* formula = "";    // as text; lines separated by \n
    const char* reference = "";  // author, year, title; empty if there is none
    std::span<const ParamSpec> parameters{};
    std::span<const RelationSpec> relations{};
    std::span<const Property> properties{};
    std::span<const PresetSpec> presets{};
    std::span<const FileFormat> formats{};  // image plugins only
    bool has_ambient = false;      // lights only: Light::illuminate_ambient() is overridden, and writes
    SurfaceNeeds surface_needs{};  // reflection models only
    ShadingNeeds shading_needs{};  // shading models only
    KernelText kernel{};

    /// Creates an instance of the kind's interface class. `values` are in the order of `parameters`. May
    /// throw std::exception for bad files or values. Any thread.
    Instance* (*create)(std::span<const ParamValue> values) = nullptr;
};

}  // namespace candela
