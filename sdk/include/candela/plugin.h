// The base of every plugin: its parameters, mapped to the members of a struct, and its two exported
// functions.
//
// A plugin's source includes the header of its kind (light_plugin.h, reflection_plugin.h, …), which includes
// this one, and ends with that header's macro. CANDELA_PLUGIN_NAME, CANDELA_PLUGIN_VERSION and
// CANDELA_KERNEL_FILE come from candela_add_plugin().
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "candela/color.h"
#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/light.h"
#include "candela/math.h"
#include "candela/plugin/abi.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"
#include "candela/shading_model.h"

namespace candela::sdk {

#ifdef CANDELA_KERNEL_FILE
/// The text of the plugin's .kernel file, which CANDELA_EMBED_KERNEL embeds in the library.
extern const char k_kernel_text[] __asm__("candela_kernel_text") __attribute__((visibility("hidden")));
#else
inline constexpr const char* k_kernel_text = nullptr;
#endif

using kernel::add_product;
using kernel::load;
using kernel::mat3;
using kernel::store;
using kernel::Table;
using kernel::vec2;
using kernel::vec3;

CANDELA_KERNEL_INLINE vec3 kernel_vector(Vec3 v) { return vec3(v.x, v.y, v.z); }
CANDELA_KERNEL_INLINE vec3 kernel_vector(Rgb c) { return vec3(c.r, c.g, c.b); }

/// A parameter and the member of `Params` that receives it.
template <class Params>
struct Field {
    ParamSpec spec;
    float Params::* real = nullptr;
    std::int32_t Params::* integer = nullptr;
    vec3 Params::* vector = nullptr;
    const char* Params::* text = nullptr;
    mat3 Params::* matrix = nullptr;
    Table Params::* table = nullptr;
    std::vector<float> (*read_table)(const char* path) = nullptr;  // of a table that is made from a file

    void store(Params& params, const ParamValue& value) const {
        if (real != nullptr) params.*real = value.number[0];
        if (integer != nullptr) params.*integer = value.integer;
        // Otherwise g++ warns about a member past the end of a struct too small to have one.
        if constexpr (sizeof(Params) >= sizeof(vec3)) {
            if (vector != nullptr) params.*vector = vec3(value.number[0], value.number[1], value.number[2]);
        }
        if constexpr (sizeof(Params) >= sizeof(mat3)) {
            if (matrix != nullptr) {
                const float* const m = value.number;
                params.*matrix = mat3(vec3(m[0], m[3], m[6]), vec3(m[1], m[4], m[7]), vec3(m[2], m[5], m[8]));
            }
        }
        if (text != nullptr) params.*text = value.text;
    }

    /// The numbers of the member, if it is a table. Throws std::exception if the file has none.
    std::vector<float> numbers_of(const ParamValue& value) const {
        if (table == nullptr) return {};
        if (read_table == nullptr) return {value.list.begin(), value.list.end()};
        const bool is_given = value.text != nullptr && *value.text != '\0';
        return is_given ? read_table(value.text) : std::vector<float>();
    }

    const void* member_of(const Params& params) const {
        if (real != nullptr) return &(params.*real);
        if (integer != nullptr) return &(params.*integer);
        if (vector != nullptr) return &(params.*vector);
        if (matrix != nullptr) return &(params.*matrix);
        if (table != nullptr) return &(params.*table);
        return text != nullptr ? static_cast<const void*>(&(params.*text)) : nullptr;
    }

    // The rest of the declaration, after the type of value: real(...).minimum(0).unit("m").

    constexpr Field minimum(float low) const {
        return with([&](ParamSpec& s) { s.minimum = low; });
    }
    constexpr Field maximum(float high) const {
        return with([&](ParamSpec& s) { s.maximum = high; });
    }
    constexpr Field range(float low, float high) const { return minimum(low).maximum(high); }
    constexpr Field above(float low) const {
        return with([&](ParamSpec& s) { s.minimum = low, s.minimum_excluded = true; });
    }
    constexpr Field below(float high) const {
        return with([&](ParamSpec& s) { s.maximum = high, s.maximum_excluded = true; });
    }
    constexpr Field unit(const char* name) const {
        return with([&](ParamSpec& s) { s.unit = name; });
    }
    constexpr Field required() const {
        return with([&](ParamSpec& s) { s.required = true; });
    }
    /// For a file: if it is not set, the text is empty or the table has no numbers.
    constexpr Field optional() const {
        return with([&](ParamSpec& s) { s.required = false; });
    }

