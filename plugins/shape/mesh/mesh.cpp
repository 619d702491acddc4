#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/color.h"
#include "candela/parallel.h"
#include "candela/shape_plugin.h"
#include "corners.h"
#include "crease.h"
#include "cutout.h"
#include "loaded.h"
#include "mesh_io/file_bytes.h"
#include "mesh_io/readers.h"
#include "mesh_io/surface.h"
#include "origin.h"
#include "part.h"
#include "tangents.h"

using namespace candela::sdk;

namespace {

struct MeshShape {
    const char* file;
    float crease_angle;  // radians
    std::int32_t allow_outside;
    std::int32_t vertex_colors;
    const char* part;
    std::int32_t appearance_imported;
    const char* origin;
    std::int32_t sides;  // Sides
    const char* cutout;
    float cutout_level;
    std::int32_t cutout_clamps;
};

enum class Sides : std::int32_t { outside, front, both };

enum class Format { obj, ply, stl, gltf };

Format format_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".obj") return Format::obj;
    if (extension == ".ply") return Format::ply;
    if (extension == ".stl") return Format::stl;
    if (extension == ".gltf" || extension == ".glb") return Format::gltf;
    throw mesh_io::BadFile("has an unsupported mesh extension; expected .obj, .ply, .stl, .gltf or .glb");
}

