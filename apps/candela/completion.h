// Completing a command line for a shell. Its script (shells/) runs the command with CANDELA_COMPLETE set and
// the words up to the cursor; the verb then does no work, and its CommandLine prints what the last word may
// become. Words may come from files of other people's: zsh and fish quote what they insert. Bash does not, so
// that with CANDELA_COMPLETE=bash the command is given the line and what readline replaces of it, and prints
// what is to stand there instead.
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

/// The words to be completed, the last one as far as it has been typed, from the arguments of the command.
std::vector<std::string> words_to_complete(const std::vector<std::string>& arguments);

/// Whether a word has no characters that a line of a terminal, or of what is said to a shell, cannot hold.
bool can_be_shown(std::string_view word);

/// Prints, for the shell's script, those that begin with `typed`: a line each, the meaning after a tab. Words
/// that cannot be shown are left out.
void print_completions(std::string_view typed, std::span<const Completion> completions);

enum class FileKind : bool { any, folder };

/// Asks the shell's script to complete the name of a file itself: a line that begins with a tab.
void print_file_completions(FileKind kind);

/// What PATH=VALUE may become where values of a scene are set: paths up to their next part
/// ("light.lamp."), or values where the path has a few.
std::vector<Completion> setting_completions(std::string_view typed, const candela::SceneRequest& request,
                                            candela::Registry& registry);
