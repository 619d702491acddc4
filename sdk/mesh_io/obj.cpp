#include <fmt/format.h>

#include <array>
#include <boost/unordered/unordered_flat_map.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "mesh_io/obj_statements.h"
#include "mesh_io/polygons.h"
#include "mesh_io/readers.h"
#include "mesh_io/text_scanner.h"

using candela::Vec3;

namespace mesh_io {

namespace {

constexpr std::uint32_t k_none = 0xffff'ffffu;

/// The vertex, and optionally the texture coordinates and normal, that a corner names.
using Corner = std::array<std::uint32_t, 3>;

struct CornerHash {
    std::size_t operator()(const Corner& corner) const {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::uint32_t part : corner) h = (h ^ part) * 0xff51afd7ed558ccdu, h ^= h >> 32;
        return h;
    }
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const Origin& origin, const Progress& progress)
        : scanner_(text, progress), origin_(origin) {}

    Surface read() {
        for (; !scanner_.at_end(); scanner_.next_line()) {
            const std::string_view word = next();
            if (!word.empty()) statement(word);
        }
        require_faces();
        require_listed(highest_[0], position_.size());
        leave_out_missing(1, u_.size(), "texture coordinates");
        leave_out_missing(2, normal_.size(), "normals");
        make_vertices();
        if (has_smoothing_) {
            triangulate(polygons_, smoothing_, surface_);
        } else {
            triangulate(polygons_, {}, surface_);
        }
        note_losses();
        surface_.materials = materials_.names();
        return std::move(surface_);
    }

  private:
    // ---- statements

    void statement(std::string_view keyword) {
        if (keyword == "v") {
            vertex();
        } else if (keyword == "vn") {
            normal();
        } else if (keyword == "vt") {
            texture_coordinates();
        } else if (keyword == "f" || keyword == "fo") {
            face();
        } else if (keyword == "s") {
            smoothing_group();
        } else if (keyword == "mtllib" || keyword == "usemtl") {
            if (keyword == "usemtl") use_material();
            if (keyword == "mtllib") ++losses_["material library"];
        } else if (keyword == "l") {
            ++losses_["line"];
        } else if (keyword == "p") {
            ++losses_["list of points"];
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
            ++losses_["free-form curve or surface"];
            has_free_surfaces_ = has_free_surfaces_ || keyword == "surf";
        } else if (keyword != "o" && keyword != "g") {
            other(keyword);
        }
    }

    void vertex() {
        std::array<double, 8> values{};
        std::size_t count = 0;
        for (std::string_view word = next(); !word.empty() && count < values.size(); word = next()) {
            values[count] = number(word);
            if (count < 3 && !std::isfinite(values[count]))
                refuse(in_quotes(word) + " is not a finite number; positions must be finite");
            ++count;
        }
        if (count < 3) refuse("a vertex has three coordinates");
        position_.push_back(origin_.moved({values[0], values[1], values[2]}));
        // A fourth number is the vertex's weight in a rational curve; the last three of six or seven are its
        // colour.
        const bool has_color = count == 6 || count == 7;
        if ((count == 4 || count == 7) && values[3] != 1) ++losses_["weight of a vertex"];
        if (has_color && color_.empty()) {
            for (std::size_t i = 1; i < position_.size(); ++i) color_.push_back({1, 1, 1});
        }
        if (has_color) {
            color_.push_back({static_cast<float>(values[count - 3]), static_cast<float>(values[count - 2]),
                              static_cast<float>(values[count - 1])});
        } else if (!color_.empty()) {
            color_.push_back({1, 1, 1});
        }
    }

