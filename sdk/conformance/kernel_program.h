// A plugin's kernel text, compiled by whatever compiler this machine has.
#pragma once

#include <boost/dll/shared_library.hpp>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch.h"

/// The folder that has candela/kernel.h, above the kit's own; empty where there is none.
std::filesystem::path sdk_include_directory();

/// "cel.kernel": what messages call the plugin's kernel text, whose lines they count.
std::string kernel_file_name();

/// A folder that is gone when this is.
class TemporaryDirectory {
  public:
    TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    ~TemporaryDirectory();
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// What the compiler, or the loader, says of a text that cannot be run.
class KernelRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Who has written a kernel's text, and with which care it is compiled.
enum class KernelAuthor : bool { of_the_plugin, anybody };

/// A kernel's text, with functions that call its functions, as a library that nobody has loaded.
class CompiledKernel {
  public:
    /// Throws KernelRefused where the text is not C++; skips the check where there is no compiler.
    CompiledKernel(const std::string& text, KernelAuthor author);
    std::filesystem::path library() const { return directory_.path() / "kernel.so"; }
    /// What the compiler warns of in the kernel's text, a line each, with the warnings that generated
    /// programs are compiled with; `unused`: those of variables that nobody reads.
    const std::string& warnings() const { return warnings_; }
    const std::string& unused() const { return unused_; }

  private:
    TemporaryDirectory directory_;
    std::string warnings_, unused_;
};

/// What the functions of a compiled kernel are given beside the points.
struct KernelInputs {
    std::vector<float> parameters;
    std::vector<std::vector<float>> tables;  // by parameter
};
KernelInputs kernel_inputs(const Values& values);

/// The text as C++: `run` does what the plugin's call of that name does, one point after another.
class KernelProgram {
  public:
    /// Of the plugin. Fails the check, with what the compiler says, where the text is not C++; skips it where
    /// there is no compiler.
    KernelProgram();

    const CompiledKernel& compiled() const { return compiled_; }

    /// What the calls of batch_subject() give, by name; `sample` is the light's.
    void run(const std::string& call, const Values& values, int sample, const Arrays& in, Arrays& out) const;
    /// A shape's position at (u, v) of its parameter square.
    candela::Vec3 position(const Values& values, float u, float v) const;

  private:
    using Function = void (*)(const float* parameters, const float* const* tables, const int* table_sizes,
                              int sample, std::size_t count, const float* const* in, float* const* out);
    Function function(const std::string& name) const;

    CompiledKernel compiled_;
    boost::dll::shared_library library_;
};
