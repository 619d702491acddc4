// The parts of a command line that several verbs share.
#pragma once

#include <boost/program_options.hpp>
#include <filesystem>
#include <string>
#include <vector>

import candela.diagnostics;
import candela.registry;
import candela.scene;

/// A verb's options, its positional arguments and its help. Throws candela::Error (usage) with a suggestion
/// for what it does not know.
class CommandLine {
  public:
    /// `usage`: "candela render [SCENE...] [options]".
    CommandLine(std::string usage, std::string explanation);

    /// To add the verb's own options to.
    boost::program_options::options_description_easy_init options() { return visible_.add_options(); }
    /// Takes all arguments that are no options.
    void positional(const std::string& name, int how_many);

    /// False where help or completions were asked for (and printed): the verb is done.
    bool parse(const std::vector<std::string>& arguments);

    bool has(const std::string& name) const { return values_.count(name) > 0; }
    /// Whether a person has given it; an option with a default value is there in any case.
    bool is_given(const std::string& name) const { return has(name) && !values_[name].defaulted(); }
    template <class T>
    T get(const std::string& name) const {
        return values_[name].as<T>();
    }
    /// All values of a repeated option; none where it was not given.
    std::vector<std::string> all(const std::string& name) const;

  private:
    enum class Unknown : bool { refused, allowed };

    void read(const std::vector<std::string>& arguments, Unknown unknown);
    /// Prints what the last word may become (completion.h).
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
/// The installed plugins. What is refused in a folder that --plugin-dir names is not replaced; elsewhere a
/// warning says what is used instead.
candela::Registry registry_from(const CommandLine& line);

/// Adds what says how a scene is read: SCENE..., --shading, --set and so on.
void add_scene_options(CommandLine& line);
/// How models are shown: at rest, unless --frame asks for a frame, or with their animation.
enum class Models { at_rest, moving };
/// A model's file in place of a scene is imported, once, and what is lost is said.
candela::SceneRequest scene_request_from(const CommandLine& line, candela::Registry& registry,
                                         Models models = Models::at_rest);
/// To be called once the scene of a model has been compiled: until then its triangles are kept, so that the
/// file is read only once.
void forget_triangles_of_models();
/// The words that say the same to another command, in this folder.
std::vector<std::string> scene_words_from(const CommandLine& line);

/// Adds --frame, for scene_request_from().
void add_frame_option(CommandLine& line);

/// The PATH=VALUE pairs of an option that may be repeated.
std::vector<candela::Setting> settings_from(const CommandLine& line, const std::string& option);

/// What stands between the commas of a list; empty words too.
std::vector<std::string> words_of(const std::string& list);

/// A number from 1 to `most`. Throws Error (bad_request).
int count_from(const CommandLine& line, const std::string& option, int most);

/// What --threads says; 0 where it is not given. Throws Error (bad_request).
int threads_from(const CommandLine& line);