  private:
    template <class Change>
    constexpr Field with(Change change) const {
        Field result = *this;
        change(result.spec);
        return result;
    }
};

// Declarations. `meaning` is one sentence; a default is given as written in a scene: degrees, colours 0-255.

template <class P>
constexpr Field<P> real(float P::* member, const char* name, float default_value, const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::real,
                     .meaning = meaning,
                     .default_value = {{default_value}}},
            .real = member};
}
/// In degrees in the scene, in radians for the plugin.
template <class P>
constexpr Field<P> angle(float P::* member, const char* name, float default_value, const char* meaning) {
    return real(member, name, default_value, meaning).unit("deg");
}
template <class P>
constexpr Field<P> integer(std::int32_t P::* member, const char* name, std::int32_t default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::integer,
                     .meaning = meaning,
                     .default_value = {.integer = default_value}},
            .integer = member};
}
/// One of `words`; the member receives its index, and the default is the first.
template <class P>
constexpr Field<P> choice(std::int32_t P::* member, const char* name, std::span<const char* const> words,
                          const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::choice, .meaning = meaning, .choices = words},
            .integer = member};
}
template <class P>
constexpr Field<P> boolean(std::int32_t P::* member, const char* name, bool default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::boolean,
                     .meaning = meaning,
                     .default_value = {.integer = default_value ? 1 : 0}},
            .integer = member};
}
template <class P>
constexpr Field<P> three(vec3 P::* member, ParamType type, const char* name, vec3 default_value,
                         const char* meaning) {
    return {.spec = {.name = name,
                     .type = type,
                     .meaning = meaning,
                     .default_value = {{default_value.x, default_value.y, default_value.z}}},
            .vector = member};
}
template <class P>
constexpr Field<P> color(vec3 P::* member, const char* name, vec3 default_value, const char* meaning) {
    return three(member, ParamType::color, name, default_value, meaning);
}
template <class P>
constexpr Field<P> point(vec3 P::* member, const char* name, const char* meaning) {
    return three(member, ParamType::point, name, vec3(0.0f), meaning).required().unit("m");
}
template <class P>
constexpr Field<P> direction(vec3 P::* member, const char* name, const char* meaning) {
    return three(member, ParamType::direction, name, vec3(0.0f), meaning).required();
}
/// A number, or one per channel, 0 to 1.
template <class P>
constexpr Field<P> coefficient(vec3 P::* member, const char* name, float default_value, const char* meaning) {
    return three(member, ParamType::rgb, name, vec3(default_value), meaning).range(0, 1);
}
template <class P>
constexpr Field<P> file(const char* P::* member, const char* name, const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::file, .meaning = meaning, .required = true},
            .text = member};
}

/// Three rows of three numbers, 'm * v' in the kernel; the default, row by row, is the identity.
template <class P>
constexpr Field<P> matrix(mat3 P::* member, const char* name, const char* meaning,
                          const Matrix& rows = {1, 0, 0, 0, 1, 0, 0, 0, 1}) {
    Field<P> field{.spec = {.name = name, .type = ParamType::matrix, .meaning = meaning}, .matrix = member};
    std::copy(rows.begin(), rows.end(), field.spec.default_value.number);
    return field;
}
/// A list of numbers. `default_value` is an array with the lifetime of the library.
template <class P>
constexpr Field<P> numbers(Table P::* member, const char* name, std::span<const float> default_value,
                           const char* meaning) {
    return {.spec = {.name = name,
                     .type = ParamType::numbers,
                     .meaning = meaning,
                     .default_value = {.list = default_value}},
            .table = member};
}
/// A file; the member receives the table that `read` makes of it, once per instance. `read` may throw
/// std::exception.
template <class P>
constexpr Field<P> file_table(Table P::* member, const char* name,
                              std::vector<float> (*read)(const char* path), const char* meaning) {
    return {.spec = {.name = name, .type = ParamType::file, .meaning = meaning, .required = true},
            .table = member,
            .read_table = read};
}

