// Parts of a command line that several verbs share.
#pragma once

#include <boost/program_options.hpp>
#include <filesystem>
#include <string>
#include <vector>

import candela.plugins;
import candela.scene;
import candela.util;

/// A verb's options, positional arguments and help. Throws candela::Error (usage), with a suggestion, for
/// unknown arguments.
class CommandLine {
  public:
    /// `usage`: "candela render [SCENE...] [options]".
    CommandLine(std::string usage, std::string explanation);

    /// Use this to add the verb's own options.
    boost::program_options::options_description_easy_init options() { return visible_.add_options(); }
    /// Takes all arguments that are not options.
    void positional(const std::string& name, int how_many);

    /// False if help or completions were requested (and printed), so the verb is done.
    bool parse(const std::vector<std::string>& arguments);

    bool has(const std::string& name) const { return values_.count(name) > 0; }
    /// Whether the user gave it; has() is always true for an option with a default value.
    bool is_given(const std::string& name) const { return has(name) && !values_[name].defaulted(); }
    template <class T>
    T get(const std::string& name) const {
        return values_[name].as<T>();
    }
    /// All values of a repeated option; none if it was not given.
    std::vector<std::string> all(const std::string& name) const;

  private:
    enum class Unknown : bool { refused, allowed };

    void read(const std::vector<std::string>& arguments, Unknown unknown);
    /// Prints the completions of the last word (completion.h).
    void complete(const std::vector<std::string>& words);
    void complete_value(const boost::program_options::option_description& option, const std::string& given,
                        const std::string& typed) const;
    void complete_positional(const std::string& typed) const;

    std::string usage_;
    std::string explanation_;
    boost::program_options::options_description visible_;
    boost::program_options::options_description hidden_;
    boost::program_options::positional_options_description positional_;
    boost::program_options::variables_map values_;
};

/// Adds --plugin-dir.
void add_plugin_options(CommandLine& line);
/// The installed plugins. Throws for a plugin refused in a folder named by --plugin-dir; elsewhere, warns
/// which plugin is used instead.
candela::Registry registry_from(const CommandLine& line);

/// Adds the options that say how a scene is read: SCENE..., --shading, --set and so on.
void add_scene_options(CommandLine& line);
/// How models are shown: at rest (unless --frame selects a frame), or with their animation.
enum class Models { at_rest, moving };
/// Throws candela::Error if the options contradict each other or the kind of file, whatever it contains.
void require_scene_options(const CommandLine& line);
/// Imports a model given in place of a scene, once, and reports what is lost.
candela::SceneRequest scene_request_from(const CommandLine& line, candela::Registry& registry,
                                         Models models = Models::at_rest);
/// Whether a model is given in place of a scene.
bool has_model(const CommandLine& line);
/// The arguments that give another command, run in this folder, the same scene.
std::vector<std::string> scene_words_from(const CommandLine& line);

/// Adds --frame, for scene_request_from().
void add_frame_option(CommandLine& line);

/// The PATH=VALUE pairs of a repeatable option.
std::vector<candela::Setting> settings_from(const CommandLine& line, const std::string& option);

/// The words between the commas of a list, empty ones included.
std::vector<std::string> words_of(const std::string& list);

/// A number from 1 to `most`. Throws Error (bad_request).
int count_from(const CommandLine& line, const std::string& option, int most);

/// The value of --threads; 0 if it is not given. Throws Error (bad_request).
int threads_from(const CommandLine& line);
