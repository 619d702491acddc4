// A program that calls kernels: its source and its input.
#pragma once

#include <string>
#include <vector>

#include "inspect/kernel_trace.h"

import candela.api;

/// One call of a kernel function.
struct KernelCall {
    const candela::PluginDescriptor* plugin = nullptr;
    std::vector<candela::ParamValue> values{};  // as passed to the plugin
    std::string function;                       // "reflect": without the prefix
    std::vector<float> arguments{};             // after the parameters, number by number
    int sample = -1;                            // a light's sample; passed to functions that take one
};

/// The kernels of some plugins, as a program that makes the calls listed in its input. All numbers are in the
/// input, so the program is the same for all parameter values, points and lights.
class KernelProgram {
  public:
    /// Takes each plugin once, and skips those without a kernel. The notes in their kernels are numbered like
    /// `steps`.
    explicit KernelProgram(std::vector<const candela::PluginDescriptor*> plugins);

    /// Call this first: its notes precede the others. `prelude` is the installed text of prelude.kernel.
    std::string traced_prelude(const std::string& prelude);
    /// C++ that includes "candela/kernel/kernel.h"; call it after traced_prelude().
    std::string source();
    /// The program's input for these calls, in order, without calls to functions that no kernel has. The
    /// program prints "call INDEX" before the notes of each.
    std::vector<float> input(const std::vector<KernelCall>& calls) const;

    const std::vector<KernelStep>& steps() const { return kernels_.steps; }

  private:
    std::vector<const candela::PluginDescriptor*> plugins_;
    TracedKernels kernels_;
};
