// The C++ of a model's plugin.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/kernel_language/model.h"

import candela.api;
import candela.util;

namespace candela::kernel_language {

namespace {

/// A text as a C++ string literal.
std::string literal(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\' || c == '?') result += '\\';
        if (c == '\n') {
            result += "\\n";
        } else if (static_cast<unsigned char>(c) < 0x20) {
            result += ' ';
        } else {
            result += c;
        }
    }
    return result + '"';
}

std::string number(float value) {
    if (std::isinf(value)) return value < 0 ? "candela::k_no_minimum" : "candela::k_no_maximum";
    return toml_text(value) + "f";  // C++ writes reals as TOML does
}

std::string numbers(const std::vector<float>& values) {
    std::vector<std::string> texts;
    for (const float value : values) texts.push_back(number(value));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string literals(const std::vector<std::string>& texts) {
    std::vector<std::string> quoted;
    for (const std::string& text : texts) quoted.push_back(literal(text));
    return fmt::format("{}", fmt::join(quoted, ", "));
}

const ParameterDeclaration* parameter_of(const ModelDeclaration& model, std::string_view name) {
    for (const ParameterDeclaration& parameter : model.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

/// The ParamValue of numbers as written in a scene.
std::string value(const ParameterDeclaration* parameter, const std::vector<float>& given) {
    if (parameter != nullptr &&
        (parameter->type == ParamType::integer || parameter->type == ParamType::boolean))
        return fmt::format("{{.integer = {}}}", std::llround(given.empty() ? 0.0f : given.front()));
    return fmt::format("{{.number = {{{}}}}}", numbers(given));
}

std::string_view member_of(ParamType type) {
    switch (type) {
        case ParamType::real:
            return "real";
        case ParamType::integer:
        case ParamType::boolean:
        case ParamType::choice:
            return "integer";
        case ParamType::matrix:
            return "matrix";
        case ParamType::numbers:
            return "table";
        default:
            return "vector";
    }
}

class SourceWriter {
  public:
    SourceWriter(const ModelDeclaration& model, std::string_view kernel_file)
        : model_(model),
          parameters_(model.structure.empty() ? "candela::sdk::NoParams"
                                              : "candela::kernel::" + model.structure),
          constants_(model.constants.empty() ? parameters_ : "candela::kernel::" + model.constants) {
        text_ = fmt::format(
            "// Generated from a kernel file.\n#include \"candela/{}_plugin.h\"\n#include "
            "\"candela/material_presets.h\"\n\n"
            "namespace candela::kernel {{\n#include {}\n{}}}\n\nnamespace {{\n\nusing namespace "
            "candela::sdk;\nusing Parameters = {};\n\n",
            model.functions.contains("enter") ? "refraction" : name_of(model.kind), literal(kernel_file),
            data_of_light(), parameters_);
    }

    std::string all() {
        write_fields();
        write_relations();
        write_properties();
        write_presets();
        text_ += fmt::format(
            "}}  // namespace\n\nCANDELA_KERNEL_PLUGIN(\n    {}, ({}), {}, {}, k_fields,\n    {{.title = "
            "{},\n     "
            ".summary = {},\n     .formula = {},\n     .reference = {}",
            name_of(model_.kind), model_class(), model_.prefix, parameters_, literal(model_.title),
            literal(model_.summary), literal(formula()), literal(model_.reference));
        if (!model_.relations.empty()) text_ += ",\n     .relations = k_relations";
        if (!model_.properties.empty()) text_ += ",\n     .properties = k_properties";
        if (!model_.preset_set.empty())
            text_ += fmt::format(",\n     .presets = k_{}_presets",
                                 model_.preset_set == "metals" ? "metal" : model_.preset_set);
        if (!model_.presets.empty()) text_ += ",\n     .presets = k_presets";
        return std::move(text_) + "})\n";
    }

  private:
    std::string formula() const {
        std::vector<std::string> lines;
        for (const std::string& equation : model_.formula) lines.push_back(plain_text(equation));
        return fmt::format("{}", fmt::join(lines, "\n"));
    }

    std::string function(std::string_view name) const {
        return fmt::format("&candela::kernel::{}_{}", model_.prefix, name);
    }

    bool has(const char* name) const { return model_.functions.contains(name); }

    /// Functions that give a light as data. A light that reads nothing of the receiver is the same
    /// everywhere.
    std::string data_of_light() const {
        if (model_.kind != PluginKind::light) return "";
        const bool reads_receiver = !model_.reads.receiver.empty();
        const std::string type = constants_.substr(constants_.rfind(':') + 1);
        if (has("punctual")) {
            const char* const arguments = has("sample_count") ? "light, index" : "light";
            const std::string light =
                fmt::format("sdk::punctual_light({}_punctual({}))", model_.prefix, arguments);
            return fmt::format(
                "\nPunctualLight punctual(const {}& light, [[maybe_unused]] int index) {{\n    return "
                "{};\n}}\n",
                type,
                has("extent")
                    ? fmt::format("sdk::with_extent({}, {}_extent({}))", light, model_.prefix, arguments)
                    : light);
        }
        if (reads_receiver || model_.structure.empty()) return "";
        if (has("illuminate_ambient"))
            return fmt::format(
                "\nvec3 uniform_ambient(const {}& light) {{\n    return {}_illuminate_ambient(light, "
                "Receiver());\n}}\n",
                type, model_.prefix);
        return fmt::format(
            "\nPunctualLight punctual(const {}& light, [[maybe_unused]] int index) {{\n    return "
            "sdk::distant_light({}_illuminate(light, Receiver(){}));\n}}\n",
            type, model_.prefix, has("sample_count") ? ", index" : "");
    }

    void write_fields() {
        if (model_.structure.empty()) {
            text_ += "constexpr auto k_fields = k_no_fields;\n\n";
            return;
        }
        for (const ParameterDeclaration& p : model_.parameters) {
            if (!p.choices.empty())
                text_ += fmt::format("constexpr const char* k_{}_choices[] = {{{}}};\n", p.name,
                                     literals(p.choices));
            if (p.type == ParamType::numbers && !p.numbers.empty())
                text_ +=
                    fmt::format("constexpr float k_{}_numbers[] = {{{}}};\n", p.name, numbers(p.numbers));
        }
        text_ += fmt::format("constexpr std::array<Field<Parameters>, {}> k_fields{{{{\n",
                             model_.parameters.size());
        for (const ParameterDeclaration& p : model_.parameters) write_field(p);
        text_ += "}};\n\n";
    }

    void write_field(const ParameterDeclaration& p) {
        text_ += fmt::format(
            "    {{.spec = {{.name = {}, .type = candela::ParamType::{}, .unit = {}, .meaning = {}",
            literal(p.name), name_of(p.type), literal(p.unit), literal(p.meaning));
        if (p.is_required) text_ += ", .required = true";
        if (p.type == ParamType::numbers && !p.numbers.empty())
            text_ += fmt::format(", .default_value = {{.list = k_{}_numbers}}", p.name);
        else if (!p.numbers.empty())
            text_ += fmt::format(", .default_value = {}", value(&p, p.numbers));
        text_ += fmt::format(", .minimum = {}, .maximum = {}", number(p.minimum), number(p.maximum));
        if (p.minimum_excluded) text_ += ", .minimum_excluded = true";
        if (p.maximum_excluded) text_ += ", .maximum_excluded = true";
        if (!p.choices.empty()) text_ += fmt::format(", .choices = k_{}_choices", p.name);
        text_ += fmt::format("}},\n     .{} = &Parameters::{}}},\n", member_of(p.type), p.name);
    }

    void write_relations() {
        if (model_.relations.empty()) return;
        constexpr const char* k_types[] = {"less", "less_or_equal", "sum_at_most_one"};
        text_ += "constexpr candela::RelationSpec k_relations[] = {\n";
        for (const RelationDeclaration& relation : model_.relations)
            text_ += fmt::format("    {{candela::RelationType::{}, {}, {}, {}, {}}},\n",
                                 k_types[static_cast<int>(relation.type)], literal(relation.left),
                                 literal(relation.right), relation.only_warns, literal(relation.meaning));
        text_ += "};\n\n";
    }

    void write_properties() {
        if (model_.properties.empty()) return;
        text_ += "constexpr candela::Property k_properties[] = {\n";
        for (const PropertyDeclaration& property : model_.properties)
            text_ += fmt::format("    {{{}, {}}},\n", literal(property.name), literal(property.value));
        text_ += "};\n\n";
    }

    void write_presets() {
        if (model_.presets.empty()) return;
        for (std::size_t i = 0; i < model_.presets.size(); ++i) {
            text_ += fmt::format("constexpr candela::PresetValue k_preset_{}[] = {{\n", i);
            for (const auto& [name, given] : model_.presets[i].values)
                text_ += fmt::format("    {{.parameter = {}, .value = {}}},\n", literal(name),
                                     value(parameter_of(model_, name), given));
            text_ += "};\n";
        }
        text_ += "constexpr candela::PresetSpec k_presets[] = {\n";
        for (std::size_t i = 0; i < model_.presets.size(); ++i) {
            const PresetDeclaration& preset = model_.presets[i];
            text_ += fmt::format("    {{.name = {}, .source = {}, .values = k_preset_{}",
                                 literal(preset.name), literal(preset.source), i);
            if (preset.color)
                text_ += fmt::format(", .has_color = true, .color = {{{}}}", numbers(*preset.color));
            text_ += "},\n";
        }
        text_ += "};\n\n";
    }

    /// The class of the model's instances: a template of the SDK.
    std::string model_class() const {
        switch (model_.kind) {
            case PluginKind::light:
                return light_class();
            case PluginKind::shading:
                return shading_class();
            default:
                return reflection_class();
        }
    }

    std::string light_class() const {
        if (!has("seen")) return unseen_light_class();
        return fmt::format("VisibleLight<{}, {}, {}>", unseen_light_class(), constants_, function("seen"));
    }

    std::string unseen_light_class() const {
        if (has("illuminate_ambient"))
            return fmt::format("KernelAmbientLight<{}, {}>", constants_, function("illuminate_ambient"));
        const std::string distance = has("distance") ? ", " + function("distance") : "";
        if (has("sample_count"))
            return fmt::format("KernelSampledLight<{}, {}, {}{}>", constants_, function("illuminate"),
                               function("sample_count"), distance);
        return fmt::format("KernelLight<{}, {}{}>", constants_, function("illuminate"), distance);
    }

    std::string reflection_class() const {
        std::vector<std::string> reads;
        for (const char* const member : {"tangent", "position", "uv"})
            if (model_.reads.surface.contains(member)) reads.push_back(fmt::format("reads_{}", member));
        if (reads.empty()) reads.emplace_back("reads_no_more");
        std::string functions = function("reflect") + ", " + function("reflect_ambient");
        const bool refracts = has("enter");
        if (refracts)
            functions += ", " + function("enter") + ", " + function("leave") + ", " + function("transmit");
        const bool is_glossy = has("highlight_width");
        if (is_glossy) functions += ", " + function("highlight_width");
        const char* const of = refracts    ? "KernelRefraction"
                               : is_glossy ? "KernelGlossyReflection"
                                           : "KernelReflection";
        return fmt::format("{}<{}, {}, {}>", of, constants_, functions, fmt::join(reads, " | "));
    }

    std::string shading_class() const {
        const auto reads = [&](const char* member) { return model_.reads.shading_point.contains(member); };
        const std::string needs = fmt::format(
            "candela::ShadingNeeds{{.face_normal = {}, .vertex_normal = {}, .barycentric = {}, .uv = {}, "
            ".derivatives = {}}}",
            reads("face_normal"), reads("vertex_normal"), reads("barycentric"), reads("uv"),
            reads("dpdu") || reads("dpdv"));
        const std::string weight = has("corner_weight") ? ", " + function("corner_weight") : "";
        return fmt::format("{}<{}, candela::ShadingRate::{}, {}{}, {}>",
                           weight.empty() ? "KernelShading" : "WeightedShading", constants_, model_.rate,
                           function("normal"), weight, needs);
    }

    const ModelDeclaration& model_;
    std::string parameters_, constants_;
    std::string text_;
};

}  // namespace

std::string plugin_source(const ModelDeclaration& model, std::string_view kernel_file) {
    return SourceWriter(model, kernel_file).all();
}

}  // namespace candela::kernel_language
