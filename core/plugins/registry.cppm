module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
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

export module candela.plugins:registry;

export import :manifest;
import candela.api;
import candela.util;

export namespace candela {

/// An installed plugin.
struct PluginFile {
    Manifest manifest;
    std::filesystem::path library;
    SharedSchema schema;                                   // the manifest's parameters
    mutable const PluginDescriptor* descriptor = nullptr;  // once the registry has loaded it
};

/// A candidate that cannot be used, and one sentence with the reason and a remedy.
struct Refusal {
    std::filesystem::path file;
    std::string reason;
    Help help{};
    std::filesystem::path used_instead{};  // the next plugin of that name on the search path, if it was used
};

/// A kernel file that is not a model, and where: `place` in `source`, its text.
class CANDELA_EXPORT KernelError : public Error {
  public:
    /// `hint`: a remedy; may be empty.
    KernelError(SourceLocation place, const std::string& message, const std::string& hint,
                std::string source);
    ~KernelError() override;
    /// Adds it as an error at its place, with the source's text.
    void report_in(Diagnostics& diagnostics) const;

  private:
    SourceLocation place_;
    std::string message_, hint_, source_;
};

/// A plugin that was made of a kernel file: <kind>-<name>.so and its manifest in `folder`.
struct CompiledKernel {
    PluginKind kind = PluginKind::reflection;
    std::string name;
    std::filesystem::path folder;
};

/// Makes a plugin of a kernel file. Throws KernelError and Error. Any thread.
using KernelCompiler = std::function<CompiledKernel(const std::filesystem::path& file)>;

/// Whether a plugin, and its project or its kernel file, can have this name: lower-case letters, digits and
/// single hyphens, starting with a letter.
CANDELA_EXPORT bool is_plugin_name(std::string_view name);

/// Whether the name of a model is that of a kernel file.
constexpr bool is_kernel_file(std::string_view name) { return name.ends_with(".kernel"); }

/// Whether kernel files may stand for plugins of this kind.
constexpr bool has_kernels(PluginKind kind) {
    return kind == PluginKind::light || kind == PluginKind::reflection || kind == PluginKind::shading;
}

/// The name of a model as a scene keeps it: the path of a kernel file becomes absolute.
CANDELA_EXPORT std::string absolute_model_name(const std::filesystem::path& name);

/// A model's name as people know it: a kernel file by its path, relative to the working directory if it is in
/// there; other names unchanged.
CANDELA_EXPORT std::string shown_model_name(std::string_view name);

/// How people call the plugin that has this name in a registry: "reflection/phong", or shown_model_name() of
/// a kernel file.
CANDELA_EXPORT std::string plugin_id(PluginKind kind, std::string_view name);

/// For messages on unknown names: "; the name of a kernel file ends with .kernel" if this looks like that of
/// a file, otherwise empty.
CANDELA_EXPORT std::string kernel_file_hint(std::string_view name);

/// `first`, then CANDELA_PLUGIN_PATH, the user's data directory, and lib/candela/plugins next to the core.
CANDELA_EXPORT std::vector<std::filesystem::path> plugin_search_path(
    std::span<const std::filesystem::path> first);

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
template <>
inline constexpr PluginKind k_kind_of<Target> = PluginKind::target;

/// Whose plugins may be used. A plugin is code that runs with all the rights of the user.
enum class PluginTrust : int {
    own_and_system,  // owned by this user or root, in files and folders that nobody else can write to
    any,
};

/// How a picture file is used.
enum class FormatUse : bool { write, read };

/// Called when a plugin is used instead of one that was refused, which precedes it on the search path. Must
/// not call the registry.
using ReplacementHandler = std::function<void(const Refusal&)>;

/// The plugins of a search path. Reads a manifest on demand, and loads a library when an instance is created.
/// Any thread; returned pointers are valid as long as the registry exists.
///
/// Which of several plugins of one name is used: the first on the search path whose manifest and library are
/// sound, judged without loading it. If an earlier one was refused, `on_replaced` is called. A refused plugin
/// in the first `named_folders` folders, which the user has named for this purpose, is not replaced: then
/// there is none. Failing to load the chosen library is an error.
///
/// Wherever a light, a reflection or a shading model is named, the path of a kernel file serves as well, if
/// there is a KernelCompiler: the file is compiled when it is first named.
class CANDELA_EXPORT Registry {
  public:
    explicit Registry(std::vector<std::filesystem::path> search_path,
                      PluginTrust trust = PluginTrust::own_and_system, std::size_t named_folders = 0,
                      ReplacementHandler on_replaced = {}, KernelCompiler compile_kernel = {});

