// Compiles and calls kernels, and records all values that they compute.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "inspect/kernel_program.h"
#include "sandbox/temporary_folder.h"

import candela.api;

/// An intermediate value of a kernel.
struct KernelValue {
    const KernelStep* step = nullptr;
    int depth = 0;         // 0: the called function; 1: a function that it calls; and so on
    std::string member{};  // ".diffuse" if the value is in a struct; otherwise empty
    std::vector<double> numbers{};
};

/// The values computed by each call's function, in order; empty if there is no such text.
using KernelValues = std::vector<std::vector<KernelValue>>;

/// Compiled kernels that can be called any number of times. One thread.
class KernelRunner {
  public:
    /// The kernels of these plugins. Keeps the program in the folder `kept`, unless that is empty; a program
    /// kept there earlier is not compiled again.
    KernelRunner(std::vector<const candela::PluginDescriptor*> plugins, std::filesystem::path kept);

    /// Compiles the kernels with the compiler on this machine; otherwise the first call does so.
    void prepare();
    /// Why they cannot be called; empty if they can, or if this has not been tried.
    const std::string& why_not() const { return why_not_; }
    /// The steps that the values point to live as long as this.
    KernelValues run(const std::vector<KernelCall>& calls);

  private:
    /// False, with the reason in why_not(), if compiling fails.
    bool compile(const std::filesystem::path& folder);
    void read(const std::string& printed, KernelValues& values) const;

    KernelProgram program_;
    std::filesystem::path kept_;
    TemporaryFolder folder_;
    bool is_prepared_ = false;
    std::filesystem::path executable_;
    std::string why_not_;
};
