// Exercises: a model's kernel with one function's body left blank, and answers to them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"

import candela.api;
import candela.plugins;

/// A kernel's text before and after a function's body: up to the opening brace, and from the closing one on.
struct TextAroundBody {
    std::string before, after;
};
/// Splits a text without comments. Throws candela::Error (bad_request) if it does not define the function.
TextAroundBody text_around_body(const std::string& text, const std::string& function);

/// A kernel whose `function` has no body.
struct Exercise {
    std::string model;                            // "reflection/phong"
    std::string function;                         // "phong_reflect"
    const candela::PluginFile* plugin = nullptr;  // loaded; owned by the registry
    TextAroundBody text;                          // the kernel's, without comments
    candela::kernel_language::Source kernel;      // the whole kernel, and its name in messages
};

/// The plugin of a model of that kind ("reflection/phong", "phong", or the path of a kernel file), loaded,
/// with its kernel text, which does not depend on a file. Throws candela::Error (bad_request) if `model` is
/// another.
const candela::PluginFile& loaded_model(candela::PluginKind kind, const std::string& model,
                                        candela::Registry& registry);

/// The exercise about a model (reflection/phong) and a function of its kernel (reflect or phong_reflect).
/// Throws candela::Error (bad_request), listing the possible functions, if there is no such exercise, or if
/// the kernel is not in the kernel language.
Exercise exercise_about(const std::string& model, const std::string& function, candela::Registry& registry);

/// An answer to an exercise.
struct Answer {
    std::filesystem::path file;
    std::string model;  // as written in the file: untrusted, like the rest
    std::string function;
    std::string body;
};

/// Reads an answer file: JSON with candela_exercise (1), model, function and answer (its lines). Throws
/// candela::Error: bad_request if it is not such a file, failure if it cannot be read.
Answer answer_from(const std::filesystem::path& file);

/// Expands files and folders to files: a folder stands for the files in it whose names end in ".answer",
/// sorted by name. Throws candela::Error for a name that is neither.
std::vector<std::filesystem::path> answers_in(const std::vector<std::string>& files_and_folders);
