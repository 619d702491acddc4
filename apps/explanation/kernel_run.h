// Kernels, compiled here and called, with all the values that they compute.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "explanation/kernel_program.h"
#include "temporary_folder.h"

import candela.descriptor;

/// A value that a kernel computes on its way.
struct KernelValue {
    const KernelStep* step = nullptr;
    int depth = 0;         // 0: the function that was called; 1: one that it calls; and so on
    std::string member{};  // ".diffuse" of what is a struct; empty otherwise
    std::vector<double> numbers{};
};

/// For each call what its function computes, in order; nothing where there is no such text.
using KernelValues = std::vector<std::vector<KernelValue>>;

/// Kernels that can be called as often as one likes. One thread.
class KernelRunner {
  public:
    /// Of these plugins. The program is kept in the folder `kept`, unless that is empty; one that is there is
    /// not compiled again.
    KernelRunner(std::vector<const candela::PluginDescriptor*> plugins, std::filesystem::path kept);

    /// Compiles the kernels with a compiler of this machine, which is otherwise done at the first call.
    void prepare();
    /// Why they cannot be called; empty if they can be, or if nobody has tried.
    const std::string& why_not() const { return why_not_; }
    /// The steps that values point to live as long as this.
    KernelValues run(const std::vector<KernelCall>& calls);

  private:
    /// False, and why_not() says why, where it cannot be compiled.
    bool compile(const std::filesystem::path& folder);
    void read(const std::string& printed, KernelValues& values) const;

    KernelProgram program_;
    std::filesystem::path kept_;
    TemporaryFolder folder_;
    bool is_prepared_ = false;
    std::filesystem::path executable_;
    std::string why_not_;
};
