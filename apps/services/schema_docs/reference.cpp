// The scene file as a page in Markdown.
module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.schema;

import candela.api;
import candela.plugins;
import candela.scene;

namespace candela {

namespace {

constexpr std::string_view k_introduction = R"(# Scene reference

Every table and key of the scene file, and everything that the installed plugins add to it. To learn by example, start with
[scene-file.md](scene-file.md); for the equations and their sources, see [equations.md](equations.md).

This page is made by `candela schema --format markdown`, from the declarations that scenes are validated against. Do not edit it.

## How to read it

| a value is | write | notes |
|---|---|---|
| a number | `2.5`, `2` | an integer is accepted |
| an integer | `2` | `2.0` is an error |
| a string, a path | `"lamp"` | a path is relative to the file that names it, and the file must exist |
| one of the listed words | `"none"` | exactly as listed |
| three numbers | `[0.0, 1.5, -2.0]` | x, y, z: right-handed, y is up |
| a direction | `[0.0, -1.0, 0.0]` | any length but zero; it need not be a unit vector |
| a colour | `[255, 200, 0]` | red, green, blue, 0 to 255, sRGB-encoded; 256 counts as 255, with a warning |
| a number, or three | `0.7`, `[0.7, 0.5, 0.2]` | one for all, or three: red, green and blue of a material, x, y and z of a scale |

A number or a colour of a reflection model may be [a texture](#a-texture) instead: it is then different at each point.
A key without a default is required. In formulas, N is the surface's normal, L points to the light and V to the observer (unit
vectors all), R is L mirrored at N, C_o is the object's colour, I_L the light that arrives at the point, and A.B the dot product.
*Declared* properties are used for listing and testing.
)";

struct Section {
    PluginKind kind;
    std::string_view heading;
    std::string_view text;
};

constexpr Section k_sections[] = {
    {PluginKind::light, "Lights", "The `type` of a `[[light]]`."},
    {PluginKind::shape, "Shapes", "The `type` of an `[[object]]`."},
    {PluginKind::shading, "Shading models",
     "The normals a surface is lit with, and where shading is evaluated."},
    {PluginKind::reflection, "Reflection models", "How a surface reflects light."},
    {PluginKind::image, "Picture formats",
     "Selected by the picture's file extension: `candela render -o picture.exr`."},
    {PluginKind::target, "Targets",
     "The kinds of programs and files that `candela generate --target NAME` makes of a scene."},
};

/// Escapes a text for a table cell.
std::string cell(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '|') result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string capitalized(std::string_view text) {
    std::string result(text);
    if (!result.empty() && result[0] >= 'a' && result[0] <= 'z')
        result[0] = static_cast<char>(result[0] - 'a' + 'A');
    return result;
}

/// Headings look like "light/point", and GitHub's anchors leave out the slash.
std::string link_to(const Manifest& m) {
    return fmt::format("[`{}`](#{}{})", m.name, name_of(m.kind), m.name);
}

class ReferenceWriter {
  public:
    explicit ReferenceWriter(std::span<const Manifest> installed) : installed_(with_notations(installed)) {}

    std::string write() {
        text_ = k_introduction;
        text_ += "\n## The file\n";
        table(top_schema());
        for (const TableSchema& schema : scene_schema()) table(schema);
        table(material_schema());
        table(texture_schema());
        table(vertex_attribute_schema());
        for (const Section& section : k_sections) {
            line("\n## {}\n\n{}", section.heading, section.text);
            if (section.kind == PluginKind::image) {
                formats();
            } else if (section.kind == PluginKind::target) {
                targets();
            } else {
                for (const Manifest* m : all(section.kind)) plugin(*m);
            }
        }
        return std::move(text_);
    }

  private:
    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        text_ += '\n';
    }

    std::vector<const Manifest*> all(PluginKind kind) const {
        std::vector<const Manifest*> found;
        for (const Manifest& m : installed_) {
            if (m.kind == kind) found.push_back(&m);
        }
        return found;
    }

