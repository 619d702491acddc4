// The host side of plugins: manifests, where they are looked for, and the handshake before one is used.
module;

#include "candela/api.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

export module candela.plugins;

export import candela.descriptor;
import candela.diagnostics;
import candela.image;
import candela.light;
import candela.reflection;
import candela.shading;
import candela.shape;

export namespace candela {

struct ManifestFormat {
    std::string extension;
    std::string title;
    PixelType pixels = PixelType::byte;
    bool reads = false;

    friend bool operator==(const ManifestFormat&, const ManifestFormat&) = default;
};

/// What a plugin says about itself, as it stands in the file beside its library: enough to list it, to
/// describe it and to check a scene without loading it.
struct CANDELA_API Manifest {
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
    std::vector<ManifestFormat> formats;
    bool has_kernel = false;    // its mathematics can be exported; the text itself is in the library
    std::string kernel_prefix;  // see KernelText
    std::string kernel_parameters;

    /// "reflection/phong"
    std::string id() const;
    std::optional<std::string> property(std::string_view property_name) const;

    friend bool operator==(const Manifest&, const Manifest&) = default;
};

/// The fingerprint of this core: interface version, C++ ABI, standard library.
CANDELA_API std::string_view host_abi() noexcept;

CANDELA_API Manifest manifest_of(const PluginDescriptor& descriptor, std::string_view abi);
CANDELA_API std::string to_json(const Manifest& manifest);
/// The same for several, as one array.
CANDELA_API std::string to_json(std::span<const Manifest> manifests);
/// Throws Error with a plain sentence about `text`.
CANDELA_API Manifest manifest_from_json(std::string_view text);
/// What a plugin was built for, also where this Candela cannot read the rest of its manifest; empty where the
/// manifest does not say.
CANDELA_API std::string abi_from_json(std::string_view text);

/// A plugin that was found.
struct PluginFile {
    Manifest manifest;
    std::filesystem::path library;
    SharedSchema schema;                           // the manifest's parameters
    const PluginDescriptor* descriptor = nullptr;  // once it is loaded
};

/// A candidate that cannot be used, and one sentence that says why and what to do.
struct Refusal {
    std::filesystem::path file;
    std::string reason;
};

/// `first`, then CANDELA_PLUGIN_PATH, the user's data directory, and lib/candela/plugins beside the core.
CANDELA_API std::vector<std::filesystem::path> plugin_search_path(
    std::span<const std::filesystem::path> first);

/// Loads a library and checks it against `manifest` (null: only the fingerprint), the handshake before
/// anything else of it is called. Throws Error with a plain sentence. The library stays loaded until the
/// process ends. Any thread.
CANDELA_API const PluginDescriptor& load_plugin(const std::filesystem::path& library,
                                                const Manifest* manifest);

template <class Interface>
inline constexpr PluginKind k_kind_of = [] {
    static_assert(sizeof(Interface) == 0, "not the interface of a plugin kind");
    return PluginKind::light;
}();
template <>
inline constexpr PluginKind k_kind_of<Light> = PluginKind::light;
template <>
inline constexpr PluginKind k_kind_of<ReflectionModel> = PluginKind::reflection;
template <>
inline constexpr PluginKind k_kind_of<ShadingModel> = PluginKind::shading;
template <>
inline constexpr PluginKind k_kind_of<Shape> = PluginKind::shape;
template <>
inline constexpr PluginKind k_kind_of<ImageFormat> = PluginKind::image;

/// Whose plugins are used. A plugin is code that runs with all the rights of who renders.
enum class PluginTrust : int {
    own_and_system,  // of this user and of root, in folders and files that nobody else can write to
    any,
};

/// What a picture's file is to be done with.
enum class FormatUse : bool { write, read };

/// The plugins of a search path. Reads a manifest when it is asked for, loads a library when an instance is
/// wanted. Any thread; returned pointers live as long as the registry.
class CANDELA_API Registry {
  public:
    explicit Registry(std::vector<std::filesystem::path> search_path,
                      PluginTrust trust = PluginTrust::own_and_system);

    const std::vector<std::filesystem::path>& search_path() const noexcept { return search_path_; }
    PluginTrust trust() const noexcept { return trust_; }

    /// The first usable plugin of that name on the search path, or null.
    const PluginFile* find(PluginKind kind, std::string_view name);
    /// Likewise; throws Error where there is none: what is not known, why a candidate was refused, and a
    /// suggestion.
    const PluginFile& require(PluginKind kind, std::string_view name);

    /// All usable plugins, by kind and name.
    std::vector<const PluginFile*> list();
    /// All usable plugins of a kind, by name; reads no other kind's manifests.
    std::vector<const PluginFile*> list(PluginKind kind);
    std::vector<std::string> names(PluginKind kind);
    /// The candidates that list() and find() have passed over.
    std::vector<Refusal> refusals() const;

    /// The image plugin that writes, or reads, `.extension`, or null. One with the property "fallback" yields
    /// to one without.
    const PluginFile* find_format(std::string_view extension, FormatUse use = FormatUse::write);
    /// All extensions that an image plugin writes, or reads, sorted.
    std::vector<std::string> extensions(FormatUse use = FormatUse::write);

    /// An empty set of a plugin's parameters: its defaults. Throws Error as require() does.
    ParamSet parameters(PluginKind kind, std::string_view name);

    /// Loads the plugin if need be and makes an instance. Throws Error, also for what the plugin throws.
    template <class Interface>
    std::unique_ptr<Interface> create(std::string_view name, const ParamSet& values, ColorEncoding encoding) {
        std::unique_ptr<Instance> made = create_instance(k_kind_of<Interface>, name, values, encoding);
        auto* const typed = dynamic_cast<Interface*>(made.get());
        if (typed == nullptr) throw_wrong_interface(k_kind_of<Interface>, name);
        static_cast<void>(made.release());
        return std::unique_ptr<Interface>(typed);
    }

  private:
    std::unique_ptr<Instance> create_instance(PluginKind kind, std::string_view name, const ParamSet& values,
                                              ColorEncoding encoding);
    [[noreturn]] static void throw_wrong_interface(PluginKind kind, std::string_view name);
    const PluginFile* look_at(const std::filesystem::path& directory, const std::string& id, PluginKind kind,
                              std::string_view name);
    void scan(PluginKind kind);
    const PluginDescriptor& load(const PluginFile& file);

    std::vector<std::filesystem::path> search_path_;
    PluginTrust trust_;
    mutable std::recursive_mutex mutex_;
    std::set<PluginKind> scanned_;
    std::map<std::string, std::unique_ptr<PluginFile>, std::less<>>
        found_;  // by id; null: looked for in vain
    std::map<std::filesystem::path, std::string> refused_;
};

/// A plugin's exception as an Error that names the plugin; to be called in a catch block.
[[noreturn]] CANDELA_API void rethrow_as_plugin_error(PluginKind kind, std::string_view name);

}  // namespace candela
