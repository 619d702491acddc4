// The terms of a picture's intensity, and the values it was computed from, as layers of the picture or as
// files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aov/luminance.h"

import candela.plugins;
import candela.render;
import candela.scene;
import candela.shading;
import candela.util;

/// One requested term.
struct NamedTerm {
    std::string name;  // "diffuse", "light.lamp", "material.roughness"
    candela::Term term;
    std::optional<std::size_t> light{};                // index of the scene's light
    std::vector<candela::ShownParameter> parameter{};  // of a parameter: by object
    bool is_number = false;  // of a parameter: some model has three numbers otherwise
};

/// The terms for words: "diffuse", "light.lamp", "light.0", "light" (each light), "material.roughness",
/// "material" (each parameter of the objects' reflection models), "all", which is without those. Each term
/// once, in the order of the words. Throws candela::Error (bad_request), with a suggestion, for an unknown
/// word; `origin` names its source.
std::vector<NamedTerm> terms_from(const std::vector<std::string>& words, const candela::Scene& scene,
                                  const std::string& origin);

/// Whether it is the luminance, which is shown in false colours.
bool is_luminance(const NamedTerm& term);

/// How many of the three channels of TermRenderer::values() the term uses; the others are equal or empty.
int channel_count(const NamedTerm& term);

/// The file for a term of that name, next to the picture: "scene.diffuse.png" for "scene.png".
std::filesystem::path file_of_term(const std::string& name, const std::filesystem::path& image);

/// The files of all terms. Throws candela::Error (bad_request) if two have the same name.
std::vector<std::filesystem::path> files_of(const std::vector<NamedTerm>& terms,
                                            const std::filesystem::path& image);

/// Renders terms of one scene, one after another.
class TermRenderer {
  public:
    explicit TermRenderer(const candela::RenderScene& scene, int threads)
        : scene_(scene), threads_(threads) {}

    /// The term's values, unchanged.
    candela::Film values(const NamedTerm& term);

    /// The values for display: those that are not intensities are mapped to colours
    /// (docs/user/explaining.md), unless the format's pixels are floats. A legend makes a picture wider.
    candela::Film image(const NamedTerm& term, candela::PixelType pixels, LuminanceDisplay& display);

  private:
    candela::Film rendered(const NamedTerm& term);
    candela::Film luminance();

    const candela::RenderScene& scene_;
    int threads_;
    // Each keeps the visibility: with the picture's samples, and at the centre of each pixel.
    candela::Renderer lit_{candela::Renderer::Keep::visibility};
    candela::Renderer geometric_{candela::Renderer::Keep::visibility};
    std::vector<float> facing_;  // one per pixel, computed once a term needs them
};

/// Writes the picture, whose pixels are floats, and the terms as layers of one file.
void write_with_layers(const candela::Film& film, const std::vector<NamedTerm>& terms, TermRenderer& renderer,
                       const candela::OutputFormat& format, const std::filesystem::path& path,
                       candela::Registry& registry, candela::Existing existing);
