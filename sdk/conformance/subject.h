// The plugin under test, and values for its parameters.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

import candela.manifest;

/// Values that somebody has given for parameters, by name, as they would stand in a scene; texts and words
/// without quotes.
using GivenValues = std::map<std::string, std::string>;

/// The library whose turn it is; set once in each child. `given`: for all instances, whatever else varies.
void set_subject(const std::filesystem::path& library, const GivenValues& given = {});
const std::filesystem::path& subject_library();

/// Its manifest, from the file beside it. Fails the check where there is none.
const candela::Manifest& subject_manifest();
/// Loads it, with handshake. Fails the check where it is refused.
const candela::PluginDescriptor& subject();

bool declares(const std::string& property);
std::string declared(const std::string& property);

/// A set of parameter values, and how to name it in a message.
struct Values {
    candela::ParamSet set;
    std::string text;
};

/// Whether it declares a property for these values: outright, or "where form is disc".
bool declares_for(const std::string& property, const Values& values);

/// The defaults; required ones get a value in the middle of what is possible.
Values default_values();
/// The defaults, then each bound of each parameter, then `random_sets` at random, always the same. All
/// satisfy the plugin's relations.
std::vector<Values> many_values(int random_sets = 50);

/// Whether instances need a file that only the user has, and that is not given.
bool needs_a_file();

/// An instance. Skips the check where it would need a file.
template <class Interface>
std::unique_ptr<Interface> make(const Values& values);
