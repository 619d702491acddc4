module;

#include "candela/plugin/export.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

export module candela.plugins:manifest;

export import :parameters;
export import candela.api;

export namespace candela {

struct ManifestFormat {
    std::string extension;
    std::string title;
    PixelType pixels = PixelType::byte;
    bool reads = false;
    bool layers = false;

    friend bool operator==(const ManifestFormat&, const ManifestFormat&) = default;
};

/// A plugin's description of itself, from the file next to its library: enough to list it, describe it and
/// check a scene without loading it.
struct CANDELA_EXPORT Manifest {
    std::string abi;
    PluginKind kind = PluginKind::light;
    std::string name;
    std::string version;
    std::string title;
    std::string summary;
    std::string formula;
    std::string reference;
    std::vector<Parameter> parameters;
    std::vector<Relation> relations;
    std::vector<std::pair<std::string, std::string>> properties;
    std::vector<Preset> presets;
    std::vector<ManifestFormat> formats;
    bool has_ambient = false;  // see PluginDescriptor, like the next two
    SurfaceNeeds surface_needs{};
    ShadingNeeds shading_needs{};
    bool has_kernel = false;    // its mathematics can be exported; the text is in the library
    std::string kernel_prefix;  // see KernelText
    std::string kernel_parameters;
    // Author and licence, which the library itself does not know (candela-manifest --author, --license);
    // empty if unknown.
    std::string author;
    std::string license;  // an SPDX expression, such as "MIT"

    /// "reflection/phong"
    std::string id() const;
    std::optional<std::string> property(std::string_view property_name) const;

    friend bool operator==(const Manifest&, const Manifest&) = default;
};

/// How a parameter may be written: `intensity` of a light with a `position` is a luminous intensity or flux,
/// and of one that has only a `direction` an illuminance; all others are plain.
CANDELA_EXPORT Notation notation_of(const Manifest& manifest, const Parameter& parameter);

/// The fingerprint of this core: interface version, C++ ABI, standard library.
CANDELA_EXPORT std::string_view host_abi() noexcept;

CANDELA_EXPORT Manifest manifest_of(const PluginDescriptor& descriptor, std::string_view abi);
CANDELA_EXPORT std::string to_json(const Manifest& manifest);
/// Several manifests as one array.
CANDELA_EXPORT std::string to_json(std::span<const Manifest> manifests);
/// Throws Error (bad_request) if an author or a licence (`what` says which) is longer than 200 characters or
/// contains invisible ones.
CANDELA_EXPORT void require_name(std::string_view text, std::string_view what);
/// Throws Error with a plain sentence about `text`.
CANDELA_EXPORT Manifest manifest_from_json(std::string_view text);
/// The fingerprint that a plugin was built for, even if this Candela cannot read the rest of its manifest;
/// empty if the manifest does not state it.
CANDELA_EXPORT std::string abi_from_json(std::string_view text);

}  // namespace candela
