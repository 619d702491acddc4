// The animations of a glTF file's nodes.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "import/gltf_container.h"
#include "import/model.h"

namespace importing::gltf {

/// A node's transformation at rest.
Placement placement_of(const Json& node);

/// One animation of the file; it outlives the file.
class Animation {
  public:
    /// Unreadable channels are left out and counted.
    Animation(Container& container, const Json& animation);

    bool moves(std::size_t node) const { return nodes_.contains(node); }
    double length() const { return length_; }  // seconds
    bool has_splines() const { return has_splines_; }
    std::size_t weights() const { return weights_; }        // channels of morph targets
    std::size_t unreadable() const { return unreadable_; }  // other channels

    /// The placement of the last of `chain` over time; each node of the chain is within the one before it. If
    /// relative, it is relative to the rest placement, and nothing is returned if that cannot be inverted.
    /// Otherwise it is in the world.
    static std::shared_ptr<const Motion> motion(const std::shared_ptr<const Animation>& animation,
                                                const Json& nodes, const std::vector<std::size_t>& chain,
                                                bool is_relative);

  private:
    enum class Way { step, linear, spline };
    struct Channel {
        Way way = Way::linear;
        std::size_t components = 3;
        std::shared_ptr<const std::vector<double>> times, values;

        std::vector<double> at(double time) const;
    };
    struct Node {
        std::map<std::string, Channel> channels;           // by the property they change
        std::vector<double> translation, rotation, scale;  // at rest

        Placement at(double time) const;
    };

    bool add(Container& container, const Json& animation, const Json& channel);
    std::shared_ptr<const std::vector<double>> read(Container& container, std::size_t accessor,
                                                    std::size_t components);

    std::map<std::size_t, Node> nodes_;
    std::map<std::size_t, std::shared_ptr<const std::vector<double>>> accessors_;  // used while reading
    std::size_t values_read_ = 0, weights_ = 0, unreadable_ = 0;
    double length_ = 0;
    bool has_splines_ = false;
};

}  // namespace importing::gltf
