#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "candela/parallel.h"
#include "mesh_io/finite.h"
#include "mesh_io/ply_colors.h"
#include "mesh_io/ply_header.h"
#include "mesh_io/ply_values.h"
#include "mesh_io/polygons.h"
#include "mesh_io/readers.h"
#include "mesh_io/wedges.h"

namespace mesh_io {

namespace ply {

namespace {

constexpr std::size_t k_per_task = 65536;

/// The destination of a vertex property; null: none. `origin` is subtracted while the value is a double.
struct Column {
    Array<float>* to = nullptr;
    double origin = 0;
};
using Columns = std::vector<Column>;

/// Whether each vertex takes the same number of bytes.
bool has_fixed_rows(const Header& header, const Element& element) {
    return header.encoding != Encoding::text && !element.has_lists();
}

/// Fills the columns of a binary element without lists.
void read_fixed_rows(std::string_view bytes, const Header& header, const Element& element,
                     const Columns& columns, std::size_t begin) {
    const std::size_t stride = element.fixed_size();
    const bool swapped = swaps(header.encoding);
    const char* const first = bytes.data() + begin;
    candela::parallel_for(element.count, k_per_task, [&](std::size_t from, std::size_t to) {
        std::size_t offset = 0;
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const Type type = element.properties[p].type;
            if (columns[p].to != nullptr) {
                float* const out = columns[p].to->data();
                const double origin = columns[p].origin;
                with_type(type, [&](auto t) {
                    for (std::size_t i = from; i < to; ++i) {
                        const auto value = load<decltype(t)>(first + i * stride + offset, swapped);
                        out[i] = static_cast<float>(static_cast<double>(value) - origin);
                    }
                });
            }
            offset += size_of(type);
        }
    });
}

template <class Values>
void skip(Values& values, const Property& property) {
    values.skip(property.type, property.is_list() ? values.length(*property.length_type) : 1);
}

template <class Values>
void skip(Values& values, const Element& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i)
        for (const Property& p : element.properties) skip(values, p);
}

class Reader {
  public:
    Reader(std::string_view bytes, const Header& header, const Origin& origin, const Progress& progress,
           Attributes attributes)
        : bytes_(bytes), header_(header), origin_(origin), progress_(progress), attributes_(attributes) {}

    Surface read() {
        if (header_.encoding == Encoding::text) {
            read_all(TextValues(bytes_, header_, progress_));
        } else {
            read_all(BinaryValues(bytes_, header_));
        }
        if (!has_vertices_) throw BadFile("has no element 'vertex'");
        require_faces();
        // Strips refer to the file's vertex numbers.
        if (!wedges_.empty() && strips_.empty()) split_by_wedges(wedges_, polygons_, surface_);
        if (fixed_triangles_.empty()) {
            triangulate(polygons_, {}, surface_);
        } else {
            surface_.indices = std::move(fixed_triangles_);
        }
        surface_.indices.insert(surface_.indices.end(), strips_.begin(), strips_.end());
        require_finite(surface_, "face");
        return std::move(surface_);
    }

  private:
    template <class Values>
    void read_all(Values values) {
        for (const Element& element : header_.elements) {
            if (element.name == "vertex") {
                if (has_vertices_) throw BadFile("has two elements 'vertex'");
                has_vertices_ = true;
                read_vertices(values, element);
            } else if (const auto corners = element.find({"vertex_indices", "vertex_index"});
                       corners && (element.name == "face" || element.name == "tristrips") &&
                       element.properties[*corners].is_list()) {
                has_faces_ = has_faces_ || element.count > 0;
                if (element.name == "face") {
                    read_faces(values, element, *corners);
                } else {
                    note_others(element, {*corners}, "face");
                    read_strips(values, element, *corners);
                }
            } else {
                if (element.name == "edge") edges_ += element.count;
                if (element.count > 0)
                    surface_.losses.emplace_back(counted(element.count, "element") + " " +
                                                 in_quotes(element.name));
                skip(values, element);
            }
        }
    }

