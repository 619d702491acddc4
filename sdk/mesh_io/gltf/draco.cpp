#include "mesh_io/gltf/draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

#include "mesh_io/gltf/accessor.h"
#include "mesh_io/surface.h"

namespace mesh_io::gltf {

namespace {

/// How many corners and points the file's primitives may still have, for every set of attributes. A stream of
/// a few bytes can declare billions, which the decoder would allocate before it reads them.
struct Budget {
    std::uint64_t numbers;
    bool is_exceeded = false;

    bool takes(std::uint64_t some) {
        is_exceeded = is_exceeded || some > numbers;
        if (!is_exceeded) numbers -= some;
        return !is_exceeded;
    }
};

/// Draco's decoder, stopped before it allocates more than the budget allows.
template <class Decoder>
class Bounded final : public Decoder {
  public:
    explicit Bounded(Budget& budget) : budget_(budget) {}

  protected:
    bool DecodeGeometryData() override {
        draco::DecoderBuffer ahead = *this->buffer();
        constexpr bool k_is_edgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
        std::uint64_t sum = 0;
        // The number of new vertices in old versions; vertices and faces, in either order.
        const int counts = k_is_edgebreaker && this->bitstream_version() < 0x0202 ? 3 : 2;
        const bool is_fixed = this->bitstream_version() < (k_is_edgebreaker ? 0x0200 : 0x0202);
        for (int i = 0; i < counts; ++i) {
            std::uint32_t count = 0;
            if (!(is_fixed ? ahead.Decode(&count) : draco::DecodeVarint(&count, &ahead))) return false;
            sum += 3 * std::uint64_t{count};
        }
        std::uint8_t sets = 0;
        if (k_is_edgebreaker && !ahead.Decode(&sets)) return false;
        return budget_.takes(sum * (1 + std::uint64_t{sets})) && Decoder::DecodeGeometryData();
    }

    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *this->point_cloud();
        std::uint64_t components = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i)
            components += static_cast<std::uint64_t>(cloud.attribute(i)->num_components());
        return budget_.takes(components * cloud.num_points()) && Decoder::DecodeAllAttributes();
    }

  private:
    Budget& budget_;
};

std::unique_ptr<draco::MeshDecoder> decoder_for(std::string_view bytes, Budget& budget) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::DracoHeader header{};
    const bool is_mesh = draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() &&
                         header.encoder_type == draco::TRIANGULAR_MESH;
    if (is_mesh && header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
        return std::make_unique<Bounded<draco::MeshSequentialDecoder>>(budget);
    if (is_mesh && header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        return std::make_unique<Bounded<draco::MeshEdgebreakerDecoder>>(budget);
    throw BadFile("has a primitive whose bytes are not a mesh compressed by Draco");
}

std::unique_ptr<draco::Mesh> decoded(std::string_view bytes, Budget& budget) {
    auto mesh = std::make_unique<draco::Mesh>();
    const auto decoder = decoder_for(bytes, budget);
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    const draco::Status status = decoder->Decode(draco::DecoderOptions(), &buffer, mesh.get());
    if (budget.is_exceeded) {
        throw BadFile(
            fmt::format("has a primitive compressed by Draco that declares more than its {} bytes can hold",
                        bytes.size()));
    }
    if (!status.ok())
        throw BadFile(fmt::format("has a primitive compressed by Draco that is damaged: {}",
                                  status.error_msg_string()));
    return mesh;
}

/// The integer of an accessor's type that stands for 1.
double one_of(const tinygltf::Accessor& accessor) {
    if (!accessor.normalized) return 1;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::numeric_limits<std::int8_t>::max();
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return std::numeric_limits<std::uint8_t>::max();
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::numeric_limits<std::int16_t>::max();
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return std::numeric_limits<std::uint16_t>::max();
        default:
            return 1;
    }
}

template <class T>
void write(const draco::PointAttribute& attribute, std::size_t points, double one, float* to) {
    const auto components = static_cast<std::size_t>(attribute.num_components());
    const double least = one == 1 ? std::numeric_limits<double>::lowest() : -1;
    for (std::size_t p = 0; p < points; ++p) {
        const auto at = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
        if (at.value() >= attribute.size())
            throw BadFile("has a primitive compressed by Draco that is damaged");
        const std::uint8_t* const from = attribute.GetAddress(at);
        for (std::size_t c = 0; c < components; ++c) {
            T value;
            std::memcpy(&value, from + c * sizeof value, sizeof value);
            *to++ = static_cast<float>(std::max(static_cast<double>(value) / one, least));
        }
    }
}

Array<char> floats_of(const draco::PointAttribute& attribute, std::size_t points, double one) {
    Array<char> bytes(points * static_cast<std::size_t>(attribute.num_components()) * sizeof(float));
    auto* const to = reinterpret_cast<float*>(bytes.data());
    switch (attribute.data_type()) {
        case draco::DT_INT8:
            write<std::int8_t>(attribute, points, one, to);
            break;
        case draco::DT_UINT8:
            write<std::uint8_t>(attribute, points, one, to);
            break;
        case draco::DT_INT16:
            write<std::int16_t>(attribute, points, one, to);
            break;
        case draco::DT_UINT16:
            write<std::uint16_t>(attribute, points, one, to);
            break;
        case draco::DT_INT32:
            write<std::int32_t>(attribute, points, one, to);
            break;
        case draco::DT_UINT32:
            write<std::uint32_t>(attribute, points, one, to);
            break;
        case draco::DT_FLOAT32:
            write<float>(attribute, points, 1, to);
            break;
        default:
            throw BadFile(fmt::format("has an attribute compressed by Draco of type {}",
                                      static_cast<int>(attribute.data_type())));
    }
    return bytes;
}

void add(Document& document, const DracoPrimitive& from, const draco::Mesh& mesh,
         tinygltf::Primitive& primitive) {
    const std::size_t points = mesh.num_points();
    for (const auto& [name, where] : from.attributes) {
        const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(where.id);
        if (attribute == nullptr)
            throw BadFile(fmt::format("has no attribute {} in a Draco stream", where.id));
        const tinygltf::Accessor& as = document.model.accessors.at(where.accessor);
        if (attribute->num_components() !=
            Accessor::components_of(document, static_cast<int>(where.accessor)))
            throw BadFile(fmt::format("has an accessor {} whose type does not fit its use", where.accessor));
        const int type = as.type;
        primitive.attributes[name] = document.add_accessor(floats_of(*attribute, points, one_of(as)),
                                                           TINYGLTF_COMPONENT_TYPE_FLOAT, type, points);
    }
    const std::size_t corners = 3 * static_cast<std::size_t>(mesh.num_faces());
    Array<char> bytes(corners * sizeof(std::uint32_t));
    char* to = bytes.data();
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (const draco::PointIndex point : mesh.face(draco::FaceIndex(f))) {
            const std::uint32_t index = point.value();
            std::memcpy(to, &index, sizeof index);
            to += sizeof index;
        }
    primitive.indices = document.add_accessor(std::move(bytes), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                              TINYGLTF_TYPE_SCALAR, corners);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

}  // namespace

void decompress(Document& document, const std::vector<DracoPrimitive>& primitives) {
    constexpr std::uint64_t k_always = std::uint64_t{1} << 22, k_per_byte = 64;
    Budget budget{.numbers = std::max(k_always, k_per_byte * document.bytes)};
    for (const DracoPrimitive& from : primitives) {
        const auto mesh = decoded(document.view(from.view), budget);
        add(document, from, *mesh, document.model.meshes.at(from.mesh).primitives.at(from.primitive));
    }
}

}  // namespace mesh_io::gltf
