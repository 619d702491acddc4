// Completing a command line for a shell. Its script (shells/) runs the command with CANDELA_COMPLETE set and
// the words up to the cursor; the verb then does no work, and its CommandLine prints what the last word may
// become.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

import candela.registry;
import candela.scene;

struct Completion {
    std::string word;
    std::string meaning{};
};

bool is_completing();

/// Prints, for the shell's script, those that begin with `typed`: a line each, the meaning after a tab.
void print_completions(std::string_view typed, std::span<const Completion> completions);

enum class FileKind : bool { any, folder };

/// Asks the shell's script to complete the name of a file itself: a line that begins with a tab.
void print_file_completions(FileKind kind);

/// What PATH=VALUE may become where values of a scene are set: paths up to their next part
/// ("light.lamp."), or values where the path has a few.
std::vector<Completion> setting_completions(std::string_view typed, const candela::SceneRequest& request,
                                            candela::Registry& registry);