    void table(const TableSchema& schema) {
        const bool is_top = schema.name.empty();
        line("\n### {}\n\n{}.\n", is_top ? capitalized(schema.title) : code(schema.title),
             capitalized(schema.meaning));
        begin_keys();
        for (const Parameter& p : schema.parameters) key(p, value_text(schema, p));
        for (const PluginKey& plugin_key : schema.plugins) {
            if (plugin_key.parameters_in.value_or("").empty()) continue;
            line("| `{}` | a table | | | parameters of the object's [{} model](#{}-models) |",
                 *plugin_key.parameters_in, name_of(plugin_key.kind), name_of(plugin_key.kind));
        }
        for (const TableSchema& inner : schema.tables) table(inner);
    }

    void begin_keys() { line("| key | value | unit | default | meaning |\n|---|---|---|---|---|"); }

    void key(const Parameter& p, const std::string& value) {
        const auto default_value = default_text(p);
        const std::string shown = default_value     ? code(*default_value)
                                  : p.default_value ? ""
                                                    : "**required**";
        line("| `{}` | {} | {} | {} | {} |", p.name, cell(value), unit_word(p), cell(shown), cell(p.meaning));
    }

    /// The possible values of one of the scene's own keys.
    std::string value_text(const TableSchema& schema, const Parameter& p) const {
        if (std::ranges::find(schema.lists, p.name) != schema.lists.end())
            return "a list, each " + constraint_text(p);
        if (std::ranges::find(schema.timed, p.name) != schema.timed.end()) return "a list of `[time, value]`";
        for (const PluginKey& plugin_key : schema.plugins) {
            if (plugin_key.key != p.name) continue;
            std::vector<std::string> links;
            for (const Manifest* m : all(plugin_key.kind)) links.push_back(link_to(*m));
            return links.empty() ? "none is installed" : fmt::format("one of {}", fmt::join(links, ", "));
        }
        return p.choices.size() == 1 ? code(p.choices.front()) : constraint_text(p);
    }

    void plugin(const Manifest& m) {
        line("\n### {}\n\n**{}.** {}", m.id(), m.title, m.summary);
        if (!m.formula.empty()) line("\n```text\n{}\n```", m.formula);
        if (!m.parameters.empty()) {
            line("");
            begin_keys();
            for (const Parameter& p : m.parameters) key(p, constraint_text(p));
        }
        if (!m.relations.empty()) line("");
        for (const Relation& r : m.relations) line("- {}.", text_of(r));
        sample(m);
        if (!m.properties.empty()) line("\nDeclared: {}.", fmt::join(properties_of(m), ", "));
        if (!m.reference.empty()) line("\nReference: {}.", m.reference);
    }

    static std::vector<std::string> properties_of(const Manifest& m) {
        std::vector<std::string> result;
        for (const auto& [name, value] : m.properties) {
            result.push_back(value == "true" ? code(name) : fmt::format("{}: {}", code(name), value));
        }
        return result;
    }

    /// An example of naming a plugin in a scene, with all its parameters at their defaults.
    void sample(const Manifest& m) {
        for (const TableSchema& schema : scene_schema()) {
            for (const PluginKey& plugin_key : schema.plugins) {
                if (plugin_key.kind == m.kind && plugin_key.parameters_in)
                    return sample(m, schema, plugin_key);
            }
        }
    }

    void sample(const Manifest& m, const TableSchema& schema, const PluginKey& naming) {
        std::vector<std::pair<std::string, std::string>> head, parameters;
        for (const PluginKey& other : schema.plugins) {
            if (other.key == naming.key) {
                head.emplace_back(other.key, fmt::format("\"{}\"", m.name));
            } else if (!schema_parameter(schema, other.key).default_value) {
                const auto plain = plain_plugin(other.kind);
                if (!plain) return;
                head.emplace_back(other.key, fmt::format("\"{}\"", *plain));
            }
        }
        for (const Parameter& p : m.parameters) parameters.emplace_back(p.name, sample_value(p));
        line("\n```toml\n{}", schema.title);
        if (naming.parameters_in->empty()) {
            head.insert(head.end(), parameters.begin(), parameters.end());
            assignments(head);
        } else {
            assignments(head);
            if (!parameters.empty()) line("\n[{}.{}]", schema.name, *naming.parameters_in);
            assignments(parameters);
        }
        line("```");
    }

