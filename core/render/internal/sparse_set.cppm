module;

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

module candela.render:sparse_set;

namespace candela {

/// A set of indices, numbered in order of insertion, that can be cleared in constant time (Briggs, Torczon
/// 1993, "An efficient representation for sparse sets").
class SparseSet {
  public:
    /// Clears the set; later indices are below `count`.
    void begin(std::size_t count) {
        if (number_.size() < count) number_.resize(count);
        indices_.clear();
    }
    void add(std::uint32_t index) {
        if (contains(index)) return;
        number_[index] = static_cast<std::uint32_t>(indices_.size());
        indices_.push_back(index);
    }
    std::uint32_t number_of(std::uint32_t index) const { return number_[index]; }
    std::span<const std::uint32_t> indices() const { return indices_; }

  private:
    bool contains(std::uint32_t index) const {
        const std::uint32_t number = number_[index];
        return number < indices_.size() && indices_[number] == index;
    }

    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> indices_;
};

}  // namespace candela
