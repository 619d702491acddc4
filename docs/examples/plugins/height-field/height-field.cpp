// A terrain from an ASCII grid, a format in which surveys publish heights.
#include <candela/shape_plugin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace candela::sdk;

namespace {

struct HeightFieldParams {
    const char* file;
    float width;
    float exaggeration;
};

/// Rows from north to south, columns from west to east; a cell's height is that of its centre.
struct Grid {
    std::size_t columns = 0, rows = 0;
    float cell_size = 1;
    std::vector<float> heights;
};

std::size_t whole(double number, const std::string& key) {
    if (!(number >= 2 && number <= 8192) || number != std::floor(number))
        throw std::runtime_error("its '" + key + "' is not an integer from 2 to 8192");
    return static_cast<std::size_t>(number);
}

Grid read(const char* path) {
    std::ifstream file(path);
    Grid grid;
    std::string key;
    double hole = -9999, number = 0;
    // The header: keys, in any case, each with a number. The heights begin at the first line without a key.
    while ((file >> std::ws) && std::isalpha(file.peek()) != 0 && file >> key >> number) {
        std::ranges::transform(key, key.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (key == "ncols") grid.columns = whole(number, key);
        if (key == "nrows") grid.rows = whole(number, key);
        if (key == "cellsize") grid.cell_size = static_cast<float>(number);
        if (key == "nodata_value") hole = number;
    }
    if (grid.columns == 0 || grid.rows == 0)
        throw std::runtime_error("it is not an ASCII grid: 'ncols' or 'nrows' is missing");
    if (!(grid.cell_size > 0) || !std::isfinite(grid.cell_size))
        throw std::runtime_error("its 'cellsize' is not above 0");
    grid.heights.reserve(grid.columns * grid.rows);
    while (grid.heights.size() < grid.columns * grid.rows && file >> number)
        grid.heights.push_back(number == hole ? 0 : static_cast<float>(number));
    if (grid.heights.size() < grid.columns * grid.rows)
        throw std::runtime_error("it ends after " + std::to_string(grid.heights.size()) + " of " +
                                 std::to_string(grid.columns * grid.rows) + " heights");
    return grid;
}

class HeightField final : public candela::Shape {
  public:
    explicit HeightField(const HeightFieldParams& params)
        : grid_(read(params.file)), width_(params.width), exaggeration_(params.exaggeration) {}

    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        const std::size_t columns = grid_.columns, rows = grid_.rows;
        const candela::MeshSpans mesh = sink.allocate({.vertices = columns * rows,
                                                       .triangles = 2 * (columns - 1) * (rows - 1),
                                                       .has_uv = request.uv,
                                                       .has_smooth_groups = true,
                                                       .closedness = candela::Closedness::open,
                                                       .open_edges = 2 * (columns - 1) + 2 * (rows - 1)});
        const float step = width_ / static_cast<float>(columns - 1);
        const float upwards = exaggeration_ * step / grid_.cell_size;
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t vertex = row * columns + column;
                mesh.position.set(
                    vertex,
                    {step * static_cast<float>(column) - 0.5f * width_, upwards * grid_.heights[vertex],
                     step * (static_cast<float>(row) - 0.5f * static_cast<float>(rows - 1))});
                mesh.smooth_group[vertex] = static_cast<std::uint32_t>(vertex);
                if (!request.uv) continue;
                mesh.uv.x[vertex] = static_cast<float>(column) / static_cast<float>(columns - 1);
                mesh.uv.y[vertex] = 1 - static_cast<float>(row) / static_cast<float>(rows - 1);
            }
        }
        std::size_t corner = 0;
        for (std::size_t row = 0; row + 1 < rows; ++row) {
            for (std::size_t column = 0; column + 1 < columns; ++column) {
                const std::size_t north_west = row * columns + column, south_west = north_west + columns;
                for (const std::size_t vertex :
                     {north_west, south_west, south_west + 1, north_west, south_west + 1, north_west + 1})
                    mesh.indices[corner++] = static_cast<std::uint32_t>(vertex);
            }
        }
    }

  private:
    Grid grid_;
    float width_, exaggeration_;
};

constexpr auto k_fields = fields(
    file(&HeightFieldParams::file, "file", "heights as an ASCII grid (.asc), in the unit of its cellsize"),
    real(&HeightFieldParams::width, "width", 1, "the extent from west to east; heights have the same scale")
        .above(0)
        .unit("m"),
    real(&HeightFieldParams::exaggeration, "exaggeration", 1, "a factor for heights").above(0));

constexpr candela::Property k_properties[] = {{"open"}};

}  // namespace

CANDELA_PLUGIN(
    shape, HeightField, k_fields,
    {.title = "Height field",
     .summary = "A terrain of heights from a file; north is -z, and cells without data have height 0.",
     .reference = "Esri ASCII raster format, ArcGIS documentation",
     .properties = k_properties})