mesh_io::Surface surface_of(const std::filesystem::path& file, const mesh_io::Origin& origin,
                            mesh_io::FileScope reach, mesh_io::Attributes attributes,
                            const mesh_io::Progress& progress) {
    const Format format = format_of(file);
    mesh_io::Array<char> bytes;
    if (format != Format::stl) bytes = mesh_io::read_file(file);
    mesh_io::Surface surface;
    switch (format) {
        case Format::obj:
            surface = mesh_io::read_obj(mesh_io::text_of(bytes), origin, progress);
            break;
        case Format::ply:
            surface = mesh_io::read_ply(mesh_io::text_of(bytes), origin, progress, attributes);
            break;
        case Format::stl: {
            mesh_io::Pieces pieces(file);
            surface = mesh_io::read_stl(pieces, origin, progress);
            break;
        }
        case Format::gltf:
            surface =
                mesh_io::read_gltf(mesh_io::text_of(bytes), origin, file.parent_path(), reach, attributes);
            break;
    }
    if (surface.triangles() == 0) throw mesh_io::BadFile("has no faces, and so no triangles");
    if (surface.indices.size() > 0xffff'fff0u) throw mesh_io::BadFile("has too many triangles");
    if (const std::string note = mesh::too_far_note(surface, origin); !note.empty())
        surface.notes.push_back(note);
    return surface;
}

mesh_io::Origin origin_of(const MeshShape& shape) {
    const std::string_view text = shape.origin != nullptr ? shape.origin : "";
    const auto origin = mesh::origin_from(text);
    if (!origin)
        throw std::invalid_argument(
            fmt::format("'origin' is {}; expected three numbers, such as \"500000 4500000 120\"",
                        mesh_io::in_quotes(text)));
    return *origin;
}

bool has_all_normals(const mesh_io::Surface& surface) {
    for (std::size_t i = 0; i < surface.normal.size(); ++i)
        if (surface.normal.span()[i] == candela::Vec3{}) return false;
    return !surface.normal.empty();
}

/// Copies `from[source[i]]` to `to[i]`, or all of `from` if `source` is empty.
void copy(const mesh_io::Array<float>& from, const mesh_io::Array<std::uint32_t>& source, std::size_t count,
          float* to) {
    constexpr std::size_t k_per_task = 65536;
    candela::parallel_for(count, k_per_task, [&](std::size_t begin, std::size_t end) {
        if (source.empty()) {
            std::copy(from.data() + begin, from.data() + end, to + begin);
        } else {
            for (std::size_t i = begin; i < end; ++i) to[i] = from[source[i]];
        }
    });
}

void copy(const mesh_io::Vectors& from, const mesh_io::Array<std::uint32_t>& source, std::size_t count,
          candela::Vec3Span to) {
    copy(from.x, source, count, to.x);
    copy(from.y, source, count, to.y);
    copy(from.z, source, count, to.z);
}

/// The triangles of a file, with its parts joined and its node transformations applied.
class FileMesh final : public candela::Shape {
  public:
    explicit FileMesh(const MeshShape& shape)
        : file_(shape.file != nullptr ? shape.file : ""),
          crease_angle_(shape.crease_angle),
          reach_(shape.allow_outside != 0 ? mesh_io::FileScope::anywhere : mesh_io::FileScope::its_folder),
          uses_colors_(shape.vertex_colors != 0),
          part_(shape.part != nullptr ? shape.part : ""),
          appearance_imported_(shape.appearance_imported != 0),
          origin_(origin_of(shape)),
          sides_(static_cast<Sides>(shape.sides)),
          cutout_(shape.cutout != nullptr ? shape.cutout : ""),
          cutout_level_(shape.cutout_level),
          cutout_clamps_(shape.cutout_clamps != 0),
          shared_(mesh::SharedFile::of(file_, origin_, reach_, keeps_sides())) {}

    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        try {
            const auto attributes =
                request.channels.empty() ? mesh_io::Attributes::skipped : mesh_io::Attributes::read;
            const auto read = [&] {
                const auto reading = [&](double part) { sink.progress(k_read * part); };
                mesh_io::Surface surface = surface_of(file_, origin_, reach_, attributes, reading);
                sink.progress(k_read);
                return std::make_shared<const mesh::Loaded>(std::move(surface), keeps_sides());
            };
            std::shared_ptr<const mesh::Loaded> whole = shared_->loaded(attributes, read);
            sink.progress(k_oriented);
            if (part_.empty() && cutout_.empty()) {
                std::shared_ptr<const mesh::SplitVertices> split;
                if (needs_split(whole->surface(), request)) split = whole->split(crease_angle_);
                const mesh::SplitVertices none;
                return write(whole->surface(), split != nullptr ? *split : none, whole->open(), request,
                             sink);
            }
            mesh_io::Surface part;
            if (!part_.empty()) part = mesh::part_of(whole->surface(), whole->by_material(), part_);
            if (!cutout_.empty()) part = cut_out(part_.empty() ? whole->surface() : part);
            whole.reset();
            const mesh::Corners corners(part);
            mesh::SplitVertices split;
            if (needs_split(part, request)) split = mesh::split_at_creases(part, corners, crease_angle_);
            write(part, split, mesh::open_edges(part, corners), request, sink);
        } catch (const mesh_io::BadFile& problem) {
            throw std::runtime_error(fmt::format("'{}' {}", file_, problem.what()));
        }
    }

  private:
    bool is_faceted(const mesh_io::Surface& surface, const candela::MeshRequest& request) const {
        return request.facets && crease_angle_ == 0 && surface.normal.empty() && surface.smoothing.empty();
    }
    bool needs_split(const mesh_io::Surface& surface, const candela::MeshRequest& request) const {
        return request.normals && !is_faceted(surface, request) && !has_all_normals(surface);
    }

    static const mesh_io::Array<float>& channel_of(const mesh_io::Surface& surface,
                                                   const candela::VertexChannel& wanted) {
        const auto found = std::ranges::find(surface.attributes, wanted.attribute, &mesh_io::Attribute::name);
        if (found != surface.attributes.end()) {
            if (wanted.channel < found->channels.size()) return found->channels[wanted.channel];
            throw mesh_io::BadFile(fmt::format(
                "has a vertex attribute '{}' with {}, of which number {} is needed; to take one, set channel "
                "= "
                "\"r\"",
                wanted.attribute, mesh_io::counted(found->channels.size(), "number"), wanted.channel + 1));
        }
        if (wanted.attribute == "uv1") throw mesh_io::BadFile("has no second set of texture coordinates");
        std::vector<std::string> names;
        for (const mesh_io::Attribute& attribute : surface.attributes)
            if (attribute.name != "uv1") names.push_back(mesh_io::in_quotes(attribute.name));
        throw mesh_io::BadFile(fmt::format("has no vertex attribute {}; it has {}",
                                           mesh_io::in_quotes(wanted.attribute),
                                           names.empty() ? "none" : mesh_io::listed(names)));
    }

    bool keeps_sides() const { return sides_ != Sides::outside; }

    mesh_io::Surface cut_out(const mesh_io::Surface& surface) const {
        try {
            const mesh_io::Array<char> bytes = mesh_io::read_file(cutout_);
            const mesh::Opacity opacity = mesh::Opacity::read(mesh_io::text_of(bytes));
            return mesh::cut_out(surface, opacity, cutout_level_, cutout_clamps_);
        } catch (const mesh_io::BadFile& problem) {
            throw std::runtime_error(fmt::format("the cut-out '{}' {}", cutout_, problem.what()));
        }
    }

    // Progress after each step, measured with ten million triangles.
    static constexpr double k_read = 0.5, k_oriented = 0.8, k_split = 0.9;

    void write(const mesh_io::Surface& surface, const mesh::SplitVertices& creased,
               const mesh::OpenEdges& open, const candela::MeshRequest& request,
               candela::MeshSink& sink) const {
        sink.progress(k_split);
        mesh::Tangents tangents;
        if (request.derivatives && !surface.u.empty()) tangents = mesh::tangents_of(surface, creased);
        const mesh::SplitVertices& split = tangents.vertices.indices.empty() ? creased : tangents.vertices;
        const mesh_io::Array<std::uint32_t>& indices =
            split.indices.empty() ? surface.indices : split.indices;

        const candela::MeshLayout layout{
            .vertices = split.source.empty() ? surface.position.size() : split.source.size(),
            .triangles = surface.triangles(),
            .has_normals = request.normals && !surface.normal.empty(),
            .has_uv = (request.uv || request.derivatives) && !surface.u.empty(),
            // Zero without texture coordinates: a triangle's edges differ from its neighbours' and would make
            // no better tangents.
            .has_derivatives = request.derivatives,
            .has_color = request.color && uses_colors_ && !surface.color.empty(),
            .has_channels = true,
            .has_smooth_groups = !split.group.empty(),
            .is_faceted = is_faceted(surface, request),
            .closedness = sides_ == Sides::front ? candela::Closedness::one_sided
                          : open.count == 0      ? candela::Closedness::closed
                                                 : candela::Closedness::open,
            .open_edges = open.count};
        const candela::MeshSpans to = sink.allocate(layout);
        copy(surface.position, split.source, layout.vertices, to.position);
        if (layout.has_normals) copy(surface.normal, split.source, layout.vertices, to.normal);
        if (layout.has_uv) {
            copy(surface.u, split.source, layout.vertices, to.uv.x);
            copy(surface.v, split.source, layout.vertices, to.uv.y);
        }
        if (layout.has_color)
            write_colors(surface, split.source, request.color_management, layout.vertices, to.color, sink);
        for (std::size_t i = 0; i < request.channels.size(); ++i)
            copy(channel_of(surface, request.channels[i]), split.source, layout.vertices, to.channels[i]);
        std::ranges::copy(indices, to.indices.begin());
        if (layout.has_smooth_groups) std::ranges::copy(split.group, to.smooth_group.begin());
        if (layout.has_derivatives && layout.has_uv) {
            copy(tangents.dpdu, {}, layout.vertices, to.dpdu);
            copy(tangents.dpdv, {}, layout.vertices, to.dpdv);
        }
        std::vector<std::string> losses;
        for (const mesh_io::Unsupported& loss : surface.losses)
            if (!loss.appearance || !appearance_imported_) losses.push_back(loss.text);
        if (!losses.empty())
            sink.warn(fmt::format("'{}' also has {}, which {} left out", file_, mesh_io::listed(losses),
                                  losses.size() == 1 && !losses[0].ends_with('s') ? "is" : "are"));
        for (const std::string& note : surface.notes) sink.warn(fmt::format("'{}' {}", file_, note));
    }

    void write_colors(const mesh_io::Surface& surface, const mesh_io::Array<std::uint32_t>& source,
                      candela::ColorEncoding scene, std::size_t count, candela::Vec3Span to,
                      candela::MeshSink& sink) const {
        copy(surface.color, source, count, to);
        const bool is_encoded = !surface.is_color_linear && scene == candela::ColorEncoding::srgb;
        bool are_within = true;
        for (float* const channel : {to.x, to.y, to.z}) {
            for (std::size_t i = 0; i < count; ++i) {
                const float c = channel[i] > 0 ? std::min(channel[i], 1.0f) : 0.0f;  // 0 for NaN
                are_within = are_within && c == channel[i];
                channel[i] = is_encoded ? candela::srgb_to_linear(c) : c;
            }
        }
        if (!are_within)
            sink.warn(fmt::format("'{}' has vertex colours outside 0 to 1, which are clamped", file_));
    }

    std::string file_;
    double crease_angle_;
    mesh_io::FileScope reach_;
    bool uses_colors_;
    std::string part_;
    bool appearance_imported_;
    mesh_io::Origin origin_;
    Sides sides_;
    std::string cutout_;
    float cutout_level_;
    bool cutout_clamps_;
    std::shared_ptr<mesh::SharedFile> shared_;
};

