// Options that users know from other programs.
#pragma once

#include <string>
#include <vector>

/// The option to use instead of one that a verb does not have: "did you mean '--samples'?". `given` is
/// without its value; `known` are the verb's own, "--samples". Empty if there is nothing to suggest.
std::string suggested_option(const std::string& given, const std::vector<std::string>& known);

/// Whether -h has a number, as in programs where it means the height: "-h 300", "-h300".
bool means_height(const std::vector<std::string>& arguments);
