// A plugin's kernel text, compiled by this machine's compiler.
#pragma once

#include <boost/dll/shared_library.hpp>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch.h"
#include "sandbox/temporary_folder.h"

/// "cel.kernel": the name of the plugin's kernel text in messages, which count its lines.
std::string kernel_file_name();

/// The message of the compiler, or the loader, about a text that cannot be run.
class KernelRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Who wrote a kernel's text, which determines the care with which it is compiled.
enum class KernelAuthor : bool { of_the_plugin, anybody };

/// A kernel's text, and functions that call its functions, as a library that is not yet loaded.
class CompiledKernel {
  public:
    /// Throws KernelRefused if the text is not C++; skips the check if there is no compiler.
    CompiledKernel(const std::string& text, KernelAuthor author);
    std::filesystem::path library() const { return folder_.path() / "kernel.so"; }
    /// The compiler's warnings about the kernel's text, one per line, with the warning options of generated
    /// programs; `unused`: those about variables that are never read.
    const std::string& warnings() const { return warnings_; }
    const std::string& unused() const { return unused_; }

  private:
    TemporaryFolder folder_{"candela-kernel-"};
    std::string warnings_, unused_;
};

/// The parameters of a compiled kernel's functions, as they read them (kernel_parameters_reader()).
std::vector<float> kernel_parameters(const Values& values);

/// How its functions are called: with the parameters, a light's sample, the number of points, the inputs and
/// the outputs, number by number as in Arrays.
using KernelFunctionPointer = void (*)(const float* parameters, int sample, std::size_t count,
                                       const float* const* in, float* const* out);

/// The text as C++: `run` computes the same as the plugin's call of that name, one point after another.
class KernelProgram {
  public:
    /// Compiles the plugin's kernel. Fails the check, with the compiler's message, if the text is not C++;
    /// skips it if there is no compiler.
    KernelProgram();

    const CompiledKernel& compiled() const { return compiled_; }

    /// Computes the results of the calls of batch_subject(), by name; `sample` is the light's.
    void run(const std::string& call, const Values& values, int sample, const Arrays& in, Arrays& out) const;
    /// A shape's position at (u, v) of its parameter square.
    candela::Vec3 position(const Values& values, float u, float v) const;

  private:
    KernelFunctionPointer function(const std::string& name) const;

    CompiledKernel compiled_;
    boost::dll::shared_library library_;
};
