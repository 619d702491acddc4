// The kernels of models as parts of a program.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// The structs and functions of every kernel's prelude, in the kernel language.
std::string_view kernel_prelude();

/// The tone curves of ToneCurve, in the kernel language.
std::string_view tone_kernel();

/// Table in GLSL; `table_numbers` is a texture (R32F) of ExportedScene::tables with k_table_width numbers in
/// a row.
std::string_view glsl_tables();

/// Whether a model's kernel has a struct of parameters.
bool has_parameters(const ExportedModel& model);
/// Whether its kernel has the function <prefix>_<name>.
bool has_function(const ExportedModel& model, std::string_view name);
/// The type of its functions' first argument: the struct of its parameters, or what <prefix>_prepare makes of
/// it.
std::string constants_type(const ExportedModel& model);
/// The constants as an expression of the parameters: "x_prepare(material)", or the parameters themselves.
std::string prepared(const ExportedModel& model, const std::string& parameters);
/// A call of that function: with the constants as `parameters` if it takes them, then `arguments`.
std::string call(const ExportedModel& model, std::string_view name, std::string_view parameters,
                 std::string_view arguments);
/// The struct of a model's parameters with these values: "PhongMaterial{vec3(0.1f), ...}".
std::string parameters_text(const ExportedModel& model, const ExportedValues& values);
/// The same, prepared.
std::string struct_text(const ExportedModel& model, const ExportedValues& values);

/// The light, reflection and shading models of a scene, each once.
std::vector<ExportedModel> models_of(const ExportedScene& scene);

/// Throws std::runtime_error if two kernels declare the same name. They cannot be combined in one program,
/// because neither C++ nor GLSL could tell the two apart.
void require_different_names(const ExportedScene& scene);

/// A kernel's text, or any other C++ or GLSL, without comments.
std::string without_comments(std::string_view text);

/// The paragraphs of `library` (separated by empty lines) that declare something used by `users` or by
/// another needed paragraph, and those that declare nothing.
std::string needed_parts(std::string_view library, const std::string& users);

}  // namespace candela::target
