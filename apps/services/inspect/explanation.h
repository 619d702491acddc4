// Explains a pixel: what the renderer knows about it, and what the models' kernels compute for it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "inspect/kernel_run.h"

import candela.api;
import candela.plugins;
import candela.render;
import candela.scene;
import candela.shading;

/// The models of a scene that explaining any of its pixels may call.
std::vector<const candela::PluginDescriptor*> plugins_explained_in(const candela::Scene& scene,
                                                                   candela::Registry& registry);

class Explanation {
  public:
    /// Probes pixel (x, y) of a compiled scene, and runs the kernels of the visible objects' models, which
    /// are among plugins_explained_in(scene). All arguments must outlive this.
    Explanation(const candela::Scene& scene, const candela::RenderScene& compiled,
                candela::Registry& registry, int x, int y, KernelRunner& kernels);

    int x = 0, y = 0;
    const candela::Scene& scene;
    const candela::RenderScene& compiled;
    candela::InspectedPixel pixel;

    /// The kernel's values for the normal of a point, for the light arriving there, and for its reflection;
    /// empty if the model has no kernel, or kernels cannot be run.
    const std::vector<KernelValue>& normal_steps(const candela::PointTrace& point) const;
    const std::vector<KernelValue>& light_steps(const candela::LightTrace& light) const;
    const std::vector<KernelValue>& reflection_steps(const candela::LightTrace& light) const;

    /// Whether objects may block that light.
    bool may_be_blocked(const candela::LightTrace& light) const;

    /// Why there are no kernel values; empty if there are some.
    const std::string& why_no_steps() const { return why_no_steps_; }
    /// The largest difference between the intensities reflected by the kernel's text, compiled here, and by
    /// the plugin, as a fraction of the point's intensity; nothing if no kernel was run.
    std::optional<double> kernel_difference() const;
    /// The luminance of the pixel in cd/m², like the term of that name: without a background that is a colour
    /// of the picture.
    double luminance() const;

  private:
    std::size_t add(KernelCall call);
    void add_calls(const candela::InspectedFragment& fragment, candela::Registry& registry);

    struct CallsOfLight {
        const candela::LightTrace* trace;
        std::size_t illuminate, reflect;
    };
    struct CallOfPoint {
        const candela::PointTrace* trace;
        std::size_t normal;
    };
    std::vector<KernelCall> calls_;
    std::vector<CallOfPoint> points_;
    std::vector<CallsOfLight> lights_;
    KernelValues values_;
    std::string why_no_steps_;
};

enum class JsonLayout { indented, one_line };

/// As text, and as JSON.
std::string explanation_text(const Explanation& explanation);
std::string explanation_json(const Explanation& explanation, JsonLayout layout);