constexpr const char* k_sides[] = {"outside", "front", "both"};

constexpr auto k_fields = fields(
    file(&MeshShape::file, "file", "OBJ, PLY, STL, glTF or GLB file, relative to the scene file"),
    angle(&MeshShape::crease_angle, "crease_angle", 40,
          "where the file has neither normals nor smoothing groups, edges are hard if their faces' normals "
          "differ by a larger angle; 180: no hard edges")
        .range(0, 180),
    boolean(&MeshShape::allow_outside, "allow_outside", false,
            "whether a glTF file may name buffers outside its folder"),
    boolean(&MeshShape::vertex_colors, "vertex_colors", true,
            "whether the file's vertex colours, if any, are multiplied by the object's colour"),
    Field<MeshShape>{.spec = {.name = "part",
                              .type = candela::ParamType::text,
                              .meaning = "use only the triangles with the file's material of this name or "
                                         "number, such as #0; (none): those without a material; empty: all",
                              .default_value = {.text = ""}},
                     .text = &MeshShape::part},
    boolean(&MeshShape::appearance_imported, "appearance_imported", false,
            "whether the scene itself describes the file's materials, textures, lights and cameras, as "
            "candela import writes it, so that leaving them out needs no warning"),
    Field<MeshShape>{
        .spec = {.name = "origin",
                 .type = candela::ParamType::text,
                 .meaning = "the point in the file's coordinates that becomes the object's origin, for files "
                            "far from their own origin: three double-precision numbers in a string, such as "
                            "\"500000.25 4500000.5 120\"; empty: the file's origin",
                 .default_value = {.text = ""}},
        .text = &MeshShape::origin},
    choice(&MeshShape::sides, "sides", k_sides,
           "outside: closed parts that are wound inside out are turned round; front: parts stay as they are, "
           "and triangles are visible only from the side on which their corners run counter-clockwise; both: "
           "parts stay as they are, and both sides are visible"),
    Field<MeshShape>{.spec = {.name = "cutout",
                              .type = candela::ParamType::file,
                              .meaning = "an opacity map (binary PGM) placed like a texture; transparent "
                                         "parts of the surface are cut away",
                              .default_value = {.text = ""}},
                     .text = &MeshShape::cutout},
    real(&MeshShape::cutout_level, "cutout_level", 0.5f, "the lowest opacity that is kept").range(0, 1),
    boolean(&MeshShape::cutout_clamps, "cutout_clamps", false,
            "whether the opacity map is clamped at its edges instead of repeating"));

}  // namespace

CANDELA_PLUGIN(
    shape, FileMesh, k_fields,
    {.title = "Mesh from a file",
     .summary = "Triangles from OBJ, PLY, STL, glTF and GLB files. Normals come from the file. Where it has "
                "none, the shading model makes them, smooth where corners touch, except across hard edges: "
                "those between an OBJ file's smoothing groups, or wherever faces (of an STL file: their "
                "facet normals) turn by more than `crease_angle`. Vertex colours are multiplied by the "
                "object's colour. Other contents, such as materials and lines, are left out with a warning.",
     .reference = ""})
