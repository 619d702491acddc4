// A program that calls kernels: its text, and what it reads.
#pragma once

#include <string>
#include <vector>

#include "explanation/kernel_trace.h"

import candela.descriptor;
import candela.math;
import candela.params;

/// One call of a kernel function.
struct KernelCall {
    const candela::PluginDescriptor* plugin = nullptr;
    std::vector<candela::ParamValue> values{};  // as the plugin gets them
    std::string function;                       // "reflect": without the prefix
    std::vector<float> arguments{};             // after the parameters, number by number
    int sample = -1;                            // a light's; given to those that take it
};

/// The kernels of some plugins, as a program that calls their functions as often as its input says. The
/// numbers are all in the input, so the program is the same for all values of the parameters, all points and
/// all lights.
class KernelProgram {
  public:
    /// Of each plugin once; those without a kernel are left out. Their kernels' notes are numbered as `steps`
    /// are.
    explicit KernelProgram(std::vector<const candela::PluginDescriptor*> plugins);

    /// Notes of prelude.kernel come first: `prelude` is its text as it is installed.
    std::string traced_prelude(const std::string& prelude);
    /// C++ that includes "candela/kernel.h"; after traced_prelude().
    std::string source();
    /// What the program reads for these calls, in their order; those of functions that no kernel has are left
    /// out. It prints "call INDEX" before the notes of each.
    std::vector<float> input(const std::vector<KernelCall>& calls) const;

    const std::vector<KernelStep>& steps() const { return kernels_.steps; }

  private:
    std::vector<const candela::PluginDescriptor*> plugins_;
    TracedKernels kernels_;
};
