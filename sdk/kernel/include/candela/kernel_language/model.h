// A model as its kernel file declares it: the file's documentation comments (///) say what a plugin's
// descriptor holds. docs/plugins/adding-a-model.md has the syntax.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/kernel_language/syntax.h"

import candela.api;

namespace candela::kernel_language {

/// A member of the struct of parameters, with the comment behind it.
struct ParameterDeclaration {
    std::string name{};
    ParamType type = ParamType::real;
    std::string unit{};
    std::string meaning{};
    bool is_required = false;
    std::vector<float> numbers{};  // the default, as written in a scene
    float minimum = k_no_minimum;
    float maximum = k_no_maximum;
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::vector<std::string> choices{};
    TextPosition place{}, default_place{}, range_place{};
};

struct RelationDeclaration {
    RelationType type = RelationType::less_or_equal;
    std::string left{}, right{};
    bool only_warns = false;
    std::string meaning{};
    TextPosition place{};
};

struct PropertyDeclaration {
    std::string name{}, value = "true";
    TextPosition place{};
};

struct PresetDeclaration {
    std::string name{}, source{};
    std::vector<std::pair<std::string, std::vector<float>>> values{};
    std::optional<std::vector<float>> color{};
    TextPosition place{};
};

/// The members of the renderer's structs, by their names in prelude.kernel, that a model's kernel reads.
struct KernelReads {
    std::set<std::string> surface{}, receiver{}, shading_point{};
};

struct ModelDeclaration {
    PluginKind kind = PluginKind::reflection;
    std::string name{};       // "half-lambert"
    std::string prefix{};     // "half_lambert": its functions are <prefix>_reflect …
    std::string structure{};  // of its parameters; empty if it has none
    std::string title{}, summary{};
    std::vector<std::string> description{};  // paragraphs
    std::vector<std::string> formula{};      // TeX, one equation each
    std::string reference{};
    std::vector<ParameterDeclaration> parameters{};
    std::vector<RelationDeclaration> relations{};
    std::vector<PropertyDeclaration> properties{};
    std::string preset_set{};  // "classic", "metals" or empty
    TextPosition preset_set_place{};
    std::vector<PresetDeclaration> presets{};
    std::string rate{};  // of a shading model: "face", "vertex" or "fragment"
    TextPosition rate_place{};
    std::set<std::string> functions{};  // "reflect", "reflect_ambient", "prepare" …
    std::string constants{};            // the type that prepare returns, if the kernel has it
    bool takes_triangle = false;
    KernelReads reads{};
};

/// The name of a file's model: its stem. Throws std::invalid_argument if that is not a plugin's name.
std::string model_name(const std::filesystem::path& file);

/// The model that a checked kernel declares. Throws Problem at the comment that cannot be understood.
ModelDeclaration read_model(const Kernel& kernel, std::string_view name);

/// A part of an equation that is not understood: `offset` is that of the byte in its TeX.
class EquationProblem : public std::runtime_error {
  public:
    EquationProblem(std::size_t offset, const std::string& message)
        : std::runtime_error(message), offset_(offset) {}
    std::size_t offset() const { return offset_; }

  private:
    std::size_t offset_;
};

/// An equation in TeX as plain text: "\frac{a}{b + c}" becomes "a / (b + c)", "N \cdot L" becomes "N.L".
/// Throws EquationProblem.
std::string plain_text(std::string_view tex);

/// The C++ of a plugin for the model, which includes `kernel_file`.
std::string plugin_source(const ModelDeclaration& model, std::string_view kernel_file);

}  // namespace candela::kernel_language
