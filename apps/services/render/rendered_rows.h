// A picture that need not fit into memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

import candela.api;
import candela.render;

namespace candela {

/// Renders rows of a picture on request, a band at a time: the same pixels as candela::render(), in memory
/// for two bands of about 64 MB. One thread at a time.
class RenderedRows final : public ImageRows {
  public:
    /// The scene must outlive this. `options.progress` counts rows.
    RenderedRows(const RenderScene& scene, PixelType pixels, RowRange rows, RenderOptions options);
    ~RenderedRows() override;

    ImageView next(int count) override;

    /// Statistics of all rows so far.
    const RenderStatistics& statistics() const noexcept { return statistics_; }
    /// Returns what candela::darkness_diagnosis() does for all rows.
    std::string darkness_diagnosis() const;

  private:
    void render_band(int first);

    const RenderScene& scene_;
    PixelType pixels_;
    RowRange rows_;
    RenderOptions options_;
    int next_;
    int rows_per_band_;
    Renderer renderer_;
    std::optional<Film> band_;
    std::vector<std::uint8_t> bytes_;  // of rows from more than one band
    std::vector<float> reals_;
    RenderStatistics statistics_;
};

}  // namespace candela
