// C++ that calls a model's kernel: it fills the struct of parameters from numbers, and passes arguments on.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

import candela.api;

namespace candela::kernel_language {

/// Whether a plugin's kernel has the function <prefix>_<name>.
bool has_kernel_function(const PluginDescriptor& plugin, std::string_view name);

/// Functions that read numbers from a pointer `at` and advance it, read_real() to read_mat3(); for outside
/// the kernels' namespace, after "candela/kernel/kernel.h". The other code here needs it once.
std::string_view kernel_reading();

/// A function `name` without arguments: reads the values of append_parameters() and returns what the kernel's
/// functions are passed first, the struct of its parameters or what <prefix>_prepare() makes of it; 0 if it
/// has no parameters.
std::string kernel_parameters_reader(std::string_view name, const PluginDescriptor& plugin);

/// A function template `name`(parameters, a, b) that calls <prefix>_<function> with those of its arguments
/// that it takes: the parameters, unless the kernel does without them, then a, then b, unless it takes only
/// one.
std::string kernel_caller(std::string_view name, const PluginDescriptor& plugin, std::string_view function);

/// Appends the numbers that a parameters reader reads. `values` are those passed to the plugin, with the
/// instance's tables as the lists of files; integers and the lengths of lists are stored as bits.
void append_parameters(const PluginDescriptor& plugin, std::span<const ParamValue> values,
                       std::vector<float>& numbers);

}  // namespace candela::kernel_language