template <class Params, std::size_t count>
Params params_from(const std::array<Field<Params>, count>& fields, std::span<const ParamValue> values) {
    Params params{};
    for (std::size_t i = 0; i < count; ++i) fields[i].store(params, values[i]);
    return params;
}

template <class Params, std::size_t count>
constexpr bool have_tables(const std::array<Field<Params>, count>& fields) {
    for (const Field<Params>& field : fields) {
        if (field.table != nullptr) return true;
    }
    return false;
}

/// The numbers of an instance's tables, by parameter.
using TableNumbers = std::vector<std::vector<float>>;

/// An instance that owns the numbers that its tables refer to.
template <class Model>
class WithTables final : public Model {
  public:
    template <class Constants>
    WithTables(TableNumbers&& tables, const Constants& constants)
        : Model(constants), tables_(std::move(tables)) {}

    std::span<const float> table(std::size_t parameter) const noexcept override {
        return parameter < tables_.size() ? std::span<const float>(tables_[parameter])
                                          : std::span<const float>();
    }

  private:
    TableNumbers tables_;
};

/// Creates an instance from `prepare(params)`, with `params` filled according to `fields`.
template <class Model, bool has_tables, class Params, std::size_t count, class Prepare>
Instance* created(const std::array<Field<Params>, count>& fields, std::span<const ParamValue> values,
                  Prepare prepare) {
    Params params = params_from(fields, values);
    if constexpr (has_tables) {
        static_assert(!std::is_final_v<Model>,
                      "a class whose parameters have tables is not final: its instances get their numbers");
        TableNumbers tables(count);
        for (std::size_t i = 0; i < count; ++i) {
            tables[i] = fields[i].numbers_of(values[i]);
            if (tables[i].empty()) continue;
            Table table;
            table.numbers = tables[i].data();
            table.count = static_cast<int>(tables[i].size());
            params.*fields[i].table = table;
        }
        return new WithTables<Model>(std::move(tables), prepare(params));
    } else {
        return new Model(prepare(params));
    }
}

/// The description of a plugin, apart from its parameters.
struct About {
    const char* title = "";
    const char* summary = "";
    const char* formula = "";
    const char* reference = "";
    std::span<const RelationSpec> relations{};
    std::span<const Property> properties{};
    std::span<const FileFormat> formats{};
    std::span<const PresetSpec> presets{};
};

/// The `Params` of a plugin without parameters.
struct NoParams {};
inline constexpr std::array<Field<NoParams>, 0> k_no_fields{};

template <class Params, class Result>
constexpr bool takes_first(Result (*)()) {
    return false;
}
template <class Params, class Result, class First, class... Rest>
constexpr bool takes_first(Result (*)(First, Rest...)) {
    return std::is_same_v<First, Params>;
}
/// The kernel function <prefix>_<name>, as a class of kernel functions lists it in `k_kernel_functions`.
template <class Params, auto function>
constexpr KernelFunction kernel_function(const char* name) {
    return {name, takes_first<Params>(function)};
}

/// Whether every member of a kernel's struct is a parameter. (Its members are numbers, and tables with the
/// same alignment, so there is no padding.)
template <class Params, std::size_t count>
constexpr bool fill_all_members(const std::array<Field<Params>, count>& fields) {
    std::size_t size = 0;
    for (const Field<Params>& field : fields) {
        size += field.vector != nullptr   ? sizeof(vec3)
                : field.matrix != nullptr ? sizeof(mat3)
                : field.table != nullptr  ? sizeof(Table)
                                          : sizeof(float);
    }
    return count == 0 ? std::is_empty_v<Params> : size == sizeof(Params);
}

/// The indices of the fields in the order of their members.
template <class Params, std::size_t count>
std::array<std::size_t, count> by_member(const std::array<Field<Params>, count>& fields) {
    const Params params{};
    std::array<const void*, count> addresses{};
    std::array<std::size_t, count> order{};
    for (std::size_t i = 0; i < count; ++i) {
        addresses[i] = fields[i].member_of(params);
        order[i] = i;
    }
    std::ranges::sort(order, std::ranges::less(), [&](std::size_t i) { return addresses[i]; });
    return order;
}