    /// The kernel files that have been named.
    std::vector<std::filesystem::path> kernel_files() const;

    const std::vector<std::filesystem::path>& search_path() const noexcept { return search_path_; }
    PluginTrust trust() const noexcept { return trust_; }

    /// The plugin of that name to use, or null. For a kernel file that cannot be used, require() says why.
    const PluginFile* find(PluginKind kind, std::string_view name);
    /// Like find(), but throws Error if there is none: the unknown name, why a candidate was refused, and a
    /// suggestion.
    const PluginFile& require(PluginKind kind, std::string_view name);
    /// The plugin of a kernel file, whatever its kind. Throws Error.
    const PluginFile& require_kernel(const std::string& file);

    /// All usable plugins, by kind and name.
    std::vector<const PluginFile*> list();
    /// All usable plugins of a kind, by name; reads no manifests of other kinds.
    std::vector<const PluginFile*> list(PluginKind kind);
    std::vector<std::string> names(PluginKind kind);
    /// The candidates that list() and find() skipped.
    std::vector<Refusal> refusals() const;

    /// The image plugin that writes, or reads, `.extension`, or null. One with the property "fallback" yields
    /// to one without. Throws Error if the one named after the extension is refused where it may not be
    /// replaced.
    const PluginFile* find_format(std::string_view extension, FormatUse use = FormatUse::write);
    /// All extensions that an image plugin writes, or reads, sorted.
    std::vector<std::string> extensions(FormatUse use = FormatUse::write);

    /// A plugin's parameter set, filled with defaults. Throws Error like require().
    ParamSet parameters(PluginKind kind, std::string_view name);

    /// Loads the plugin if necessary. Throws Error like require(), and if it cannot be loaded.
    const PluginDescriptor& descriptor(PluginKind kind, std::string_view name);

    /// Loads the plugin if necessary and creates an instance. Throws Error, also for exceptions of the
    /// plugin.
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
    std::unique_ptr<PluginFile> look_at(const std::filesystem::path& directory, PluginKind kind,
                                        std::string_view name);
    std::unique_ptr<PluginFile> plugin_of_kernel(const std::filesystem::path& file);
    /// The refused candidates of that name that precede `instead` (null: all), in search order.
    std::vector<Refusal*> refused_before(const PluginFile* instead, PluginKind kind, std::string_view name);
    void report_replaced(const PluginFile& instead, PluginKind kind, std::string_view name);
    void scan(PluginKind kind);
    const PluginDescriptor& load(const PluginFile& file);

    std::vector<std::filesystem::path> search_path_;
    PluginTrust trust_;
    std::size_t named_folders_;
    ReplacementHandler on_replaced_;
    mutable std::recursive_mutex mutex_;
    std::set<PluginKind> scanned_;
    std::map<std::string, std::unique_ptr<PluginFile>, std::less<>> found_;  // by id; null: not found
    KernelCompiler compile_kernel_;
    /// A kernel file's plugin, or why there is none.
    struct KernelEntry {
        std::unique_ptr<PluginFile> plugin;
        std::exception_ptr problem;
    };
    const KernelEntry& kernel_entry(std::string_view file);
    std::map<std::string, KernelEntry, std::less<>> kernels_;
    std::map<std::filesystem::path, Refusal> refused_;
};

}  // namespace candela
