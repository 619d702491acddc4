// The plugin under test, and values for its parameters.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

import candela.plugins;

/// Values given by the user for parameters, by name, as written in a scene; texts and words without quotes.
using GivenValues = std::map<std::string, std::string>;

/// Sets the library under test; called once in each child. `given`: for all instances, whatever else varies.
void set_subject(const std::filesystem::path& library, const GivenValues& given = {});
const std::filesystem::path& subject_library();

/// Its manifest, from the file next to it. Fails the check if there is none.
const candela::Manifest& subject_manifest();
/// Loads it, with handshake. Fails the check if it is refused.
const candela::PluginDescriptor& subject();

bool declares(const std::string& property);
std::string declared(const std::string& property);

/// A set of parameter values, and its description for messages.
struct Values {
    candela::ParamSet set;
    std::string text;
};

/// Whether it declares a property for these values: unconditionally, or "where form is disc".
bool declares_for(const std::string& property, const Values& values);

/// The defaults; required parameters get a value in the middle of their range.
Values default_values();
/// The defaults, then each bound of each parameter, then `random_sets` random ones, always the same. All
/// satisfy the plugin's relations.
std::vector<Values> many_values(int random_sets = 50);

/// Whether instances need a file that only the user has and that was not given.
bool needs_a_file();

/// Creates an instance. Skips the check if it would need a file.
template <class Interface>
std::unique_ptr<Interface> make(const Values& values);
