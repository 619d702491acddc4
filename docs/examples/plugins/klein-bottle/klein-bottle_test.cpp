#include <candela/plugin_test.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

using candela::Vec3;

namespace {

/// The mesh with coincident vertices merged, to a tenth of a millimetre.
class Surface {
  public:
    explicit Surface(std::int64_t segments)
        : triangles_(*candela::sdk::make<candela::Shape>(CANDELA_PLUGIN_DIR, "klein-bottle",
                                                         {{"segments", segments}})) {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k)
                ++edges_[std::minmax(place(triangles_.corner(t, k)),
                                     place(triangles_.corner(t, (k + 1) % 3)))];
        }
    }
    int euler() const {
        return static_cast<int>(places_.size()) - static_cast<int>(edges_.size()) +
               static_cast<int>(triangles_.size());
    }
    bool is_closed() const {
        for (const auto& [edge, count] : edges_)
            if (count != 2) return false;
        return true;
    }

  private:
    std::size_t place(Vec3 p) {
        const auto same =
            std::ranges::find_if(places_, [&](Vec3 other) { return length(p - other) < 1e-4f; });
        if (same == places_.end()) return places_.push_back(p), places_.size() - 1;
        return static_cast<std::size_t>(same - places_.begin());
    }

    candela::sdk::Triangles triangles_;
    std::vector<Vec3> places_;
    std::map<std::pair<std::size_t, std::size_t>, int> edges_;
};

}  // namespace

TEST_CASE("every edge lies between two faces, and vertices - edges + faces is 0, as for every Klein bottle") {
    // An odd number of faces along the eight, so that it has a vertex at only one of the two points where it
    // meets itself.
    const Surface surface(102);
    CHECK(surface.is_closed());
    CHECK(surface.euler() == 0);
}
