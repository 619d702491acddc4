#include "mesh_io/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <string_view>
#include <utility>

#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::gltf {

namespace {

/// The largest expansion of a compressed byte in any mode: 256 equal bytes take four times two bits.
constexpr std::uint64_t k_most_ratio = 64;

[[noreturn]] void refuse(const CompressedView& view, std::string_view why) {
    throw BadFile(fmt::format("has a buffer view {} compressed by meshoptimizer {}", view.view, why));
}

int decoded(const CompressedView& view, std::string_view from, Array<char>& to) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(from.data());
    const bool is_index = view.stride == 2 || view.stride == 4;
    if (view.mode == "ATTRIBUTES") {
        if (view.stride == 0 || view.stride > 256 || view.stride % 4 != 0)
            refuse(view, fmt::format("with a stride of {} bytes", view.stride));
        return meshopt_decodeVertexBuffer(to.data(), view.count, view.stride, bytes, from.size());
    }
    if (view.mode == "TRIANGLES") {
        if (!is_index || view.count % 3 != 0) refuse(view, "whose indices are not those of triangles");
        return meshopt_decodeIndexBuffer(to.data(), view.count, view.stride, bytes, from.size());
    }
    if (view.mode == "INDICES") {
        if (!is_index) refuse(view, fmt::format("with a stride of {} bytes", view.stride));
        return meshopt_decodeIndexSequence(to.data(), view.count, view.stride, bytes, from.size());
    }
    refuse(view, fmt::format("in a mode {}, which Candela does not read", in_quotes(view.mode)));
}

void filter(const CompressedView& view, Array<char>& bytes) {
    if (view.filter.empty() || view.filter == "NONE") return;
    if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8))
        return meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
    if (view.filter == "QUATERNION" && view.stride == 8)
        return meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL" && view.stride % 4 == 0)
        return meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
    refuse(view, fmt::format("with a filter {}, which Candela does not read", in_quotes(view.filter)));
}

}  // namespace

void decompress(Document& document, const std::vector<CompressedView>& views) {
    std::uint64_t left = k_most_ratio * document.bytes;
    for (const CompressedView& view : views) {
        const std::string_view from = document.view(view.view);
        if (view.stride == 0 || view.count > left / view.stride)
            refuse(view,
                   fmt::format("that declares {} times {} bytes, more than a file of this size can hold",
                               view.count, view.stride));
        left -= std::uint64_t{view.count} * view.stride;
        Array<char> bytes(view.count * view.stride);
        if (view.count > 0 && decoded(view, from, bytes) != 0)
            refuse(view, "whose bytes are damaged, or of a newer version");
        filter(view, bytes);
        const std::size_t added = document.add_view(std::move(bytes));
        tinygltf::BufferView& to = document.model.bufferViews[view.view];
        to.buffer = document.model.bufferViews[added].buffer;
        to.byteOffset = 0;
        to.byteLength = view.count * view.stride;
    }
}

}  // namespace mesh_io::gltf