    /// Throws BadFile naming the contents of a file without faces.
    void require_faces() const {
        if (has_faces_) return;
        const std::size_t points = surface_.position.size();
        if (edges_ > 0)
            throw BadFile(
                fmt::format("has {} and no triangles; Candela draws surfaces", counted(edges_, "line")));
        throw BadFile(
            points == 0
                ? std::string("has no vertices and no faces")
                : fmt::format("has 1 set of points ({}) and no triangles; Candela draws surfaces, and points "
                              "alone have none",
                              points));
    }

    // ---- vertices

    using PropertyIndex = std::optional<std::size_t>;

    static PropertyIndex scalar_of(const Element& element, std::initializer_list<std::string_view> names) {
        const PropertyIndex found = element.find(names);
        return found && !element.properties[*found].is_list() ? found : std::nullopt;
    }
    /// The properties of red, green and blue that have one type.
    static std::array<PropertyIndex, 3> colors_of(const Element& element) {
        const PropertyIndex red = scalar_of(element, {"red", "diffuse_red", "r"}),
                            green = scalar_of(element, {"green", "diffuse_green", "g"}),
                            blue = scalar_of(element, {"blue", "diffuse_blue", "b"});
        if (!red || !green || !blue) return {};
        const auto type = [&](PropertyIndex place) { return element.properties[*place].type; };
        if (type(red) != type(green) || type(red) != type(blue)) return {};
        return {red, green, blue};
    }

    template <class Values>
    void read_vertices(Values& values, const Element& element) {
        Columns columns(element.properties.size());
        std::vector<std::size_t> used;
        const auto use = [&](std::optional<std::size_t> property, Array<float>& column) {
            column.resize(element.count);
            columns[*property].to = &column;
            used.push_back(*property);
        };
        const auto scalar = [&](std::initializer_list<std::string_view> names) {
            return scalar_of(element, names);
        };
        const auto x = scalar({"x"}), y = scalar({"y"}), z = scalar({"z"});
        if (!x || !y || !z) throw BadFile("has vertices without x, y and z");
        if (element.count > 0xffff'fff0u) throw BadFile("has too many vertices");
        use(x, surface_.position.x);
        use(y, surface_.position.y);
        use(z, surface_.position.z);
        surface_.is_single = element.properties[*x].type == Type::float32;
        columns[*x].origin = origin_.at[0];
        columns[*y].origin = origin_.at[1];
        columns[*z].origin = origin_.at[2];
        const auto nx = scalar({"nx"}), ny = scalar({"ny"}), nz = scalar({"nz"});
        if (nx && ny && nz) {
            use(nx, surface_.normal.x);
            use(ny, surface_.normal.y);
            use(nz, surface_.normal.z);
        }
        const auto u = scalar({"u", "s", "texture_u", "texture_s"}),
                   v = scalar({"v", "t", "texture_v", "texture_t"});
        if (u && v) {
            use(u, surface_.u);
            use(v, surface_.v);
        }
        const auto [red, green, blue] = colors_of(element);
        if (red && green && blue) {
            use(red, surface_.color.x);
            use(green, surface_.color.y);
            use(blue, surface_.color.z);
        }
        const auto alpha = scalar({"alpha", "diffuse_alpha", "a"});
        Array<float> opacity;
        if (alpha) use(alpha, opacity);
        std::vector<std::size_t> others;
        if (attributes_ == Attributes::read) {
            for (std::size_t i = 0; i < element.properties.size(); ++i)
                if (!element.properties[i].is_list() && std::ranges::find(used, i) == used.end())
                    others.push_back(i);
            surface_.attributes.reserve(others.size());  // columns point into it
            for (const std::size_t i : others) {
                surface_.attributes.push_back({element.properties[i].name, std::vector<Array<float>>(1)});
                use(i, surface_.attributes.back().channels[0]);
            }
        }
        note_others(element, used, "vertex");
        read_columns(values, element, columns);
        for (Attribute& attribute : surface_.attributes)
            for (float& number : attribute.channels[0])
                if (!std::isfinite(number)) number = 0;
        if (alpha) {
            std::vector<std::string> unsaid;
            scale_colors({&opacity}, element.properties[*alpha].type, "vertex", unsaid);
            if (attributes_ == Attributes::skipped &&
                std::ranges::any_of(opacity, [](float a) { return a != 1; }))
                surface_.losses.emplace_back("the opacity of vertices");
        }
        if (red && green && blue) {
            scale_colors({&surface_.color.x, &surface_.color.y, &surface_.color.z},
                         element.properties[*red].type, "vertex", surface_.notes);
        }
        if (attributes_ == Attributes::skipped || (!alpha && surface_.color.empty())) return;
        Attribute color{"color", {surface_.color.x, surface_.color.y, surface_.color.z}};
        for (Array<float>& channel : color.channels) channel.resize(element.count, 1.0f);
        if (alpha) color.channels.push_back(std::move(opacity));
        surface_.attributes.push_back(std::move(color));
    }

    template <class Values>
    void read_columns(Values& values, const Element& element, const Columns& columns) {
        if constexpr (requires { values.go_to(0); }) {
            if (has_fixed_rows(header_, element)) {
                const std::size_t begin = values.position();
                if (element.count > values.left() / element.fixed_size())
                    throw BadFile("ends within its vertices");
                read_fixed_rows(bytes_, header_, element, columns, begin);
                values.go_to(begin + element.count * element.fixed_size());
                return;
            }
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < columns.size(); ++p) {
                if (columns[p].to == nullptr) {
                    skip(values, element.properties[p]);
                } else {
                    (*columns[p].to)[i] =
                        static_cast<float>(values.number(element.properties[p].type) - columns[p].origin);
                }
            }
        }
    }

