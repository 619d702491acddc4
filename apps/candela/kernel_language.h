// The kernel language, as far as a text that nobody trusts may use it: the body of one function.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// What a text has that the language has not, and where; lines and columns count from 1.
struct KernelLanguageProblem {
    std::size_t line = 1;
    std::size_t column = 1;
    std::string message;
};

/// The first thing in a function's body that is not in the kernel language: preprocessor directives, texts,
/// attributes, assembler, pointers, arrays, scopes, keywords of C++ that GLSL does not have, reserved names,
/// brackets that do not match, too much of it all; or that
/// nothing is returned. What passes can compute from the function's arguments,
/// call functions of the kernel language and declare variables, and reaches nothing else. Whether it compiles
/// is another question.
std::optional<KernelLanguageProblem> problem_in_body(std::string_view body);

/// The body with floating-point literals as C++ needs them: 2.0 becomes 2.0f. Lines stay as they are;
/// comments become spaces.
std::string body_for_cpp(std::string_view body);