/// The functions of `Model`, preceded by x_prepare if the kernel has it.
template <class Model, bool is_prepared>
std::span<const KernelFunction> kernel_functions() {
    if constexpr (is_prepared) {
        static constexpr auto all = [] {
            std::array<KernelFunction, std::size(Model::k_kernel_functions) + 1> functions{};
            functions[0] = {"prepare", true};
            std::ranges::copy(Model::k_kernel_functions, functions.begin() + 1);
            return functions;
        }();
        return all;
    } else {
        return Model::k_kernel_functions;
    }
}

/// The descriptor's entry for the kernel behind `Model`, which lists its functions in `k_kernel_functions`;
/// `parameters` is the name of `Params`, as its author wrote it.
template <class Model, class Params, bool is_prepared, std::size_t count>
KernelText kernel_text(const char* prefix, const char* parameters,
                       const std::array<Field<Params>, count>& fields) {
    static const std::array<std::size_t, count> members = by_member(fields);
    const std::string_view qualified = parameters;
    const auto colon = qualified.rfind(':');
    const bool takes_none = std::is_same_v<Params, NoParams>;
    return {.text = k_kernel_text,
            .prefix = prefix,
            .parameters = takes_none ? "" : parameters + (colon == qualified.npos ? 0 : colon + 1),
            .functions = kernel_functions<Model, is_prepared>(),
            .members = members};
}

/// The needs of the instances of `Model`: its public static member `k_needs`, if that is a `Needs`; otherwise
/// the default.
template <class Needs, class Model>
constexpr Needs needs_of() {
    if constexpr (requires { requires std::same_as<decltype(Model::k_needs), const Needs>; }) {
        return Model::k_needs;
    } else {
        return {};
    }
}

/// Whether `Model` is a light with an ambient part.
template <class Model>
constexpr bool has_ambient() {
    // A function that is not overridden is a member of the interface; one that cannot be named here is
    // overridden by a private function.
    constexpr bool is_default = requires {
        requires std::same_as<decltype(&Model::illuminate_ambient), decltype(&Light::illuminate_ambient)>;
    };
    return std::is_base_of_v<Light, Model> && !is_default;
}

/// Like needs_of(), for a shading model: whether it has its own vertex normals need not be declared.
template <class Model>
constexpr ShadingNeeds shading_needs() {
    auto needs = needs_of<ShadingNeeds, Model>();
    needs.default_vertex_normals = requires {
        requires std::same_as<decltype(&Model::vertex_normals), decltype(&ShadingModel::vertex_normals)>;
    };
    return needs;
}

template <std::size_t count, class Params>
constexpr std::array<ParamSpec, count> specs_of(const std::array<Field<Params>, count>& fields) {
    std::array<ParamSpec, count> specs{};
    for (std::size_t i = 0; i < count; ++i) specs[i] = fields[i].spec;
    return specs;
}

template <class... Fields>
constexpr auto fields(Fields... all) {
    return std::array<std::common_type_t<Fields...>, sizeof...(Fields)>{all...};
}

/// Calls a kernel function with the parameters first, or without them if it takes none.
template <auto function, class Params, class... Arguments>
CANDELA_KERNEL_INLINE auto call(const Params& params, Arguments... arguments) {
    if constexpr (std::is_invocable_v<decltype(function), Params, Arguments...>) {
        return function(params, arguments...);
    } else {
        return function(arguments...);
    }
}

}  // namespace candela::sdk

/// Exports a plugin of `kind_` whose instances are created by `new Model(params)`, with `params` filled
/// according to `fields_`, an array of candela::sdk::Field. The other arguments initialise a
/// candela::sdk::About.
#define CANDELA_PLUGIN(kind_, Model, fields_, ...) \
    CANDELA_EXPORT_PLUGIN(kind_, Model, fields_, std::identity(), candela::KernelText{}, __VA_ARGS__)

#ifdef CANDELA_KERNEL_FILE
// The assembler reads the file: C++ cannot yet.
#define CANDELA_EMBED_KERNEL                                                             \
    __asm__(".pushsection .rodata\ncandela_kernel_text:\n.incbin \"" CANDELA_KERNEL_FILE \
            "\"\n"                                                                       \
            ".byte 0\n.popsection\n");