    /// Reports the properties that are left out.
    void note_others(const Element& element, const std::vector<std::size_t>& used, std::string_view whose) {
        std::vector<std::string> others;
        bool has_colors = false;
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            if (std::ranges::find(used, p) != used.end()) continue;
            const std::string_view name = element.properties[p].name;
            const bool is_color = name.ends_with("red") || name.ends_with("green") ||
                                  name.ends_with("blue") || name.ends_with("alpha") || name == "r" ||
                                  name == "g" || name == "b";
            has_colors = has_colors || is_color;
            if (!is_color) others.push_back(in_quotes(name));
        }
        if (element.count == 0) return;
        if (has_colors) surface_.losses.emplace_back(fmt::format("{} colours", whose));
        constexpr std::size_t k_most_named = 5;
        if (others.size() > k_most_named) {
            const std::size_t more = others.size() - k_most_named;
            others.resize(k_most_named);
            others.push_back(fmt::format("{} more", more));
        }
        if (!others.empty())
            surface_.losses.emplace_back(
                fmt::format("the {} propert{} {}", whose, others.size() == 1 ? "y" : "ies", listed(others)));
    }

    // ---- faces

    template <class Values>
    static std::uint32_t corner(Values& values, Type type) {
        const double index = values.number(type);
        if (!(index >= 0 && index <= 0xffff'ffffu) || index != std::floor(index)) {
            throw BadFile(fmt::format("has a face whose corner is out of range: vertex {:g}", index));
        }
        return static_cast<std::uint32_t>(index);
    }

    template <class Values>
    void read_faces(Values& values, const Element& element, std::size_t corners) {
        FaceProperties other;
        std::vector<std::size_t> used = {corners};
        // Properties of vertices do not apply to faces, and strips have no face numbers.
        const bool is_only_one =
            header_.elements.end() == std::ranges::find(header_.elements, "tristrips", &Element::name);
        if (surface_.color.empty() && has_vertices_ && is_only_one) other.color = colors_of(element);
        const PropertyIndex uv = element.find({"texcoord"});
        if (uv && element.properties[*uv].is_list() && surface_.u.empty() && has_vertices_ && is_only_one)
            other.uv = uv;
        if (other.uv) other.image = scalar_of(element, {"texnumber"});
        for (const PropertyIndex place :
             {other.color[0], other.color[1], other.color[2], other.uv, other.image})
            if (place) used.push_back(*place);
        note_others(element, used, "face");
        if constexpr (requires { values.go_to(0); }) {
            if (used.size() == 1 && read_fixed_triangles(values, element, corners)) return;
        }
        std::vector<float> coordinates;
        std::uint64_t faces_without = 0, faces_of_others = 0;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            std::array<float, 3> color{};
            coordinates.clear();
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const Property& property = element.properties[p];
                const auto channel = std::ranges::find(other.color, PropertyIndex(p));
                if (p == corners) {
                    const std::uint64_t count = values.length(*property.length_type);
                    if (count > values.most(property.type)) throw BadFile("ends within its faces");
                    for (std::uint64_t k = 0; k < count; ++k)
                        polygons_.corners.push_back(corner(values, property.type));
                } else if (channel != other.color.end()) {
                    color[static_cast<std::size_t>(channel - other.color.begin())] =
                        static_cast<float>(values.number(property.type));
                } else if (other.uv == p) {
                    const std::uint64_t count = values.length(*property.length_type);
                    if (count > values.most(property.type))
                        throw BadFile("ends within its texture coordinates");
                    for (std::uint64_t k = 0; k < count; ++k)
                        coordinates.push_back(static_cast<float>(values.number(property.type)));
                } else if (other.image == p) {
                    if (values.number(property.type) > 0) ++faces_of_others;
                } else {
                    skip(values, property);
                }
            }
            const std::size_t faces = polygons_.ends.size();
            polygons_.end_face();
            if (polygons_.ends.size() == faces) continue;
            if (other.color[0]) wedges_.face_color.push_back({color[0], color[1], color[2]});
            if (!other.uv) continue;
            const std::size_t first = wedges_.u.size(), last = polygons_.corners.size();
            const bool has_all = coordinates.size() == 2 * (last - first);
            if (!has_all) ++faces_without;
            for (std::size_t k = 0; k < last - first; ++k) {
                wedges_.u.push_back(has_all ? coordinates[2 * k] : 0);
                wedges_.v.push_back(has_all ? coordinates[2 * k + 1] : 0);
            }
        }
        note_wedges(element, other, faces_without, faces_of_others);
    }

    /// The properties that a face may have in addition to its corners.
    struct FaceProperties {
        std::array<PropertyIndex, 3> color{};
        PropertyIndex uv, image;
    };

    void note_wedges(const Element& element, const FaceProperties& other, std::uint64_t without,
                     std::uint64_t of_others) {
        if (other.color[0])
            scale_colors({&wedges_.face_color.x, &wedges_.face_color.y, &wedges_.face_color.z},
                         element.properties[*other.color[0]].type, "face", surface_.notes);
        if (without > 0)
            surface_.notes.push_back(fmt::format(
                "has {} without a pair of texture coordinates for each corner; zeros are used instead",
                counted(without, "face")));
        if (of_others > 0)
            surface_.notes.push_back(fmt::format("has {} of a second or further texture, which {} the first",
                                                 counted(of_others, "face"),
                                                 of_others == 1 ? "shows" : "show"));
    }

    /// Reads faces that all have three corners and no other list; otherwise reads nothing and returns false.
    bool read_fixed_triangles(BinaryValues& values, const Element& element, std::size_t corners) {
        const Property& property = element.properties[corners];
        const auto lists = std::ranges::count_if(element.properties, &Property::is_list);
        // Another element's faces came first.
        const bool is_first = polygons_.ends.empty() && polygons_.too_small == 0 && fixed_triangles_.empty();
        if (lists != 1 || !is_first || !is_integer(property.type) || element.count == 0 || !has_vertices_)
            return false;
        const std::size_t stride = element.fixed_size() + 3 * size_of(property.type);
        if (element.count > values.left() / stride) return false;
        std::size_t offset = 0;
        for (std::size_t p = 0; p < corners; ++p) offset += size_of(element.properties[p].type);
        const char* const first = bytes_.data() + values.position() + offset;
        const bool swapped = swaps(header_.encoding);
        Array<std::uint32_t> indices(3 * element.count);
        std::atomic<bool> are_triangles = true;
        std::atomic<std::uint32_t> highest = 0;
        with_type(*property.length_type, [&](auto length) {
            with_type(property.type, [&](auto item) {
                using Length = decltype(length);
                using Item = decltype(item);
                candela::parallel_for(element.count, k_per_task, [&](std::size_t from, std::size_t to) {
                    std::uint32_t most = 0;
                    for (std::size_t i = from; i < to; ++i) {
                        const char* const row = first + i * stride;
                        if (load<Length>(row, swapped) != Length{3}) {
                            are_triangles = false;
                            return;
                        }
                        for (std::size_t k = 0; k < 3; ++k) {
                            // Negative ones become too large.
                            const auto index = static_cast<std::uint32_t>(static_cast<std::int64_t>(
                                load<Item>(row + sizeof(Length) + k * sizeof(Item), swapped)));
                            most = std::max(most, index);
                            indices[3 * i + k] = index;
                        }
                    }
                    for (std::uint32_t seen = highest;
                         most > seen && !highest.compare_exchange_weak(seen, most);) {
                    }
                });
            });
        });
        if (!are_triangles || highest >= surface_.position.size()) return false;
        fixed_triangles_ = std::move(indices);
        values.go_to(values.position() + element.count * stride);
        return true;
    }

    /// Triangle strips: each corner after the second makes a triangle with the two before it, every other one
    /// turned; a negative one begins a new strip.
    template <class Values>
    void read_strips(Values& values, const Element& element, std::size_t corners) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const Property& property = element.properties[p];
                if (p != corners) {
                    skip(values, property);
                    continue;
                }
                const std::uint64_t count = values.length(*property.length_type);
                if (count > values.most(property.type)) throw BadFile("ends within its triangle strips");
                std::uint32_t before[2] = {};
                std::uint64_t since = 0;
                for (std::uint64_t k = 0; k < count; ++k) {
                    const double index = values.number(property.type);
                    if (index < 0) {
                        since = 0;
                        continue;
                    }
                    if (!(index < static_cast<double>(surface_.position.size())) ||
                        index != std::floor(index)) {
                        throw BadFile(fmt::format(
                            "has a triangle strip whose corner is out of range: vertex {:g} of {}, "
                            "counted from 0",
                            index, surface_.position.size()));
                    }
                    const auto c = static_cast<std::uint32_t>(index);
                    // Strips are joined by triangles without area.
                    if (since >= 2 && c != before[0] && c != before[1] && before[0] != before[1]) {
                        const bool turned = since % 2 == 1;
                        for (const std::uint32_t v : {before[turned ? 1 : 0], before[turned ? 0 : 1], c})
                            strips_.push_back(v);
                    }
                    before[0] = before[1];
                    before[1] = c;
                    ++since;
                }
            }
        }
    }

    std::string_view bytes_;
    const Header& header_;
    const Origin& origin_;
    const Progress& progress_;
    Attributes attributes_;
    Surface surface_;
    Polygons polygons_;
    Wedges wedges_;
    std::uint64_t edges_ = 0;
    Array<std::uint32_t> fixed_triangles_;
    std::vector<std::uint32_t> strips_;
    bool has_vertices_ = false;
    bool has_faces_ = false;
};

}  // namespace

}  // namespace ply

Surface read_ply(std::string_view bytes, const Origin& origin, const Progress& progress,
                 Attributes attributes) {
    bytes = without_mark(bytes);
    const ply::Header header = ply::read_header(bytes);
    return ply::Reader(bytes, header, origin, progress, attributes).read();
}

}  // namespace mesh_io
