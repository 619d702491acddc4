#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/BaseImporter.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/shape_plugin.h"
#include "derivatives.h"

using namespace candela::sdk;

namespace {

struct MeshShape {
    const char* file;
};

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// If the extension does not decide, assimp guesses from the content, with forty readers of which we support
/// none. Only the reader for the extension may be used.
void keep_one_format(Assimp::Importer& importer, const std::string& file) {
    constexpr std::array<std::string_view, 5> k_extensions = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    const std::string extension = lower_extension(file);
    if (std::ranges::find(k_extensions, extension) == k_extensions.end()) {
        throw std::runtime_error("'" + file +
                                 "' has not the extension of a mesh: .obj, .ply, .stl, .gltf or .glb");
    }
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        // Extensions are separated by spaces.
        const std::string extensions = std::string(" ") + importer.GetImporterInfo(i)->mFileExtensions + " ";
        if (extensions.find(" " + extension.substr(1) + " ") != std::string::npos) continue;
        const std::unique_ptr<Assimp::BaseImporter> reader(importer.GetImporter(i));
        importer.UnregisterLoader(reader.get());
    }
}

/// assimp 5.2 never stops reading a PLY file whose header has no end.
void require_end_of_header(const std::string& file) {
    constexpr std::string_view k_end = "end_header";
    constexpr std::size_t k_longest_header = 1 << 20;
    std::string header(k_longest_header, ' ');
    std::ifstream input(file, std::ios::binary);
    input.read(header.data(), static_cast<std::streamsize>(header.size()));
    header.resize(static_cast<std::size_t>(input.gcount()));
    for (std::size_t at = header.find(k_end); at != std::string::npos; at = header.find(k_end, at + 1)) {
        const std::size_t after = at + k_end.size();
        const bool is_line = at > 0 && (header[at - 1] == '\n' || header[at - 1] == '\r') &&
                             after < header.size() &&
                             std::isspace(static_cast<unsigned char>(header[after])) != 0;
        if (is_line) return;
    }
    throw std::runtime_error("'" + file + "' is no PLY file: it has no line 'end_header'");
}

/// The triangles of a file, with its parts joined and its node transformations applied.
class FileMesh final : public candela::Shape {
  public:
    explicit FileMesh(const MeshShape& shape) : file_(shape.file != nullptr ? shape.file : "") {}

    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        Assimp::Importer importer;
        keep_one_format(importer, file_);
        if (lower_extension(file_) == ".ply") require_end_of_header(file_);
        // Points and lines have no surface.
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        const aiScene* const scene =
            importer.ReadFile(file_, aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                         aiProcess_SortByPType | aiProcess_PreTransformVertices);
        if (scene == nullptr) throw std::runtime_error("'" + file_ + "': " + importer.GetErrorString());
        const std::span<aiMesh* const> parts(scene->mMeshes, scene->mNumMeshes);

        candela::MeshLayout layout{.has_normals = true, .has_uv = request.uv || request.derivatives};
        for (const aiMesh* part : parts) {
            layout.vertices += part->mNumVertices;
            layout.triangles += part->mNumFaces;
            layout.has_normals = layout.has_normals && part->HasNormals();
            layout.has_uv = layout.has_uv && part->HasTextureCoords(0);
        }
        // STL files have facet normals, not vertex normals.
        if (lower_extension(file_) == ".stl") layout.has_normals = false;
        layout.has_smooth_groups = !layout.has_normals;
        // Zero without texture coordinates: a triangle's edges, which differ from its neighbours', would make
        // no better tangents.
        layout.has_derivatives = request.derivatives;
        if (layout.triangles == 0) throw std::runtime_error("'" + file_ + "' has no triangles");

        const candela::MeshSpans mesh = sink.allocate(layout);
        std::size_t vertex = 0;
        std::size_t corner = 0;
        for (const aiMesh* part : parts) {
            const auto first = static_cast<std::uint32_t>(vertex);
            for (const aiFace& face : std::span(part->mFaces, part->mNumFaces)) {
                if (face.mNumIndices != 3)
                    throw std::runtime_error("'" + file_ + "' has a face that is no triangle");
                for (const unsigned index : std::span(face.mIndices, 3)) {
                    if (index >= part->mNumVertices) {
                        throw std::runtime_error("'" + file_ + "' has a face whose corner is vertex " +
                                                 std::to_string(index) + " of " +
                                                 std::to_string(part->mNumVertices));
                    }
                    mesh.indices[corner++] = first + index;
                }
            }
            for (unsigned i = 0; i < part->mNumVertices; ++i, ++vertex) {
                mesh.position.set(vertex, vector(part->mVertices[i]));
                if (layout.has_normals) mesh.normal.set(vertex, vector(part->mNormals[i]));
                if (layout.has_uv) {
                    mesh.uv.x[vertex] = part->mTextureCoords[0][i].x;
                    mesh.uv.y[vertex] = part->mTextureCoords[0][i].y;
                }
            }
        }
        if (layout.has_derivatives && layout.has_uv) derivatives_from_uv(mesh, vertex);
        if (layout.has_smooth_groups) weld_by_position(mesh.position, vertex, mesh.smooth_group);
    }

  private:
    static candela::Vec3 vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

    std::string file_;
};

constexpr auto k_fields =
    fields(file(&MeshShape::file, "file", "OBJ, PLY, STL, glTF or GLB file, relative to the scene file"));

}  // namespace

CANDELA_PLUGIN(
    shape, FileMesh, k_fields,
    {.title = "Mesh from a file",
     .summary =
         "Triangles from OBJ, PLY, STL, glTF and GLB files. Normals are the file's; where it has none, the "
         "shading model makes them, smooth where corners touch.",
     .reference = "The Open Asset Import Library, assimp"})