    void assignments(const std::vector<std::pair<std::string, std::string>>& all_of_them) {
        std::size_t width = 0;
        for (const auto& [name, value] : all_of_them) width = std::max(width, name.size());
        for (const auto& [name, value] : all_of_them) line("{:<{}} = {}", name, width, value);
    }

    static const Parameter& schema_parameter(const TableSchema& schema, const std::string& name) {
        return *std::ranges::find(schema.parameters, name, &Parameter::name);
    }

    /// A plugin that needs no parameters.
    std::optional<std::string> plain_plugin(PluginKind kind) const {
        for (const Manifest* m : all(kind)) {
            if (std::ranges::all_of(m->parameters,
                                    [](const Parameter& p) { return p.default_value.has_value(); }))
                return m->name;
        }
        return std::nullopt;
    }

    /// The default, or an allowed value.
    static std::string sample_value(const Parameter& p) {
        if (auto text = default_text(p)) return *text;
        switch (p.type) {
            case ParamType::boolean:
                return "true";
            case ParamType::choice:
                return fmt::format("\"{}\"", p.choices.front());
            case ParamType::text:
                return "\"text\"";
            case ParamType::file:
                return "\"path/to/file\"";
            case ParamType::color:
                return "[255, 255, 255]";
            case ParamType::point:
                return "[0, 2, 0]";
            case ParamType::direction:
                return "[0, -1, -1]";
            case ParamType::vector:
                return fmt::format("[{0}, {0}, {0}]", sample_number(p));
            case ParamType::matrix:
                return fmt::format("[[{0}, {0}, {0}], [{0}, {0}, {0}], [{0}, {0}, {0}]]", sample_number(p));
            case ParamType::numbers:
                return fmt::format("[{}]", sample_number(p));
            case ParamType::integer:
            case ParamType::real:
            case ParamType::rgb:
                break;
        }
        return p.choices.empty() ? sample_number(p) : p.choices.front();
    }

    static std::string sample_number(const Parameter& p) {
        const bool has_minimum = p.minimum != k_no_minimum;
        const bool has_maximum = p.maximum != k_no_maximum;
        if (has_minimum && !p.minimum_excluded) return fmt::format("{}", p.minimum);
        if (has_maximum && !p.maximum_excluded) return fmt::format("{}", p.maximum);
        if (has_minimum && has_maximum) return fmt::format("{}", (p.minimum + p.maximum) / 2);
        if (has_minimum) return fmt::format("{}", p.minimum + 1);
        return fmt::format("{}", has_maximum ? p.maximum - 1 : 0.0f);
    }

    void targets() {
        line("");
        for (const Manifest* m : all(PluginKind::target)) line("- `{}`: {}", m->id(), m->summary);
    }

    void formats() {
        std::vector<std::pair<const ManifestFormat*, const Manifest*>> rows;
        for (const Manifest* m : all(PluginKind::image)) {
            for (const ManifestFormat& f : m->formats) rows.emplace_back(&f, m);
        }
        std::ranges::sort(rows, {}, [](const auto& row) {
            return std::pair(std::string_view(row.first->extension), std::string_view(row.second->name));
        });
        line("\n| extension | format | holds | plugin |\n|---|---|---|---|");
        for (const auto& [format, m] : rows) {
            line("| `.{}` | {} | {} | `{}`{} |", format->extension, cell(format->title),
                 format->pixels == PixelType::byte ? "8 bits per channel"
                                                   : "the computed intensities, as floats",
                 m->id(), m->property("fallback") ? ", fallback" : "");
        }
        line("\nIf several plugins write an extension, a dedicated one is preferred to a fallback.\n");
        for (const Manifest* m : all(PluginKind::image)) line("- `{}`: {}", m->id(), m->summary);
        for (const Manifest* m : all(PluginKind::image)) {
            if (m->parameters.empty()) continue;
            line("\nParameters of `{}`, such as `--format-set {}={}`:\n", m->id(), m->parameters.front().name,
                 sample_value(m->parameters.front()));
            begin_keys();
            for (const Parameter& p : m->parameters) key(p, constraint_text(p));
        }
    }

    std::vector<Manifest> installed_;
    std::string text_;
};

}  // namespace

std::string scene_reference(std::span<const Manifest> installed) {
    return ReferenceWriter(installed).write();
}

}  // namespace candela