#else
#define CANDELA_EMBED_KERNEL
#endif

/// The type of the first argument of a kernel's functions, within CANDELA_KERNEL_PLUGIN: the result of
/// `prefix_prepare(Params_)` if that function exists, otherwise `Params_`.
#define CANDELA_KERNEL_CONSTANTS(prefix_, Params_) \
    decltype(prefix_##_preparation::run(std::declval<const Params_&>()))

/// Like CANDELA_PLUGIN, for a plugin made of kernel functions: their names begin with `prefix_`, and their
/// first argument is `Params_`, or what `prefix_prepare` makes of it. `Model` lists them in a static member
/// `k_kernel_functions`. `prefix_prepare` is found by argument-dependent lookup, as it need not exist.
#define CANDELA_KERNEL_PLUGIN(kind_, Model, prefix_, Params_, fields_, ...)                                  \
    CANDELA_EMBED_KERNEL                                                                                     \
    namespace {                                                                                              \
    struct prefix_##_preparation {                                                                           \
        template <class Params>                                                                              \
        static constexpr bool is_there = requires(const Params& params) { prefix_##_prepare(params); };      \
        template <class Params>                                                                              \
        static auto run(const Params& params) {                                                              \
            if constexpr (is_there<Params>) {                                                                \
                return prefix_##_prepare(params);                                                            \
            } else {                                                                                         \
                return params;                                                                               \
            }                                                                                                \
        }                                                                                                    \
    };                                                                                                       \
    }                                                                                                        \
    static_assert(candela::sdk::fill_all_members<Params_>(fields_),                                          \
                  "each member of a kernel's struct is one of the plugin's parameters");                     \
    CANDELA_EXPORT_PLUGIN(                                                                                   \
        kind_, Model, fields_, prefix_##_preparation::run,                                                   \
        (candela::sdk::kernel_text<                                                                          \
            std::remove_pointer_t<decltype(new Model(prefix_##_preparation::run(std::declval<Params_>())))>, \
            Params_, prefix_##_preparation::is_there<Params_>>(#prefix_, #Params_, fields_)),                \
        __VA_ARGS__)

#define CANDELA_EXPORT_PLUGIN(kind_, Model, fields_, prepare_, kernel_, ...)                              \
    extern "C" CANDELA_EXPORT const char* candela_plugin_abi() { return CANDELA_ABI; }                    \
    extern "C" CANDELA_EXPORT const candela::PluginDescriptor* candela_plugin_descriptor() {              \
        static constexpr auto specs = candela::sdk::specs_of(fields_);                                    \
        static const candela::sdk::About about = __VA_ARGS__;                                             \
        using Made =                                                                                      \
            std::remove_pointer_t<decltype(new Model(prepare_(candela::sdk::params_from(fields_, {}))))>; \
        static const candela::PluginDescriptor descriptor{                                                \
            .kind = candela::PluginKind::kind_,                                                           \
            .name = CANDELA_PLUGIN_NAME,                                                                  \
            .version = CANDELA_PLUGIN_VERSION,                                                            \
            .title = about.title,                                                                         \
            .summary = about.summary,                                                                     \
            .formula = about.formula,                                                                     \
            .reference = about.reference,                                                                 \
            .parameters = specs,                                                                          \
            .relations = about.relations,                                                                 \
            .properties = about.properties,                                                               \
            .presets = about.presets,                                                                     \
            .formats = about.formats,                                                                     \
            .has_ambient = candela::sdk::has_ambient<Made>(),                                             \
            .surface_needs = candela::sdk::needs_of<candela::SurfaceNeeds, Made>(),                       \
            .shading_needs = candela::sdk::shading_needs<Made>(),                                         \
            .kernel = kernel_,                                                                            \
            .create = [](std::span<const candela::ParamValue> values) -> candela::Instance* {             \
                return candela::sdk::created<Made, candela::sdk::have_tables(fields_)>(                   \
                    fields_, values, [](const auto& params) { return prepare_(params); });                \
            }};                                                                                           \
        return &descriptor;                                                                               \
    }
