// Exercises: a model's kernel with one function's body left blank, and answers to them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"

import candela.descriptor;
import candela.registry;

/// A kernel's text before and after a function's body: up to the opening brace, and from the closing one on.
struct TextAroundBody {
    std::string before, after;
};
/// Of a text without comments. Throws candela::Error (bad_request) where it has no such function.
TextAroundBody text_around_body(const std::string& text, const std::string& function);

/// A kernel whose function `function` has no body.
struct Exercise {
    std::string model;                            // "reflection/phong"
    std::string function;                         // "phong_reflect"
    const candela::PluginFile* plugin = nullptr;  // loaded; the registry's
    TextAroundBody text;                          // the kernel's, without comments
    candela::kernel_language::Source kernel;      // the whole kernel, as messages call it
};

/// The plugin of a reflection model ("reflection/phong", "phong"), loaded, with kernel text. Throws
/// candela::Error (bad_request) for what is none.
const candela::PluginFile& loaded_model(const std::string& model, candela::Registry& registry);

/// The exercise about a model (reflection/phong) and a function of its kernel (reflect or phong_reflect).
/// Throws candela::Error (bad_request), with what is possible, for what there is no such exercise about, and
/// for a kernel that is not in the kernel language.
Exercise exercise_about(const std::string& model, const std::string& function, candela::Registry& registry);

/// Somebody's answer to an exercise.
struct Answer {
    std::filesystem::path file;
    std::string model;  // as written in the file: not to be trusted, like the rest
    std::string function;
    std::string body;
};

/// The file of an answer: JSON with candela_exercise (1), model, function and answer (its lines). Throws
/// candela::Error (bad_request) for what is no such file, and (failure) for what cannot be read.
Answer answer_from(const std::filesystem::path& file);

/// What is asked for by files and folders; of a folder, the files in it whose names end in ".answer", by
/// name. Throws candela::Error for what is neither.
std::vector<std::filesystem::path> answers_in(const std::vector<std::string>& files_and_folders);
