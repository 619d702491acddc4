// Models from kernel files, at run time: a file is checked, compiled and kept.
#pragma once

#include <filesystem>
#include <string_view>

#include "candela/kernel_language/syntax.h"

import candela.plugins;

namespace candela::kernel_language {

/// Compiles the text of a model, unless a folder below `cache` has it already: `name` is the model's, and
/// `kernel.name` what messages call the file. The compiler receives code regenerated from what was
/// understood, which can only compute, ends, and reaches no memory except its arguments. The result is as
/// fast as a plugin built with candela_add_plugin(). A reflection model without NAME_reflect_ambient reflects
/// no ambient light. Throws KernelError at what is not in the kernel language, and Error if there is no
/// compiler, or if Candela's headers are not installed. Any thread, any number of processes.
CompiledKernel compile_model(const Source& kernel, std::string_view name, const std::filesystem::path& cache);

/// Reads a file and compiles it to kernel_cache(); a Registry's KernelCompiler.
CompiledKernel compile_kernel_file(const std::filesystem::path& file);

}  // namespace candela::kernel_language
