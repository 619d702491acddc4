// Kernels, compiled here and called once at some point, with all their values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel_trace.h"

import candela.descriptor;
import candela.math;
import candela.params;

/// A value that a kernel computes on its way.
struct KernelValue {
    const KernelStep* step = nullptr;
    int depth = 0;         // 0: the function that was called; 1: one that it calls; and so on
    std::string member{};  // ".diffuse" of what is a struct; empty otherwise
    std::vector<double> numbers{};
};

/// The numbers that kernels are called with: the program reads them, so that it is the same program for other
/// numbers.
class KernelNumbers {
  public:
    /// C++ that reads the number, or the three.
    std::string text(float number);
    std::string text(candela::Vec3 v);

    const std::vector<float>& all() const { return all_; }

  private:
    std::vector<float> all_;
};

/// One call of a kernel function.
struct KernelCall {
    const candela::PluginDescriptor* plugin = nullptr;
    std::vector<candela::ParamValue> values{};  // as the plugin gets them
    std::string function;                       // "reflect": without the prefix
    std::string arguments{};                    // after the parameters, as C++
    int sample = -1;                            // a light's; given to those that take it
};

class KernelRun {
  public:
    /// Whether a plugin's text has this function.
    static bool has(const candela::PluginDescriptor& plugin, const std::string& function);

    /// Compiles the kernels of all calls, with a compiler of this machine, and runs them with `numbers`,
    /// which gets those of the parameters, too. Where that is not possible, why_not() says so, and there are
    /// no values. Programs are kept in `kept`, and those that are there are not compiled again; empty: none
    /// is kept.
    KernelRun(const std::vector<KernelCall>& calls, KernelNumbers& numbers,
              const std::filesystem::path& kept);

    const std::string& why_not() const { return why_not_; }
    /// What the call's function computes, in order; empty where there is no such text.
    const std::vector<KernelValue>& values(std::size_t call) const { return values_[call]; }

  private:
    std::string source(const std::vector<KernelCall>& calls, KernelNumbers& numbers);
    /// The compiled program in `folder`; nothing, and why_not() says why, where it cannot be compiled.
    bool compile(const std::filesystem::path& compiler, const std::filesystem::path& folder);
    void read(const std::string& printed);

    TracedKernels kernels_;
    std::string why_not_;
    std::vector<std::vector<KernelValue>> values_;
};
