// Completing a command line for a shell. The shell's script (shells/) runs the command with CANDELA_COMPLETE
// set and the words up to the cursor. The verb then does no work; its CommandLine prints the completions of
// the last word. Words may come from other people's files: zsh and fish quote what they insert, but bash does
// not. With CANDELA_COMPLETE=bash the command therefore receives the line and the part that readline
// replaces, and prints the replacements.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

import candela.plugins;
import candela.scene;

struct Completion {
    std::string word;
    std::string meaning{};
};

bool is_completing();

/// The words to complete, from the command's arguments; the last one is as far as it has been typed.
std::vector<std::string> words_to_complete(const std::vector<std::string>& arguments);

/// Whether a word is free of characters that a terminal line or the protocol with the shell's script cannot
/// hold.
bool can_be_shown(std::string_view word);

/// Prints the completions that begin with `typed` for the shell's script, one per line, each meaning after a
/// tab. Words that cannot be shown are left out.
void print_completions(std::string_view typed, std::span<const Completion> completions);

enum class FileKind : bool { any, folder };

/// Asks the shell's script to complete a file name itself, by a line that begins with a tab.
void print_file_completions(FileKind kind);

/// The completions of PATH=VALUE for settings of a scene: paths up to their next part ("light.lamp."), or the
/// values of a path that has only a few.
std::vector<Completion> setting_completions(std::string_view typed, const candela::SceneRequest& request,
                                            candela::Registry& registry);