    void normal() {
        const Vec3 n = {single(coordinate()), single(coordinate()), single(coordinate())};
        const bool is_finite = std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z);
        normal_.push_back(is_finite ? n : Vec3{});
        if (!is_finite) ++non_finite_normals_;
    }

    void texture_coordinates() {
        const float u = single(coordinate());
        const std::string_view word = next();
        const float v = word.empty() ? 0 : single(number(word));
        const bool are_finite = std::isfinite(u) && std::isfinite(v);
        u_.push_back(are_finite ? u : 0);
        v_.push_back(are_finite ? v : 0);
        if (!are_finite) ++non_finite_uv_;
    }

    void face() {
        for (std::string_view word = next(); !word.empty(); word = next()) {
            Corner corner = {k_none, k_none, k_none};
            const std::array<std::size_t, 3> listed_so_far = {position_.size(), u_.size(), normal_.size()};
            std::string_view rest = word;
            for (std::size_t part = 0; part < 3; ++part) {
                const std::size_t slash = rest.find('/');
                const std::string_view index = rest.substr(0, slash);
                if (!index.empty()) {
                    corner[part] = index_from(index, listed_so_far[part], part);
                } else if (part == 0) {
                    refuse(in_quotes(word) + " does not name a vertex");
                }
                if (slash == std::string_view::npos) break;
                if (part == 2) refuse(in_quotes(word) + " has more than three parts");
                rest.remove_prefix(slash + 1);
            }
            corners_.push_back(corner);
            polygons_.corners.push_back(0);
        }
        polygons_.end_face();
        corners_.resize(polygons_.corners.size());
        if (smoothing_.size() == polygons_.ends.size()) return;
        smoothing_.push_back(group_);
        if (!material_) material_ = materials_.of(k_no_material);
        const std::size_t before = polygons_.ends.size() < 2 ? 0 : *(polygons_.ends.end() - 2);
        surface_.material.resize(surface_.material.size() + polygons_.ends.back() - before - 2, *material_);
    }

    /// Indices count from 1, or backwards from the last element listed so far.
    std::uint32_t index_from(std::string_view word, std::size_t count, std::size_t part) {
        const auto index = integer_from(word);
        // Only the vertex is required.
        const bool is_needed = part == 0;
        if (!is_needed && index && (*index == 0 || *index < -static_cast<std::int64_t>(count))) {
            ++missing_[part];
            return k_none;
        }
        if (!index || *index == 0)
            refuse(in_quotes(word) + " is not a valid index; indices count from 1, or backwards from -1");
        const std::int64_t at = *index > 0 ? *index - 1 : static_cast<std::int64_t>(count) + *index;
        if (at < 0)
            refuse(fmt::format("{} is out of range; it counts back past the first of {}", in_quotes(word),
                               count));
        if (at >= std::int64_t{k_none}) refuse(in_quotes(word) + " is too large");
        // It may be listed further down.
        const auto result = static_cast<std::uint32_t>(at);
        Highest& highest = highest_[part];
        if (highest.line == 0 || result > highest.index) highest = {result, scanner_.line()};
        return result;
    }

    void use_material() {
        ++losses_["use of a material"];
        const std::string name = material_name(scanner_.rest_of_line());
        material_ = materials_.of(name.empty() ? k_no_material : name);
    }

    void smoothing_group() {
        const std::string_view word = next();
        has_smoothing_ = true;
        if (word == "off" || word.empty()) {
            group_ = k_flat;
            return;
        }
        const auto group = word == "on" ? std::optional<std::int64_t>(1) : integer_from(word);
        if (!group || *group < 0 || *group >= std::int64_t{k_by_angle})
            refuse(in_quotes(word) + " is not a smoothing group; expected 'off' or a number");
        group_ = static_cast<std::uint32_t>(*group);
    }

    void other(std::string_view keyword) {
        static constexpr std::array<std::string_view, 26> k_silent = {
            "vp",       "cstype",   "deg",  "bmat",   "step",         "parm",       "trim",
            "hole",     "scrv",     "sp",   "end",    "con",          "mg",         "bevel",
            "c_interp", "d_interp", "lod",  "maplib", "usemap",       "shadow_obj", "trace_obj",
            "ctech",    "stech",    "call", "csh",    "shadow_object"};
        for (const std::string_view known : k_silent) {
            if (keyword != known) continue;
            ++losses_[fmt::format("statement '{}'", known)];
            return;
        }
        // This is not an OBJ file.
        if (unknown_++ == 0) first_unknown_ = in_quotes(keyword);
    }

    // ---- words

    /// The next word of a statement, which a backslash continues on the next line; empty at its end.
    std::string_view next() {
        for (;;) {
            const std::string_view word = scanner_.word_on_line();
            if (word.starts_with('#')) return {};
            if (!word.ends_with('\\')) return word;
            scanner_.next_line();
            if (word.size() > 1) return word.substr(0, word.size() - 1);
        }
    }

    double coordinate() {
        const std::string_view word = next();
        if (word.empty()) refuse("a number is missing");
        return number(word);
    }

    double number(std::string_view word) const {
        const auto value = number_from(word);
        if (!value) refuse(in_quotes(word) + " is not a number");
        return *value;
    }

    static float single(double x) { return static_cast<float>(x); }

    [[noreturn]] void refuse(const std::string& problem) const {
        throw BadFile(fmt::format("line {}: {}", scanner_.line(), problem));
    }

    // ---- the whole file

    struct Highest {
        std::uint32_t index = 0;
        std::size_t line = 0;  // 0: none
    };

    /// Throws BadFile naming the contents of a file without faces.
    void require_faces() const {
        if (!polygons_.ends.empty() || polygons_.too_small > 0) return;
        if (unknown_ > 0)
            throw BadFile(fmt::format("is not an OBJ file: {} does not begin a statement", first_unknown_));
        const auto count_of = [&](const char* what) {
            const auto found = losses_.find(what);
            return found == losses_.end() ? std::uint64_t{0} : found->second;
        };
        std::vector<std::string> others;
        if (const auto lines = count_of("line"); lines > 0) others.push_back(counted(lines, "line"));
        if (const auto points = count_of("list of points"); points > 0)
            others.push_back(fmt::format("{} set{} of points", points, points == 1 ? "" : "s"));
        if (count_of("free-form curve or surface") > 0) {
            const char* const what = has_free_surfaces_ ? "free-form surfaces" : "free-form curves";
            if (others.empty()) throw BadFile(fmt::format("has {} only; Candela draws triangles", what));
            others.emplace_back(what);
        }
        if (others.empty() && !position_.empty())
            throw BadFile(fmt::format("has {} {} and no faces; Candela draws surfaces", position_.size(),
                                      position_.size() == 1 ? "vertex" : "vertices"));
        if (!others.empty())
            throw BadFile(fmt::format("has {} and no triangles; Candela draws surfaces", listed(others)));
    }

    static void require_listed(const Highest& highest, std::size_t count) {
        if (highest.line == 0 || highest.index < count) return;
        throw BadFile(fmt::format("line {}: vertex {} of a face is out of range; there are only {} vertices",
                                  highest.line, std::uint64_t{highest.index} + 1, count));
    }

    /// Corners lose texture coordinates or normals that the file does not contain.
    void leave_out_missing(std::size_t part, std::size_t count, std::string_view what) {
        Highest& highest = highest_[part];
        if (highest.line != 0 && highest.index >= count) {
            for (Corner& corner : corners_) {
                if (corner[part] == k_none || corner[part] < count) continue;
                corner[part] = k_none;
                ++missing_[part];
            }
            if (count == 0) highest.line = 0;
        }
        if (missing_[part] > 0)
            surface_.notes.push_back(fmt::format("has {} with {} that it does not contain; they are ignored",
                                                 counted(missing_[part], "corner"), what));
    }

    /// Makes a vertex of each combination that corners name.
    void make_vertices() {
        const bool has_uv = highest_[1].line != 0, has_normals = highest_[2].line != 0;
        if (!has_uv && !has_normals) {
            for (std::size_t i = 0; i < corners_.size(); ++i) polygons_.corners[i] = corners_[i][0];
            surface_.position = std::move(position_);
            surface_.color = std::move(color_);
            return;
        }
        boost::unordered_flat_map<Corner, std::uint32_t, CornerHash> vertex_of;
        vertex_of.reserve(position_.size());
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Corner& corner = corners_[i];
            const auto [found, is_new] =
                vertex_of.try_emplace(corner, static_cast<std::uint32_t>(surface_.position.size()));
            polygons_.corners[i] = found->second;
            if (!is_new) continue;
            surface_.position.push_back(position_.span()[corner[0]]);
            if (!color_.empty()) surface_.color.push_back(color_.span()[corner[0]]);
            if (has_uv) {
                surface_.u.push_back(corner[1] == k_none ? 0.0f : u_[corner[1]]);
                surface_.v.push_back(corner[1] == k_none ? 0.0f : v_[corner[1]]);
            }
            if (has_normals)
                surface_.normal.push_back(corner[2] == k_none ? Vec3{} : normal_.span()[corner[2]]);
        }
    }

    void note_losses() {
        if (unknown_ > 0)
            surface_.losses.emplace_back(fmt::format("{} that OBJ does not define, such as {}",
                                                     counted(unknown_, "statement"), first_unknown_));
        if (non_finite_normals_ > 0)
            surface_.notes.push_back(fmt::format("has {} that {} not finite; computed ones are used instead",
                                                 counted(non_finite_normals_, "normal"),
                                                 non_finite_normals_ == 1 ? "is" : "are"));
        if (non_finite_uv_ > 0)
            surface_.notes.push_back(
                fmt::format("has {} that are not finite; zeros are used instead",
                            counted(non_finite_uv_, "pair") + " of texture coordinates"));
        for (const auto& [what, count] : losses_) {
            if (what == "use of a material") {
                surface_.losses.emplace_back(
                    count == 1 ? "a use of a material" : fmt::format("{} uses of materials", count), true);
            } else if (what == "weight of a vertex") {
                surface_.losses.emplace_back("weights of vertices");
            } else if (what == "material library") {
                surface_.losses.emplace_back(
                    count == 1 ? "a material library" : fmt::format("{} material libraries", count), true);
            } else if (what == "list of points") {
                surface_.losses.emplace_back("points");
            } else if (what == "free-form curve or surface") {
                surface_.losses.emplace_back("free-form curves and surfaces");
            } else {
                surface_.losses.emplace_back(counted(count, what));
            }
        }
    }

    TextScanner scanner_;
    const Origin& origin_;
    Surface surface_;
    Vectors position_, normal_, color_;
    Array<float> u_, v_;
    std::vector<Corner> corners_;
    Polygons polygons_;                     // their corners are filled in at the end
    std::vector<std::uint32_t> smoothing_;  // per face
    std::array<Highest, 3> highest_{};
    std::array<std::uint64_t, 3> missing_{};  // corners that refer to missing texture coordinates or normals
    std::uint64_t non_finite_normals_ = 0, non_finite_uv_ = 0;
    bool has_free_surfaces_ = false;
    std::uint32_t group_ = k_flat;
    MaterialNumbers materials_;
    std::optional<std::uint32_t> material_;
    bool has_smoothing_ = false;
    std::map<std::string, std::uint64_t> losses_;
    std::uint64_t unknown_ = 0;
    std::string first_unknown_;
};

}  // namespace

Surface read_obj(std::string_view text, const Origin& origin, const Progress& progress) {
    return ObjReader(without_mark(text), origin, progress).read();
}

}  // namespace mesh_io
